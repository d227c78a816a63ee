#pragma once

#include <optional>
#include <string>

#include "modeler/study/study.h"

namespace supple {

/// A setting that a study recommends for a wish of the user's.
struct Choice {
  SceneOverrides settings;
  std::optional<double> error;  ///< as it was verified, over the diagonal
  double seconds = 0;           ///< one run, or the median of those that there were
  bool met = false;
  std::string why_not;  ///< where it is not met
};

/// The cheapest number of particles, and tolerance where it was studied, whose error is `target`
/// [over the diagonal] at most: by the power laws of the study, with the factor 1.25 for safety (3
/// where the order is in doubt) and a tenth of it left to the tolerance. Verified by a run there
/// and one with twice the particles; where that says more than `target`, once more with the
/// factor 3.
Choice choose_for_error(const Study& study, const std::vector<Knob>& chosen, const Runner& run,
                        double target);

/// The most accurate setting of the Pareto front whose slowest run took 0.8 of `seconds` at most.
Choice choose_for_time(const Study& study, double seconds);

}  // namespace supple
