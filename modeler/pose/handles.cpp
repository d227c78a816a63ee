#include "modeler/pose/handles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "solver/core/rigid_motion.h"

namespace supple {
namespace {

/// Beyond these a step may fall into another minimum than the one that the way leads to.
constexpr double most_turn_per_step = 15 * EIGEN_PI / 180;
constexpr double most_bend_per_step = 0.05;  // of the diagonal
constexpr double particles_at_most_turn = 300;

Vec3 weighted_center(const SurfaceSamples& samples, const std::vector<int>& selected) {
  Vec3 sum = Vec3::Zero();
  double area = 0;
  for (const int k : selected) {
    sum += samples.areas[k] * samples.positions.row(k).transpose();
    area += samples.areas[k];
  }
  return sum / area;
}

/// The path in scaled coordinates, for a selection with its centre there.
HandlePath make_path(const HandleSpec& spec, const Vec3& center, const HandleContext& context) {
  const Box& box = context.selection.box;
  HandlePath path;
  path.center = path.about = center;
  if (spec.fix) return path;
  path.scale = spec.scale;
  path.by = resolve_vector(spec.by, box.diagonal()) / context.unit;
  if (spec.turn) {
    path.axis = spec.turn->axis.normalized();
    path.radians = spec.turn->degrees * EIGEN_PI / 180;
    if (spec.turn->about)
      path.about = (resolve_point(*spec.turn->about, box) - context.origin) / context.unit;
  }
  return path;
}

}  // namespace

Vec3 HandlePath::operator()(const Vec3& x, double share) const {
  const Vec3 stretch = Vec3::Ones() + share * (scale - Vec3::Ones());
  const Vec3 scaled = center + stretch.cwiseProduct(x - center);
  const Vec3 turned = about + Eigen::AngleAxisd(share * radians, axis) * (scaled - about);
  return turned + share * by;
}

std::vector<PoseHandle> make_handles(const std::vector<HandleSpec>& specs,
                                     const HandleContext& context) {
  std::vector<PoseHandle> handles;
  for (const HandleSpec& spec : specs) {
    PoseHandle handle;
    handle.spec = &spec;
    handle.selected = select(spec.selection(), context.selection, context.samples);
    handle.moves = spec.move.has_value();
    handle.thinned = thin_samples(context.scaled_samples, handle.selected, context.sample_width);
    handle.path =
        make_path(spec, weighted_center(context.scaled_samples, handle.selected), context);
    handles.push_back(std::move(handle));
  }
  return handles;
}

HandleSamples::HandleSamples(std::vector<PoseHandle> handles, const Points& surface_points)
    : handles_(std::move(handles)) {
  std::size_t count = 0;
  double total = 0;
  for (const PoseHandle& handle : handles_) {
    count += handle.thinned.indices.size();
    total += handle.spec->weight;
  }
  rest_.resize(static_cast<Index>(count), 3);
  weights_.resize(static_cast<Index>(count));
  Index row = 0;
  for (std::size_t h = 0; h < handles_.size(); ++h) {
    const ThinnedSamples& thinned = handles_[h].thinned;
    const double share = handles_[h].spec->weight / total / thinned.areas.sum();
    for (std::size_t k = 0; k < thinned.indices.size(); ++k, ++row) {
      rest_.row(row) = surface_points.row(thinned.indices[k]);
      weights_[row] = share * thinned.areas[static_cast<Index>(k)];
      owners_.push_back(static_cast<int>(h));
    }
  }
}

Points HandleSamples::targets(double share) const {
  Points targets;
  this->targets(share, targets);
  return targets;
}

void HandleSamples::targets(double share, Points& targets) const {
  targets = rest_;
  for (Index k = 0; k < rest_.rows(); ++k) {
    const PoseHandle& handle = handles_[static_cast<std::size_t>(owners_[std::size_t(k)])];
    if (handle.moves)  // what is fixed stays to the last bit
      targets.row(k) = handle.path(rest_.row(k).transpose(), share).transpose();
  }
}

void HandleSamples::lead(std::size_t handle, const HandlePath& path) {
  handles_[handle].path = path;
  handles_[handle].moves = true;
}

int substeps_needed(const HandleSamples& handles, Index particles) {
  if (handles.empty()) return 1;
  double turn = 0;
  for (const PoseHandle& handle : handles.handles())
    turn = std::max(turn, std::abs(handle.path.radians));
  const Points targets = handles.targets(1);
  const RigidMotion rigid = best_fit_motion(handles.rest(), targets, handles.weights());
  double bend = 0;
  for (Index k = 0; k < targets.rows(); ++k)
    bend = std::max(bend,
                    (rigid(handles.rest().row(k).transpose()) - targets.row(k).transpose()).norm());
  // All handles moving as one body bend nothing, however far they turn.
  if (bend < 1e-9 && turn <= EIGEN_PI) return 1;
  const double finer = std::cbrt(std::max(1.0, double(particles) / particles_at_most_turn));
  return std::max({1, static_cast<int>(std::ceil(turn / most_turn_per_step * finer - 1e-9)),
                   static_cast<int>(std::ceil(bend / most_bend_per_step * finer - 1e-9))});
}

}  // namespace supple
