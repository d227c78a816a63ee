#include "solver/energy/energy_sum.h"

#include <algorithm>
#include <optional>

#include "solver/core/check.h"

namespace supple {
namespace {

/// Of a displacement or its derivative, a register.
using Padded = Eigen::Vector4d;

/// Walks the samples with a short span along with the others, which come in the same order.
class Completions {
 public:
  explicit Completions(const Samples& samples) : next_(samples.short_spans.begin()) {
    end_ = samples.short_spans.end();
  }

  /// Of sample k, greater than all before.
  std::optional<Completion> at(Index k, const Mat3& plain) {
    if (next_ == end_ || next_->sample != k) return std::nullopt;
    const Span& span = (next_++)->span;
    return Completion(plain - span.missing(), span);
  }

 private:
  std::vector<Samples::ShortSpan>::const_iterator next_, end_;
};

/// Σ_terms λ ω |r|² at one sample, and its derivative.
double add_terms(const EnergyGroup& group, const LocalField& at, LocalDerivative& derivative) {
  double value = 0;
  for (const EnergyGroup::Term& term : group.terms)
    value += term.energy->add_square(at, term.weight * group.sample_weights[at.sample], derivative);
  return value;
}

double evaluate_positions(const EnergyGroup& group, const PaddedPoints& u, PaddedPoints* gradient) {
  const Samples& samples = *group.samples;
  double value = 0;
  LocalField at;
  for (Index k = 0; k < samples.size(); ++k) {
    const int begin = samples.row_begin(k), end = samples.row_end(k);
    const int* particles = samples.particles.data();
    const double* phi = samples.values.data();
    Padded sum = Padded::Zero();
    for (int e = begin; e < end; ++e) sum += phi[e] * u.row(particles[e]).transpose();
    at.sample = k;
    at.f = samples.points.row(k).transpose() + sum.head<3>();
    LocalDerivative derivative;
    value += add_terms(group, at, derivative);
    if (!gradient) continue;
    const Padded by_f(derivative.by_f[0], derivative.by_f[1], derivative.by_f[2], 0);
    for (int e = begin; e < end; ++e) gradient->row(particles[e]) += phi[e] * by_f.transpose();
  }
  return value;
}

double evaluate_gradients(const EnergyGroup& group, const PaddedPoints& u, PaddedPoints* gradient) {
  const Samples& samples = *group.samples;
  double value = 0;
  Completions completions(samples);
  LocalField at;
  for (Index k = 0; k < samples.size(); ++k) {
    const int begin = samples.row_begin(k), end = samples.row_end(k);
    const int* particles = samples.particles.data();
    const Vec3* slopes = samples.gradients.data();
    Padded x = Padded::UnitX(), y = Padded::UnitY(), z = Padded::UnitZ();  // columns of F
    for (int e = begin; e < end; ++e) {
      const Padded u_j = u.row(particles[e]);
      x += slopes[e][0] * u_j;
      y += slopes[e][1] * u_j;
      z += slopes[e][2] * u_j;
    }
    at.sample = k;
    at.F << x.head<3>(), y.head<3>(), z.head<3>();
    const std::optional<Completion> completion = completions.at(k, at.F);
    if (completion) at.F = completion->F();
    LocalDerivative derivative;
    value += add_terms(group, at, derivative);
    if (!gradient) continue;
    if (completion) derivative.by_F = completion->by_carried(derivative.by_F);
    x.head<3>() = derivative.by_F.col(0);
    y.head<3>() = derivative.by_F.col(1);
    z.head<3>() = derivative.by_F.col(2);
    x[3] = y[3] = z[3] = 0;
    for (int e = begin; e < end; ++e)
      gradient->row(particles[e]) +=
          (slopes[e][0] * x + slopes[e][1] * y + slopes[e][2] * z).transpose();
  }
  return value;
}

double evaluate_group(const EnergyGroup& group, const PaddedPoints& u, PaddedPoints* gradient) {
  return group.argument == Energy::Argument::position ? evaluate_positions(group, u, gradient)
                                                      : evaluate_gradients(group, u, gradient);
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

double EnergySum::evaluate_padded(const PaddedPoints& u, PaddedPoints* gradient) const {
  if (gradient) gradient->setZero(particles_, 4);
  double value = 0;
  for (const EnergyGroup& group : groups_) value += evaluate_group(group, u, gradient);
  return value;
}

double EnergySum::evaluate(const Points& u, Points* gradient) const {
  if (!gradient) return evaluate_padded(padded(u));
  PaddedPoints by_u;
  const double value = evaluate_padded(padded(u), &by_u);
  *gradient = by_u.leftCols<3>();
  return value;
}

std::vector<std::pair<std::string, double>> EnergySum::values(const Points& u) const {
  std::vector<std::pair<std::string, double>> values;
  for (const EnergyGroup& group : groups_)
    for (const EnergyGroup::Term& term : group.terms) {
      EnergyGroup alone = group;
      alone.terms = {term};
      const std::string name(term.energy->name());
      auto entry = std::find_if(values.begin(), values.end(),
                                [&](const auto& value) { return value.first == name; });
      if (entry == values.end()) entry = values.emplace(values.end(), name, 0);
      entry->second += evaluate_group(alone, padded(u), nullptr);
    }
  return values;
}

}  // namespace supple
