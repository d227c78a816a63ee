#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "io/scene/scene_reader.h"
#include "solver/core/report.h"
#include "solver/core/types.h"

namespace supple {

/// What one run of a setting came to.
struct TrialOutcome {
  Status status = Status::not_run;
  std::vector<std::string> reasons;  ///< why it is less than ok
  Points positions;                  ///< of the deformed surface, over the shape's diagonal, n×3
  double seconds = 0;                ///< wall time
  std::vector<std::pair<std::string, double>> stages;  ///< of it, by stage [s]
  int iterations = 0;
  Index unknowns = 0;
  long peak_bytes = 0;  ///< greatest memory that the program held while it ran; 0: not known
};

/// Runs the scene with these values replaced. May give up once it took `most_seconds`.
/// Whatever goes wrong with the setting is told by the outcome; what it throws ends the study.
using Runner = std::function<TrialOutcome(const SceneOverrides& settings, double most_seconds)>;

/// A setting and its runs. They differ in nothing but their times.
struct Trial {
  SceneOverrides settings = {};  ///< none: the scene as it is
  int wanted_runs = 1;
  TrialOutcome outcome = {};  ///< of the fastest run
  std::vector<double> seconds = {};
  std::string skipped = {};  ///< why it did not run

  bool usable() const { return outcome.status == Status::ok || outcome.status == Status::degraded; }
};

}  // namespace supple
