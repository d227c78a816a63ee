#include "solver/energy/energy_sum.h"

#include "solver/core/check.h"

namespace supple {
namespace {

/// ∂/∂u_j of a function with derivative `by_F` at sample k: by_F·∇φ_j.
void scatter_gradient(const Samples& samples, Index k, const Mat3& by_F, Points& gradient) {
  for (int at = samples.row_begin(k); at < samples.row_end(k); ++at)
    gradient.row(samples.particles[static_cast<std::size_t>(at)]) +=
        (by_F * samples.gradients[static_cast<std::size_t>(at)]).transpose();
}

/// The same for a function of f: by_f·φ_j.
void scatter_position(const Samples& samples, Index k, const Vec3& by_f, Points& gradient) {
  for (int at = samples.row_begin(k); at < samples.row_end(k); ++at)
    gradient.row(samples.particles[static_cast<std::size_t>(at)]) +=
        samples.values[static_cast<std::size_t>(at)] * by_f.transpose();
}

double evaluate_group(const EnergyGroup& group, const Points& u, Points* gradient) {
  double value = 0;
  LocalResidual local;
  for (Index k = 0; k < group.samples->size(); ++k) {
    LocalField at;
    at.sample = k;
    std::optional<Completion> completion;
    if (group.argument == Energy::Argument::position) {
      at.f = group.samples->position(k, u);
    } else {
      at.F = group.samples->plain_gradient(k, u);
      completion = group.samples->completion(k, at.F);
      if (completion) at.F = completion->F();
    }
    Eigen::Matrix<double, 9, 1> derivative = Eigen::Matrix<double, 9, 1>::Zero();
    for (const EnergyGroup::Term& term : group.terms) {
      term.energy->evaluate(at, local);
      const double weight = term.weight * group.sample_weights[k];
      for (int row = 0; row < term.energy->rows(); ++row) {
        value += weight * local.r[row] * local.r[row];
        if (gradient)
          derivative += (2 * weight * local.r[row]) * local.jacobian.row(row).transpose();
      }
    }
    if (!gradient) continue;
    if (group.argument == Energy::Argument::position) {
      scatter_position(*group.samples, k, derivative.head<3>(), *gradient);
    } else {
      const Mat3 by_F =
          Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(derivative.data());
      scatter_gradient(*group.samples, k, completion ? completion->by_carried(by_F) : by_F,
                       *gradient);
    }
  }
  return value;
}

}  // namespace

void EnergySum::add(const Energy& energy, const Samples& samples,
                    const Eigen::VectorXd& sample_weights, double weight) {
  SUPPLE_CHECK(sample_weights.size() == samples.size(), "one weight a sample");
  SUPPLE_CHECK(weight > 0, "an energy without weight is not added at all");
  SUPPLE_CHECK(energy.argument() == Energy::Argument::position ||
                   samples.gradients.size() == samples.particles.size(),
               "an energy of F needs samples with gradients");
  for (EnergyGroup& group : groups_)
    if (group.samples == &samples && group.argument == energy.argument() &&
        group.sample_weights == sample_weights) {
      group.terms.push_back({&energy, weight});
      return;
    }
  groups_.push_back({&samples, sample_weights, energy.argument(), {{&energy, weight}}});
}

double EnergySum::evaluate(const Points& u, Points* gradient) const {
  if (gradient) gradient->setZero(particles_, 3);
  double value = 0;
  for (const EnergyGroup& group : groups_) value += evaluate_group(group, u, gradient);
  return value;
}

std::vector<std::pair<std::string, double>> EnergySum::values(const Points& u) const {
  std::vector<std::pair<std::string, double>> values;
  for (const EnergyGroup& group : groups_)
    for (const EnergyGroup::Term& term : group.terms) {
      EnergyGroup alone = group;
      alone.terms = {term};
      values.emplace_back(std::string(term.energy->name()), evaluate_group(alone, u, nullptr));
    }
  return values;
}

}  // namespace supple
