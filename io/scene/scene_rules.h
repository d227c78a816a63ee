#pragma once

#include <span>
#include <string_view>

#include "io/scene/scene.h"
#include "io/scene/scene_item.h"

namespace supple {

// Keys of the scene language that this version does not read yet: "not available yet".
std::span<const std::string_view> later_keys(const Scene&);
std::span<const std::string_view> later_keys(const ShapeSpec&);
template <class T>
std::span<const std::string_view> later_keys(const T&) {
  return {};
}

// What the members of one struct must be together. They throw UsageError.
void check_rules(const Scene& scene, const SceneItem& item);
void check_rules(const ShapeSpec& shape, const SceneItem& item);
void check_rules(const PoseSpec& pose, const SceneItem& item);
void check_rules(const HandleSpec& handle, const SceneItem& item);
void check_rules(const TurnSpec& turn, const SceneItem& item);
void check_rules(const MirrorSpec& mirror, const SceneItem& item);
void check_rules(const StiffnessSpec& stiffness, const SceneItem& item);
template <class T>
void check_rules(const T&, const SceneItem&) {}

}  // namespace supple
