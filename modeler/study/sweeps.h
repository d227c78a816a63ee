#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "modeler/study/knobs.h"
#include "modeler/study/trial.h"

namespace supple {

/// A value of a knob, and the trial that shows what comes of it.
struct SweepPoint {
  std::size_t trial = 0;
  double number = 0;  ///< 0 where the value is a name
};

struct KnobSweep {
  Knob knob;
  std::vector<SweepPoint> points;   ///< one a value of the knob
  std::optional<SweepPoint> exact;  ///< whose result counts as exact
};

/// Every setting is one trial, however many knobs share it: the scene as it is stands in all.
struct Sweeps {
  std::vector<Trial> trials;  ///< in the order in which they run: numbers first, coarse first
  std::vector<KnobSweep> knobs;
};

struct SweepOptions {
  int runs = 3;                                             ///< of each setting that is shown
  double budget = std::numeric_limits<double>::infinity();  ///< for all runs together [s]
  /// Told what runs next, and the share of the runs that is done.
  std::function<void(const std::string& setting, double share)> progress = {};
};

/// "tolerance=1e-06"; "as it is" for the scene's own values.
std::string setting_text(const SceneOverrides& settings);

/// The trials that the knobs call for.
Sweeps plan_sweeps(const std::vector<Knob>& knobs, const SweepOptions& options);

/// Runs every trial once, then those again that are to be timed more often, round by round. No run
/// starts whose time, as the power law t = a·N^b of the knob's runs so far or the scene's own run
/// foretells it, exceeds what is left of the budget; what is left out says so. A name, whose time
/// nothing foretells, is stopped at half of what is left, and at 30 times the scene's own.
void run_sweeps(Sweeps& sweeps, const Runner& run, const SweepOptions& options);

}  // namespace supple
