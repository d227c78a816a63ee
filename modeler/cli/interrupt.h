#pragma once

namespace supple {

/// Turns SIGINT and SIGTERM into a question that the run asks, as long as it lives, so that a run
/// ends where nothing is half-written. Where none is asked for within a second, the program ends
/// there, and what was half-written goes; at a second signal it ends at once.
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
