#pragma once

#include <span>
#include <string>

#include "modeler/cli/pose_run.h"
#include "modeler/plan/effect.h"

namespace supple {

/// The effects as a table, what is off below: "rigidity  weights.rigidity is 1, the default".
/// Where the effects took time, with their share of `total_seconds`.
std::string effects_table(std::span<const Effect> effects, double total_seconds = 0);

/// What a person wants to know after a run, in a few lines, and the table of effects.
std::string summary(const PoseRun& run);

}  // namespace supple
