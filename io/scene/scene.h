#pragma once

#include <filesystem>
#include <optional>

#include "io/scene/pose_spec.h"
#include "io/scene/shape_spec.h"

namespace supple {

/// What the user asked for.
struct Scene {
  std::filesystem::path folder;  ///< that paths in the scene are relative to
  ShapeSpec shape;
  std::optional<PoseSpec> pose;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit("shape", self.shape, {.doc = "what is deformed"});
    visit("pose", self.pose, {.doc = "one pose by handles"});
  }
};

}  // namespace supple
