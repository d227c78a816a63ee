#pragma once

#include <filesystem>
#include <string>

#include "modeler/cli/pose_run.h"
#include "modeler/plan/plan.h"

namespace supple {

/// The report of a run as JSON; its keys are stable. Lengths of misses are over the bounding-box
/// diagonal, energies dimensionless, seconds in s. A value that is not finite is null.
std::string report_json(const PoseRun& run);

/// {"effects": {"active": {name: {"because"}}, "off": {name: why}}}.
std::string plan_json(const Plan& plan);

/// Errors: OutputError.
void write_text(const std::string& text, const std::filesystem::path& path);

}  // namespace supple
