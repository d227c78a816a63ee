#pragma once

#include <filesystem>
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
  std::string mesh, picture, report;  ///< outputs; empty: not asked for; "-": standard output
  std::string format;                 ///< of the mesh; empty: by its name

  /// False where the help was printed. Errors: UsageError.
  bool parse(Words words);

  /// What write_mesh is to write: `format`, or, where the output has no name, that of `input`,
  /// or else OBJ.
  std::string mesh_format(const std::filesystem::path& input) const;

  /// Throws OutputError where an output could not be written later.
  void check_outputs() const;

 private:
  void declare_outputs(CommandLine& line);
  void allow(const std::string& reasons);
  void check() const;
};

}  // namespace supple
