#include "modeler/pose/no_inversion.h"

#include <Eigen/LU>
#include <vector>

namespace supple {
namespace {

constexpr int most_ways = 16;

/// Where some vertices are inside out, those are guarded that are nearly so as well: else they are
/// the next to turn.
constexpr double guarded_below = InversionBarrier::felt_below / 2;

/// Vertices to guard that are not yet; none where none is inside out.
std::vector<Index> more_to_guard(const Solid& solid, const SolidField& field, const Points& u,
                                 const std::vector<bool>& guarded) {
  const DeformedSurface surface = field.surface.deform(u, solid.particles().volumes);
  std::vector<Index> more;
  bool inverted = false;
  for (std::size_t i = 0; i < surface.gradients.size(); ++i) {
    if (!solid.used_vertices()[i]) continue;
    const double J = surface.gradients[i].determinant();
    if (!(J >= guarded_below) && !guarded[i]) more.push_back(static_cast<Index>(i));
    inverted |= !(J > 0);
  }
  if (!inverted) more.clear();
  return more;
}

}  // namespace

Report solve_without_inversion(const Solid& solid, const SolidField& field,
                               PoseSolveOptions options,
                               const std::function<void(double share)>& on_step, PoseSolver& solver,
                               Points& u) {
  const Points start = u;
  std::vector<bool> guarded(solid.used_vertices().size(), false);
  const Deadline deadline(options.most_seconds);
  solver.forbid_inversion();
  for (int way = 1;; ++way) {
    Report report = solver.solve(options, on_step, u);
    if (report.status == Status::failed || way == most_ways || deadline.over()) return report;
    const std::vector<Index> more = more_to_guard(solid, field, u, guarded);
    if (more.empty()) return report;
    for (const Index i : more) guarded[static_cast<std::size_t>(i)] = true;
    solver.forbid_inversion_at(field.mls, solid.inner_vertices()(more, Eigen::all));
    options.most_seconds = deadline.left();
    u = start;
  }
}

}  // namespace supple
