#pragma once

#include <cmath>
#include <string>

#include "modeler/study/study.h"

namespace supple {

/// A problem whose results, errors and times are known: x = x* + a·h^order·(a fixed field) +
/// √tolerance·(another), with h = N^(−1/3), in t = N^time_exponent/1000 s.
struct Manufactured {
  double order = 2;
  double size = 1;  ///< a: of the error
  double time_exponent = 1.5;
  Points exact = Points::Random(50, 3), error_field = Points::Random(50, 3),
         solver_field = 1e-3 * Points::Random(50, 3);

  /// Of a setting; without one as the scene is: 200 particles, tolerance 1e-6.
  static double value(const SceneOverrides& settings, const std::string& key, double usual) {
    for (const auto& [name, text] : settings)
      if (name == key) return std::stod(text);
    return usual;
  }

  Points result(double particles, double tolerance) const {
    return exact + size * std::pow(particles, -order / 3) * error_field +
           std::sqrt(tolerance) * solver_field;
  }

  TrialOutcome operator()(const SceneOverrides& settings, double) const {
    const double particles = value(settings, "shape.particles", 200);
    TrialOutcome outcome;
    outcome.status = Status::ok;
    outcome.positions = result(particles, value(settings, "pose.tolerance", 1e-6));
    outcome.seconds = std::pow(particles, time_exponent) / 1000;
    outcome.unknowns = static_cast<Index>(3 * particles);
    outcome.stages = {{"solve", outcome.seconds}};
    return outcome;
  }
};

inline Knob particles_knob() {
  return {.name = "particles",
          .key = "shape.particles",
          .values = {"100", "200", "400", "800", "1600"},
          .numbers = {100, 200, 400, 800, 1600},
          .own = 1,
          .exact = "",
          .converges = true};
}

inline Knob tolerance_knob() {
  return {.name = "tolerance",
          .key = "pose.tolerance",
          .values = {"0.01", "0.0001", "1e-06", "1e-08"},
          .numbers = {1e-2, 1e-4, 1e-6, 1e-8},
          .own = 2,
          .exact = "1e-16",
          .converges = false};
}

inline Knob solver_knob() {
  return {.name = "solver",
          .key = "pose.solver",
          .values = {"good", "worse", "broken"},
          .numbers = {},
          .own = 0,
          .exact = "",
          .converges = false};
}

}  // namespace supple
