#pragma once

#include "modeler/cli/command_line.h"

namespace supple {

/// --threads and --quiet, which every command takes that works for a while.
struct RunArguments {
  int threads = 0;  ///< 0: as many as the machine has
  bool quiet = false;

  /// Declares the options; `*this` must outlive the parsing.
  void declare(CommandLine& line);

  /// Works with `threads` from now on.
  void limit_threads() const;
};

}  // namespace supple
