#pragma once

#include <string>

namespace supple {

/// One line on the terminal that is rewritten in place: "solve  42 %". Silent where standard error
/// is not a terminal.
class ProgressLine {
 public:
  enum class Mode { if_terminal, silent };

  explicit ProgressLine(Mode mode);
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// `share` of the stage that is done, in [0, 1].
  void show(const std::string& stage, double share);

  /// Wipes the line, so that other text can follow.
  void clear();

 private:
  bool shows_;
  std::string shown_;
};

}  // namespace supple
