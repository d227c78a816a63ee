#include "modeler/study/reference.h"

#include <cmath>

#include "solver/core/check.h"

namespace supple {
namespace {

constexpr double expected_order = 2;
constexpr double factor_of_three_levels = 1.25, factor_of_doubt = 3;

double spacing(const GridLevel& level) {
  return std::cbrt(1 / level.unknowns);
}

/// e₃₂/e₂₁ for errors of that order; grows with it.
double ratio_of_steps(double order, double r21, double r32) {
  const double fine = std::pow(r21, order);
  return fine * (std::pow(r32, order) - 1) / (fine - 1);
}

/// The order that fits the two steps; none where it is out of all bounds.
std::optional<double> observed_order(double e21, double e32, double r21, double r32) {
  double low = 1e-3, high = 50;
  const double ratio = e32 / e21;
  if (!(e21 > 0) || !(ratio > ratio_of_steps(low, r21, r32)) ||
      !(ratio < ratio_of_steps(high, r21, r32)))
    return std::nullopt;
  constexpr int halvings = 60;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (low + high) / 2;
    (ratio_of_steps(middle, r21, r32) < ratio ? low : high) = middle;
  }
  return low;
}

}  // namespace

double rms_distance(const Points& x, const Points& reference) {
  SUPPLE_CHECK(x.rows() == reference.rows() && x.rows() > 0, "results of one surface");
  return std::sqrt((x - reference).squaredNorm() / static_cast<double>(x.rows()));
}

std::optional<Reference> extrapolate(const std::vector<GridLevel>& all) {
  std::vector<GridLevel> levels;
  for (const GridLevel& level : all)
    if (levels.empty() || level.unknowns > levels.back().unknowns) levels.push_back(level);
  if (levels.size() < 2) return std::nullopt;
  const GridLevel &finest = levels.back(), &middle = levels[levels.size() - 2];
  const double e21 = rms_distance(*finest.positions, *middle.positions);
  const double r21 = spacing(middle) / spacing(finest);
  Reference reference;
  if (levels.size() > 2) {
    const GridLevel& coarse = levels[levels.size() - 3];
    reference.order = observed_order(e21, rms_distance(*middle.positions, *coarse.positions), r21,
                                     spacing(coarse) / spacing(middle));
    reference.plausible =
        reference.order && *reference.order >= least_order && *reference.order <= greatest_order;
  }
  const double order = reference.plausible ? *reference.order : expected_order;
  const double share = 1 / (std::pow(r21, order) - 1);
  reference.positions = *finest.positions + share * (*finest.positions - *middle.positions);
  reference.uncertainty =
      (reference.plausible ? factor_of_three_levels : factor_of_doubt) * share * e21;
  return reference;
}

}  // namespace supple
