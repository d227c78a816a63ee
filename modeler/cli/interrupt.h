#pragma once

namespace supple {

/// Turns SIGINT and SIGTERM into a question that the run asks, as long as it lives, so that a run
/// ends where nothing is half-written. A second signal ends the program at once.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  /// The signal that came; 0 if none.
  static int signal();

  /// Throws Interrupted if a signal came.
  static void check();
};

}  // namespace supple
