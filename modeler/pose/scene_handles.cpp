#include "modeler/pose/scene_handles.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "io/scene/complaint.h"
#include "modeler/pose/mirrored_handle.h"
#include "modeler/pose/starting_pose.h"

namespace supple {
namespace {

/// How far apart handles are sampled, in spacings: hard ones shall be met between samples too.
constexpr double handle_width = 0.5, hard_handle_width = 0.1;

/// The pose sets in over this width at a region's edge, in spacings.
constexpr double blend_width = 2;

/// What is held around a region weighs this much more than all handles: what it gives way, the
/// blend takes.
constexpr double hold_weight = 100;

bool speaks_of_vertices(const HandleSpec& handle) {
  return handle.to.has_value();
}

SurfaceSamples vertices_of(const Solid& solid, const PoseSpec& spec) {
  if (std::none_of(spec.handles.begin(), spec.handles.end(), speaks_of_vertices)) return {};
  const Triangles& triangles = solid.triangulation().triangles;
  return triangles.rows() > 0 ? vertex_samples(solid.inner_vertices(), triangles) : solid.surface();
}

double resolved_blend(const PoseSpec& spec, const HandleContext& context, double spacing) {
  if (!spec.region_blend) return blend_width * spacing * context.unit;
  return resolve(*spec.region_blend, context.selection.box.diagonal());
}

/// The samples that keep their place, ascending.
std::vector<int> samples_outside(const RegionBlend& region, const SurfaceSamples& samples) {
  std::vector<int> outside;
  for (Index k = 0; k < samples.size(); ++k)
    if (region.at(samples.positions.row(k).transpose()).value == 0)
      outside.push_back(static_cast<int>(k));
  return outside;
}

}  // namespace

SceneHandles::SceneHandles(const Mesh& rest, const Solid& solid, const Scene& scene,
                           const PoseFiles& files)
    : vertices_(vertices_of(solid, *scene.pose)),
      context_{
          {rest, solid.triangulation(), solid.box(), scene.folder},
          solid.surface(),
          vertices_,
          solid.origin(),
          solid.unit(),
          (scene.pose->hard_handles ? hard_handle_width : handle_width) * solid.particles().spacing,
          handle_width * solid.particles().spacing} {
  const PoseSpec& spec = *scene.pose;
  handles_ = make_handles(spec.handles, files.targets, context_);
  if (spec.mirror) mirror_ = scaled_plane(*spec.mirror, solid);
  if (spec.mirror) add_mirrored();
  if (!spec.region) return;
  region_.emplace(*spec.region, resolved_blend(spec, context_, solid.particles().spacing),
                  context_.selection, context_.restored(context_.surface));
  leave_to_region(spec);
  check_within_region(spec);
}

void SceneHandles::add_mirrored() {
  std::vector<PoseHandle> mirrored;
  for (const PoseHandle& handle : handles_)
    if (std::optional<PoseHandle> image = mirrored_handle(handle, *mirror_, context_))
      mirrored.push_back(std::move(*image));
  std::move(mirrored.begin(), mirrored.end(), std::back_inserter(handles_));
}

void SceneHandles::check_within_region(const PoseSpec& spec) const {
  for (const PoseHandle& handle : handles_) {
    if (handle.origin == HandleOrigin::region) continue;
    const Points places = (handle.rest() * context_.unit).rowwise() + context_.origin.transpose();
    long count = 0;
    for (Index row = 0; row < places.rows(); ++row)
      if (region_->at(places.row(row).transpose()).value == 0) ++count;
    if (count > 0)
      complain(handle.spec->place,
               fmt::format("{} lies outside pose.region {} with {} of its {} samples; allowed: "
                           "handles within the region, since nothing moves outside",
                           in_quotes(handle.spec->part()), in_quotes(spec.region->text), count,
                           handle.selected.size()));
  }
}

void SceneHandles::leave_to_region(const PoseSpec& spec) {
  std::vector<int> outside = samples_outside(*region_, context_.restored(context_.surface));
  if (static_cast<Index>(outside.size()) == context_.surface.size())
    complain_of_nothing(*spec.region, context_.selection.box, "the shape");
  if (outside.empty() || handles_.empty()) return;
  hold_.place = spec.region->place;
  hold_.fix = spec.region;
  hold_.weight = 0;
  for (const HandleSpec& handle : spec.handles) hold_.weight += hold_weight * handle.weight;
  handles_.push_back(make_hold(hold_, std::move(outside), context_));
}

void SceneHandles::begin_at(const SolidField& field, const Points& u) {
  for (PoseHandle& handle : handles_)
    supple::begin_at(carried(field, handle.rest(), u), context_, handle);
}

}  // namespace supple
