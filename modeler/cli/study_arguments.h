#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "modeler/cli/commands.h"
#include "modeler/cli/run_arguments.h"
#include "modeler/cli/scene_arguments.h"

namespace supple {

/// The words of `supple study`.
struct StudyArguments {
  SceneArguments scene;
  RunArguments run;
  std::string folder, report;  ///< outputs; no report: empty
  std::vector<std::string> knobs;
  int levels = 5;
  double budget = std::numeric_limits<double>::infinity();  ///< [s]
  std::optional<double> target_error;                       ///< over the diagonal
  std::optional<double> time_budget;                        ///< of one pose [s]

  /// False where the help was printed. Errors: UsageError.
  bool parse(Words words);

 private:
  void declare_study(CommandLine& line);
};

}  // namespace supple
