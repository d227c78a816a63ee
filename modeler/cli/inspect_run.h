#pragma once

#include <optional>
#include <string>
#include <vector>

#include "modeler/inspect/inspection.h"

namespace supple {

/// A run of `supple inspect`: what its text and its JSON tell.
struct InspectRun {
  std::string input;  ///< the file, as the user named it
  Mesh mesh;
  Inspection inspection;
  std::string selection;  ///< as the user wrote it; empty: none
  std::optional<SelectedPart> selected;
  std::vector<std::string> outputs;  ///< what was written
  double load_seconds = 0, total_seconds = 0;
};

/// What helps with this shape, a sentence each: its particles, its units.
std::vector<std::string> advice(const InspectRun& run);

/// What a person wants to know, in short sections.
std::string inspect_text(const InspectRun& run);

/// The same, whole, as JSON; its keys are stable (docs/inspect.md).
std::string inspect_json(const InspectRun& run);

}  // namespace supple
