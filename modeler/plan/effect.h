#pragma once

#include <string>

namespace supple {

/// One thing that a run may do, and why it does or does not.
struct Effect {
  std::string name;
  bool active = false;
  std::string why;     ///< "scene.yaml:9:5: weights.volume is 1", or why it is off
  double seconds = 0;  ///< filled in by the run
};

}  // namespace supple
