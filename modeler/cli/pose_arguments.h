#pragma once

#include <string>
#include <vector>

#include "modeler/cli/commands.h"
#include "modeler/cli/picture_arguments.h"
#include "modeler/cli/run_arguments.h"
#include "modeler/cli/scene_arguments.h"
#include "solver/core/report.h"

namespace supple {

/// Which losses of quality do not end the run with an error.
struct Allowance {
  bool everything = false;
  std::vector<ReasonCode> reasons;

  bool covers(const Report& report) const;
};

/// The words of `supple pose`.
struct PoseArguments {
  SceneArguments scene;
  PictureArguments picture_view;
  RunArguments run;
  Allowance allowance;
  std::string mesh, picture, report;  ///< outputs; empty: not asked for

  /// False where the help was printed. Errors: UsageError.
  bool parse(Words words);

  /// Throws OutputError where an output could not be written later.
  void check_outputs() const;

 private:
  void declare_outputs(CommandLine& line);
  void allow(const std::string& reasons);
  void check() const;
};

}  // namespace supple
