#include "modeler/pose/inversion_guard.h"

#include <Eigen/LU>
#include <vector>

namespace supple {
namespace {

constexpr int most_ways = 16;

/// Where some vertices are inside out, those are guarded that are nearly so as well: else they are
/// the next to turn.
constexpr double guarded_below = InversionBarrier::felt_below / 2;

}  // namespace

InversionGuard::InversionGuard(const Solid& solid, const SolidField& field, PoseSolver& solver)
    : solid_(solid), field_(field), solver_(solver), guarded_(solid.used_vertices().size(), false) {
  solver.forbid_inversion();
}

Report InversionGuard::solve(PoseSolveOptions options,
                             const std::function<void(double share)>& on_step, Points& u) {
  const Points start = u;
  const bool inverted_start = count_inversions(field_.quadrature, start).inverted > 0;
  const Deadline deadline(options.most_seconds);
  for (int way = 1;; ++way) {
    Report report =
        inverted_start ? solver_.repair(options, u) : solver_.solve(options, on_step, u);
    if (report.status == Status::failed) return report;
    const std::vector<Index> more = more_to_guard(u);
    if (more.empty() || way == most_ways) return report;
    if (deadline.over()) {
      u = start;
      report.energies = solver_.energies_at_end(u);
      const Reason late{ReasonCode::out_of_time, 1, 0,
                        "no time was left to keep vertices from turning inside out: the pose is "
                        "where its way starts"};
      if (Reason* told = report.find(late.code))
        *told = late;
      else
        report.degrade(late);
      return report;
    }
    guard(more);
    options.most_seconds = deadline.left();
    u = start;
  }
}

/// Vertices to guard that are not yet; none where none is inside out.
std::vector<Index> InversionGuard::more_to_guard(const Points& u) const {
  const DeformedSurface surface = field_.surface.deform(u, solid_.particles().volumes);
  std::vector<Index> more;
  bool inverted = false;
  for (std::size_t i = 0; i < surface.gradients.size(); ++i) {
    if (!solid_.used_vertices()[i]) continue;
    const double J = surface.gradients[i].determinant();
    if (!(J >= guarded_below) && !guarded_[i]) more.push_back(static_cast<Index>(i));
    inverted |= !(J > 0);
  }
  if (!inverted) more.clear();
  return more;
}

void InversionGuard::guard(const std::vector<Index>& vertices) {
  for (const Index i : vertices) guarded_[static_cast<std::size_t>(i)] = true;
  solver_.forbid_inversion_at(field_.mls, solid_.inner_vertices()(vertices, Eigen::all));
}

}  // namespace supple
