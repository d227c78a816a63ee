#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "modeler/pose/pose.h"

namespace supple {

/// A run of `supple pose`, whether it came to a result or not: what its report and summary tell.
struct PoseRun {
  std::string input;                           ///< the shape or scene, as the user named it
  std::vector<std::filesystem::path> outputs;  ///< what was written
  std::optional<PoseResult> result;
  std::string failure;       ///< why there is no result
  double load_seconds = 0;   ///< reading the scene and the shape
  double write_seconds = 0;  ///< the mesh and the picture
  double total_seconds = 0;

  Status status() const { return result ? result->report.status : Status::failed; }
};

}  // namespace supple
