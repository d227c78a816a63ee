#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

namespace supple {

/// How a child ended.
enum class ChildEnd {
  done,         ///< by itself; `code` says with what
  killed,       ///< by signal `code`
  too_long,     ///< it took more time than it may
  too_much,     ///< it wrote more bytes than it may
  unknown,      ///< the system keeps no account: SIGCHLD is ignored
  cannot_start  ///< errno in `code`
};

struct ChildResult {
  ChildEnd end = ChildEnd::done;
  int code = 0;
  std::string out, err;  ///< what it wrote to standard output and standard error
};

struct ChildLimits {
  std::chrono::duration<double> time;
  std::size_t output_bytes;
};

/// Runs `words` (the program first) and takes what it writes, until it ends or a limit is reached;
/// then it is gone.
ChildResult run_child(const std::vector<std::string>& words, const ChildLimits& limits);

}  // namespace supple
