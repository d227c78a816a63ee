#pragma once

#include <string>
#include <vector>

#include "io/scene/pose_spec.h"
#include "modeler/cli/command_line.h"

namespace supple {

/// --fix, --move and what binds to the --move before it: --to, --by, --turn, --scale, --about,
/// --weight.
class HandleArguments {
 public:
  /// Declares the options; `*this` must outlive the parsing.
  void declare(CommandLine& line);

  /// The handles in the order in which they were given; a place is "--move y>85%".
  /// Errors: UsageError where an --about stands without a --turn.
  std::vector<HandleSpec> take();

 private:
  /// A handle and what was said of it so far.
  struct Draft {
    HandleSpec handle;
    std::optional<LengthVector> about;
    std::vector<std::string> given;
  };

  static void check_to(const Draft& draft);
  void add_fix(const std::string& selection);
  void add_move(const std::string& selection);
  void set_to(const std::string& value);
  void set_by(const std::string& value);
  void set_turn(const std::string& value);
  void set_scale(const std::string& value);
  void set_about(const std::string& value);
  void set_weight(const std::string& value);

  Draft& last_move(const std::string& option, const std::string& value);
  Draft& last_handle(const std::string& option, const std::string& value);

  std::vector<Draft> drafts_;
};

}  // namespace supple
