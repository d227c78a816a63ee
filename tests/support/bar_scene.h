#pragma once

#include <string>

#include <fmt/format.h>

#include "io/scene/scene_reader.h"

namespace supple {

/// A scene of "bar.obj", which need not exist, with these lines below `pose:`.
inline Scene scene_with(const std::string& pose, int particles = 200) {
  return read_scene_text(
      fmt::format("shape: {{mesh: bar.obj, particles: {}}}\npose:\n{}", particles, pose), "test",
      "");
}

}  // namespace supple
