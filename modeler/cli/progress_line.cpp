#include "modeler/cli/progress_line.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace supple {

ProgressLine::ProgressLine(Mode mode)
    : shows_(mode == Mode::if_terminal && ::isatty(STDERR_FILENO) != 0) {}

void ProgressLine::show(const std::string& stage, double share) {
  if (!shows_) return;
  const int percent = static_cast<int>(std::floor(100 * std::clamp(share, 0.0, 1.0)));
  std::string line = fmt::format("{:<8} {:3} %", stage, percent);
  if (line == shown_) return;
  fmt::print(stderr, "\r\x1b[K{}", line);
  std::fflush(stderr);
  shown_ = std::move(line);
}

void ProgressLine::clear() {
  if (shown_.empty()) return;
  fmt::print(stderr, "\r\x1b[K");
  std::fflush(stderr);
  shown_.clear();
}

}  // namespace supple
