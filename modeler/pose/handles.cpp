#include "modeler/pose/handles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "io/scene/complaint.h"
#include "solver/core/rigid_motion.h"

namespace supple {
namespace {

/// Beyond these a step may fall into another minimum than the one that the way leads to.
constexpr double most_turn_per_step = 15 * EIGEN_PI / 180;
constexpr double most_bend_per_step = 0.05;  // of the diagonal
constexpr double particles_at_most_turn = 300;

Eigen::VectorXd areas_of(const PoseHandle& handle) {
  return handle.samples->areas(handle.selected);
}

Points start_of(const PoseHandle& handle) {
  if (handle.start.rows() > 0) return handle.start;
  return handle.rest();
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

/// The rigid part of the way to places of single vertices.
HandlePath rigid_path(const Points& start, const Points& places, const Eigen::VectorXd& areas) {
  const RigidMotion motion = best_fit_motion(start, places, areas);
  const Eigen::AngleAxisd turn(motion.R);
  HandlePath path;
  path.center = path.about = start.transpose() * areas / areas.sum();
  path.axis = turn.axis();
  path.radians = turn.angle();
  path.by = motion(path.center) - path.center;
  return path;
}

void check_on_surface(const NamedFile& file, const std::vector<int>& listed,
                      const std::vector<int>& on_surface) {
  for (const int vertex : listed)
    if (!std::binary_search(on_surface.begin(), on_surface.end(), vertex))
      complain(file.place, fmt::format("{}: vertex {} does not lie on the surface: it cannot lead "
                                       "the shape",
                                       file.path, vertex));
}

/// The vertices that are both selected and listed, and their places.
void choose_vertices(const HandleSpec& spec, const VertexPlaces& listed,
                     const HandleContext& context, PoseHandle& handle) {
  handle.samples = &context.vertices;
  const std::vector<int>& vertices = context.vertices.vertices;
  if (!spec.move) check_on_surface(*spec.to, listed.vertices, vertices);
  std::vector<int> chosen(vertices.size());
  std::iota(chosen.begin(), chosen.end(), 0);
  if (spec.move) chosen = select(*spec.move, context.selection, context.restored(context.vertices));
  std::vector<Index> rows;
  for (const int k : chosen) {
    const auto entry = std::lower_bound(listed.vertices.begin(), listed.vertices.end(),
                                        vertices[static_cast<std::size_t>(k)]);
    if (entry == listed.vertices.end() || *entry != vertices[static_cast<std::size_t>(k)]) continue;
    handle.selected.push_back(k);
    rows.push_back(entry - listed.vertices.begin());
  }
  if (rows.empty())
    complain(spec.to->place, fmt::format("{} lists no vertex of {}", spec.to->path, spec.part()));
  handle.places = listed.places(rows, Eigen::all);
  handle.places = (handle.places.rowwise() - context.origin.transpose()).eval() / context.unit;
}

}  // namespace

void find_path(const HandleContext& context, PoseHandle& handle) {
  const Points start = handle.mirror ? handle.mirror->points(start_of(handle)) : start_of(handle);
  const Eigen::VectorXd areas = areas_of(handle);
  if (handle.places.rows() == 0) {
    handle.path = make_path(*handle.spec, start.transpose() * areas / areas.sum(), context);
    return;
  }
  handle.path = rigid_path(start, handle.places, areas);
  handle.remainders = handle.places;
  for (Index row = 0; row < start.rows(); ++row)
    handle.remainders.row(row) -= handle.path(start.row(row).transpose(), 1).transpose();
}

Vec3 HandlePath::operator()(const Vec3& x, double share) const {
  const Vec3 stretch = Vec3::Ones() + share * (scale - Vec3::Ones());
  const Vec3 scaled = center + stretch.cwiseProduct(x - center);
  const Vec3 turned = about + Eigen::AngleAxisd(share * radians, axis) * (scaled - about);
  return turned + share * by;
}

Vec3 PoseHandle::start_of(Index row) const {
  if (start.rows() > 0) return start.row(row).transpose();
  return samples->positions.row(selected[static_cast<std::size_t>(row)]).transpose();
}

Vec3 PoseHandle::target(Index row, double share) const {
  const Vec3 x = start_of(row);
  if (spec->fix) return x;  // stays to the last bit
  if (mirror) return mirror->point(path(mirror->point(x), share));
  const Vec3 led = path(x, share);
  return remainders.rows() > 0 ? Vec3(led + share * remainders.row(row).transpose()) : led;
}

SurfaceSamples HandleContext::restored(const SurfaceSamples& scaled) const {
  SurfaceSamples restored = scaled;
  restored.positions = (scaled.positions * unit).rowwise() + origin.transpose();
  return restored;
}

std::vector<PoseHandle> make_handles(const std::vector<HandleSpec>& specs,
                                     const std::vector<VertexPlaces>& targets,
                                     const HandleContext& context) {
  const SurfaceSamples restored = context.restored(context.surface);
  std::vector<PoseHandle> handles(specs.size());
  for (std::size_t h = 0; h < specs.size(); ++h) {
    const HandleSpec& spec = specs[h];
    PoseHandle& handle = handles[h];
    handle.spec = &spec;
    handle.samples = &context.surface;
    if (spec.to)
      choose_vertices(spec, targets[h], context, handle);
    else
      handle.selected = select(spec.fix ? *spec.fix : *spec.move, context.selection, restored);
    handle.thinned = thin_samples(*handle.samples, handle.selected, context.sample_width);
    find_path(context, handle);
  }
  return handles;
}

PoseHandle make_hold(const HandleSpec& spec, std::vector<int> samples,
                     const HandleContext& context) {
  PoseHandle hold;
  hold.spec = &spec;
  hold.samples = &context.surface;
  hold.selected = std::move(samples);
  hold.thinned = thin_samples(context.surface, hold.selected, context.hold_width);
  hold.origin = HandleOrigin::region;
  return hold;
}

void begin_at(Points start, const HandleContext& context, PoseHandle& handle) {
  handle.start = std::move(start);
  find_path(context, handle);
}

HandleSamples::HandleSamples(std::vector<PoseHandle> handles) : handles_(std::move(handles)) {
  std::size_t count = 0;
  double total = 0;
  for (const PoseHandle& handle : handles_) {
    count += handle.thinned.indices.size();
    if (handle.origin != HandleOrigin::region) total += handle.spec->weight;
  }
  rest_.resize(static_cast<Index>(count), 3);
  weights_.resize(static_cast<Index>(count));
  Index row = 0;
  for (std::size_t h = 0; h < handles_.size(); ++h) {
    const PoseHandle& handle = handles_[h];
    const std::vector<int>& selected = handle.selected;
    const ThinnedSamples& thinned = handle.thinned;
    const double share = handle.spec->weight / total / thinned.areas.sum();
    for (std::size_t k = 0; k < thinned.indices.size(); ++k, ++row) {
      rest_.row(row) = handle.samples->positions.row(thinned.indices[k]);
      weights_[row] = share * thinned.areas[static_cast<Index>(k)];
      const auto at = std::lower_bound(selected.begin(), selected.end(), thinned.indices[k]);
      owners_.push_back({h, at - selected.begin()});
    }
  }
}

Points HandleSamples::start() const {
  Points start(rest_.rows(), 3);
  for (Index k = 0; k < rest_.rows(); ++k) {
    const auto& [handle, row] = owners_[static_cast<std::size_t>(k)];
    start.row(k) = handles_[handle].start_of(row).transpose();
  }
  return start;
}

Points HandleSamples::targets(double share) const {
  Points out;
  targets(share, out);
  return out;
}

void HandleSamples::targets(double share, Points& out) const {
  out.resize(rest_.rows(), 3);
  for (Index k = 0; k < rest_.rows(); ++k) {
    const auto& [handle, row] = owners_[static_cast<std::size_t>(k)];
    out.row(k) = handles_[handle].target(row, share).transpose();
  }
}

int substeps_needed(const HandleSamples& handles, Index particles) {
  if (handles.empty()) return 1;
  double turn = 0;
  for (const PoseHandle& handle : handles.handles())
    turn = std::max(turn, std::abs(handle.path.radians));
  const Points start = handles.start(), targets = handles.targets(1);
  const RigidMotion rigid = best_fit_motion(start, targets, handles.weights());
  double bend = 0;
  for (Index k = 0; k < targets.rows(); ++k)
    bend = std::max(bend, (rigid(start.row(k).transpose()) - targets.row(k).transpose()).norm());
  // All handles moving as one body bend nothing, however far they turn.
  if (bend < 1e-9 && turn <= EIGEN_PI) return 1;
  const double finer = std::cbrt(std::max(1.0, double(particles) / particles_at_most_turn));
  const double steps =
      std::ceil(std::max(turn / most_turn_per_step, bend / most_bend_per_step) * finer - 1e-9);
  // One where it is no number.
  return steps > 1 ? static_cast<int>(std::min<double>(steps, PoseSpec::most_substeps)) : 1;
}

}  // namespace supple
