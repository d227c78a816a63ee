#include "solver/minimize/lbfgs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace supple {
namespace {

// Of a step of length t along d: E(t) ≤ E(0) + decrease·t·E'(0), and E'(t) ≥ curvature·E'(0).
constexpr double decrease = 1e-4, curvature = 0.9;

constexpr int most_trials = 40;

/// C lies above half the Hessian: a step of this share of C⁻¹ g does not overshoot.
constexpr double first_scale = 0.5;

/// What a step could win, over the energy: less is rounding.
constexpr double no_gain = 1e-15;

double dot(const PaddedPoints& a, const PaddedPoints& b) {
  return a.cwiseProduct(b).sum();
}

/// A place on the way: its length, the energy and the energy's slope there.
struct Place {
  double t, value, slope;
};

/// Where the cubic through both places has its minimum; the middle where it has none well inside.
double between(const Place& a, const Place& b) {
  const double width = b.t - a.t, margin = 0.1 * std::abs(width);
  const double theta = 3 * (a.value - b.value) / width + a.slope + b.slope;
  const double root = std::sqrt(theta * theta - a.slope * b.slope);
  const double t = b.t - width * (b.slope + root - theta) / (b.slope - a.slope + 2 * root);
  const bool inside =
      t > std::min(a.t, b.t) + margin && t < std::max(a.t, b.t) - margin;  // false of NaN
  return inside ? t : a.t + 0.5 * width;
}

}  // namespace

Lbfgs::Result Lbfgs::minimize(const EnergySum& energy, const Preconditioner& preconditioner,
                              const MinimizeOptions& options, const HardConstraints* constraints,
                              PaddedPoints& u) {
  const Problem problem{energy, preconditioner, constraints, Deadline(options.most_seconds)};
  Result result;
  forget();
  result.energy = evaluate(problem, u, result);
  if (!std::isfinite(result.energy)) {
    ++result.not_finite;
    result.stop = Stop::stuck;
    return result;
  }
  derive_by_unknowns(problem);
  // A minimum of zero, as of a rigid motion, is come closer to for ever.
  const double nothing = options.tolerance * options.tolerance * result.energy;
  while (result.iterations < options.max_iterations) {
    choose_direction(problem);
    const double gain = -dot(direction_, by_y_);
    if (!(gain > no_gain * result.energy)) return result;
    if (problem.deadline.over()) {
      result.stop = Stop::out_of_time;
      return result;
    }
    const double before = result.energy;
    if (walk(problem, u, result)) {
      ++result.iterations;
      if (before - result.energy <= options.tolerance * before || result.energy <= nothing)
        return result;
    } else if (problem.deadline.over()) {
      continue;  // told above
    } else if (kept_ > 0) {
      ++result.restarts;
      forget();
    } else {
      result.stop = Stop::stuck;
      return result;
    }
  }
  result.stop = Stop::max_iterations;
  return result;
}

/// The two loops: from the newest pair to the oldest, and back.
void Lbfgs::choose_direction(const Problem& problem) {
  direction_ = -by_y_;
  for (std::size_t age = 0; age < kept_; ++age) {
    Pair& at = pair(age);
    at.share = dot(at.s, direction_) / at.sy;
    direction_ -= at.share * at.y;
  }
  direction_ *= scale_;
  for (std::size_t age = kept_; age-- > 0;) {
    const Pair& at = pair(age);
    direction_ += (at.share - dot(at.y, direction_) / at.sy) * at.s;
  }
  problem.preconditioner.to_displacements(direction_, step_);
}

bool Lbfgs::walk(const Problem& problem, PaddedPoints& u, Result& result) {
  const Place start{0, result.energy, dot(direction_, by_y_)};
  Place low = start, high{std::numeric_limits<double>::infinity(), 0, 0};
  double t = 1;
  for (int trial = 0; trial < most_trials && !problem.deadline.over(); ++trial) {
    trial_ = u + t * step_;
    const Place here{t, evaluate(problem, trial_, result), dot(by_u_, step_)};
    if (!std::isfinite(here.value) || !std::isfinite(here.slope)) {
      result.not_finite += !beyond_a_barrier(here.value);
      high = {t, std::numeric_limits<double>::quiet_NaN(), 0};
    } else if (here.value > start.value + decrease * t * start.slope) {
      high = here;
    } else if (here.slope < curvature * start.slope) {
      low = here;
    } else {
      u.swap(trial_);
      result.energy = here.value;
      derive_by_unknowns(problem);
      remember(t);
      return true;
    }
    t = std::isfinite(high.t) ? between(low, high) : 2 * t;
  }
  return false;
}

double Lbfgs::evaluate(const Problem& problem, const PaddedPoints& u, Result& result) {
  ++result.evaluations;
  return problem.energy.evaluate_padded(u, &by_u_);
}

void Lbfgs::derive_by_unknowns(const Problem& problem) {
  by_y_.swap(by_y_before_);
  problem.preconditioner.to_gradient(by_u_, by_y_);
  if (problem.constraints) problem.constraints->project(by_y_, tied_);
}

void Lbfgs::remember(double length) {
  Pair& at = pairs_[next_];
  at.s = length * direction_;
  at.y = by_y_ - by_y_before_;
  at.sy = dot(at.s, at.y);
  if (!(at.sy > 0)) return;
  scale_ = at.sy / at.y.squaredNorm();
  next_ = (next_ + 1) % most_pairs;
  kept_ = std::min(kept_ + 1, most_pairs);
}

void Lbfgs::forget() {
  kept_ = 0;
  scale_ = first_scale;
}

}  // namespace supple
