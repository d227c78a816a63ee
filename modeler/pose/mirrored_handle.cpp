#include "modeler/pose/mirrored_handle.h"

#include <algorithm>

#include <fmt/format.h>

#include "io/scene/complaint.h"
#include "modeler/domain/site_tree.h"

namespace supple {
namespace {

/// The shape's symmetry is looked at by vertices so far apart, in spacings.
constexpr double vertex_width_over_spacing = 0.125;

/// Places nearer than this share of the diagonal are the same.
constexpr double same_place = 1e-9;

std::vector<int> chosen_in(const std::vector<char>& mask) {
  std::vector<int> chosen;
  for (std::size_t k = 0; k < mask.size(); ++k)
    if (mask[k]) chosen.push_back(static_cast<int>(k));
  return chosen;
}

/// Selects the samples whose images the handle's selection holds.
void select_images(const Selection& selection, const MirrorPlane& plane,
                   const HandleContext& context, PoseHandle& mirrored) {
  SurfaceSamples seen =
      stand_ins(plane.points(mirrored.samples->positions), *mirrored.samples, selection);
  seen.positions = context.restored(seen).positions;
  mirrored.selected = chosen_in(select_mask(selection, context.selection, seen));
  mirrored.mirror = plane;
}

/// Selects the vertices whose images lie at those of the handle, with mirrored displacements.
void mirror_places(const PoseHandle& handle, const MirrorPlane& plane, PoseHandle& mirrored) {
  const SurfaceSamples& samples = *handle.samples;
  std::vector<int> led;
  for (const int k : handle.selected) led.push_back(samples.vertices[static_cast<std::size_t>(k)]);
  const SurfaceSamples seen = stand_ins(plane.points(samples.positions), samples);
  std::vector<Vec3> places;
  for (Index k = 0; k < samples.size(); ++k) {
    const int vertex = seen.vertices[static_cast<std::size_t>(k)];
    const auto at = std::lower_bound(led.begin(), led.end(), vertex);
    if (at == led.end() || *at != vertex) continue;
    const Index row = at - led.begin();
    const int sample = handle.selected[static_cast<std::size_t>(row)];
    const Vec3 moved = (handle.places.row(row) - samples.positions.row(sample)).transpose();
    mirrored.selected.push_back(static_cast<int>(k));
    places.push_back(samples.positions.row(k).transpose() + plane.direction(moved));
  }
  mirrored.places.resize(static_cast<Index>(places.size()), 3);
  for (std::size_t row = 0; row < places.size(); ++row)
    mirrored.places.row(static_cast<Index>(row)) = places[row].transpose();
}

bool is_same(const PoseHandle& a, const PoseHandle& b) {
  if (a.selected != b.selected) return false;
  for (Index row = 0; row < static_cast<Index>(a.selected.size()); ++row)
    if ((a.target(row, 1) - b.target(row, 1)).norm() > same_place) return false;
  return true;
}

}  // namespace

std::optional<PoseHandle> mirrored_handle(const PoseHandle& handle, const MirrorPlane& plane,
                                          const HandleContext& context) {
  PoseHandle mirrored;
  mirrored.spec = handle.spec;
  mirrored.samples = handle.samples;
  mirrored.origin = HandleOrigin::mirror;
  const HandleSpec& spec = *handle.spec;
  if (spec.to)
    mirror_places(handle, plane, mirrored);
  else
    select_images(spec.fix ? *spec.fix : *spec.move, plane, context, mirrored);
  if (mirrored.selected.empty())
    complain(spec.place, fmt::format("{}: nothing of the shape lies on the other side of "
                                     "pose.mirror; allowed: parts that have a counterpart there",
                                     in_quotes(spec.part())));
  mirrored.thinned = thin_samples(*mirrored.samples, mirrored.selected, context.sample_width);
  find_path(context, mirrored);
  if (is_same(handle, mirrored)) return {};
  return mirrored;
}

MirrorPlane scaled_plane(const MirrorSpec& spec, const Solid& solid) {
  const Vec3 at = spec.at ? resolve_point(*spec.at, solid.box()) : solid.box().center();
  return {spec.normal.normalized(), (at - solid.origin()) / solid.unit()};
}

double asymmetry(const Solid& solid, const MirrorPlane& plane) {
  const SiteTree vertices(solid.vertices());
  double greatest = 0;
  const double width = vertex_width_over_spacing * solid.particles().spacing;
  const Points images = plane.points(solid.spread_vertices(width));
  for (Index i = 0; i < images.rows(); ++i) {
    const Vec3 image = images.row(i).transpose();
    const double to_vertex = vertices.distance(image);
    if (to_vertex <= greatest) continue;
    const double to_surface = std::abs(solid.region().signed_distance(image));
    greatest = std::max(greatest, std::min(to_vertex, to_surface));
  }
  return greatest;
}

}  // namespace supple
