#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/scene/yaml_tree.h"

namespace supple {

/// A value of a scene, its name from the top ("pose.handles[1].weight"), and where to complain.
struct SceneItem {
  const YamlNode* node;
  std::string path;
  Place place;
};

/// The value in a map or list with that index.
SceneItem child_item(const SceneItem& parent, std::size_t index);

/// The value of that key in a map, if it is given.
std::optional<SceneItem> find_item(const SceneItem& parent, std::string_view key);

/// "pose.weights", or "weights" at the top.
std::string joined_path(const std::string& parent, std::string_view key);

}  // namespace supple
