#pragma once

#include "io/scene/pose_spec.h"
#include "modeler/cli/command_line.h"

namespace supple {

/// What a pose asks for beside its handles: --from, --stiffen and the --times that binds to it.
class PartArguments {
 public:
  /// Declares the options; `*this` must outlive the parsing.
  void declare(CommandLine& line);

  /// True where any of them was given.
  bool given() const;

  /// Puts what was given into `pose`. Errors: UsageError where a --stiffen has no --times.
  void give(PoseSpec& pose) const;

 private:
  void check_times() const;
  void add_stiffness(const std::string& selection);
  void set_times(const std::string& value);

  std::optional<NamedFile> from_;
  std::vector<StiffnessSpec> stiffness_;
  std::size_t with_times_ = 0;  ///< so many have their --times
};

}  // namespace supple
