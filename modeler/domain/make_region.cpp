#include "modeler/domain/make_region.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "modeler/domain/mesh_region.h"
#include "modeler/domain/point_region.h"

namespace supple {

namespace {

/// Covered shares above this are not worth a note.
constexpr double nearly_all = 0.995;

std::vector<std::string> mending_notes(const SurfaceDefects& defects) {
  std::vector<std::string> notes;
  const auto note = [&](long count, const char* what) {
    if (count > 0) notes.push_back(fmt::format("{} {}", count, what));
  };
  if (defects.inside_out)
    notes.emplace_back(
        "the faces point inwards, or some parts' do; read as if they pointed outwards");
  note(defects.turned_faces, "faces looked another way than those about them; read as if turned");
  note(defects.turning_conflicts, "edges have faces that cannot be turned one way");
  note(defects.degenerate_faces, "faces without area do not bound the solid");
  note(defects.duplicate_faces, "faces are there twice; read once");
  note(defects.small_holes, "small holes read as filled");
  return notes;
}

void add_cover(const MeshRegion& region, SolidRegion& solid) {
  const MeshCover& cover = region.cover();
  if (cover.covered < nearly_all)
    solid.notes.push_back(
        fmt::format("the faces cover {:.1f} % of the solid's boundary; the rest is closed smoothly",
                    100 * cover.covered));
  if (cover.contact.other > reason_limit(ReasonCode::self_contact))
    solid.notes.push_back(
        "parts overlap or touch: where they overlap they are one, where they touch they are not");
  if (cover.contact.own > reason_limit(ReasonCode::self_contact))
    solid.reasons.push_back(
        {ReasonCode::self_contact, 1, cover.contact.own,
         fmt::format("{:.1f} % of the surface lies within or against its own part: what overlaps "
                     "moves as one",
                     100 * cover.contact.own)});
}

/// One sentence on all parts without a particle: there may be a thousand crumbs.
std::vector<std::string> empty_parts(const MeshRegion& region, const Points& particles) {
  if (region.cover().parts < 2) return {};
  long parts = 0, empty = 0;
  double share = 0, greatest = 0;
  for (const MeshPart& part : region.parts(particles)) {
    ++parts;
    if (part.particles > 0) continue;
    ++empty;
    share += part.volume_share;
    greatest = std::max(greatest, part.volume_share);
  }
  if (empty == 0) return {};
  return {
      fmt::format("{} of {} parts are too small for a particle of their own and follow those "
                  "near them: {:.2g} % of the volume, the greatest {:.2g} %",
                  empty, parts, 100 * share, 100 * greatest)};
}

SolidRegion region_of_faces(const Points& vertices, const Triangles& triangles) {
  auto region = std::make_unique<const MeshRegion>(vertices, triangles);
  SolidRegion solid;
  solid.boundary = region->boundary();
  solid.notes = mending_notes(region->defects());
  add_cover(*region, solid);
  solid.empty_parts = [shape = region.get()](const Points& particles) {
    return empty_parts(*shape, particles);
  };
  solid.region = std::move(region);
  return solid;
}

SolidRegion region_of_points(const Points& points, const Points& normals) {
  auto region = std::make_unique<const PointRegion>(points, normals);
  SolidRegion solid;
  const int count = static_cast<int>(points.rows());
  solid.boundary = {region->boundary().triangles.array() + count, region->boundary().positions};
  const PointCloudReading& reading = region->reading();
  solid.cloud = {reading.kept, reading.normals, reading.areas};
  solid.notes = reading.notes();
  solid.region = std::move(region);
  return solid;
}

}  // namespace

SolidRegion make_region(const Mesh& mesh, const Points& vertices, const Triangles& triangles) {
  if (mesh.face_count() > 0) return region_of_faces(vertices, triangles);
  return region_of_points(vertices, mesh.normals.values);
}

}  // namespace supple
