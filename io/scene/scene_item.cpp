#include "io/scene/scene_item.h"

#include <fmt/format.h>

namespace supple {

SceneItem child_item(const SceneItem& parent, std::size_t index) {
  const YamlNode& node = parent.node->items[index];
  if (parent.node->kind == YamlNode::Kind::sequence)
    return {&node, fmt::format("{}[{}]", parent.path, index), node.place};
  const YamlKey& key = parent.node->keys[index];
  const bool is_null = node.kind == YamlNode::Kind::null;  // it stands anywhere behind its key
  return {&node, joined_path(parent.path, key.name), is_null ? key.place : node.place};
}

std::optional<SceneItem> find_item(const SceneItem& parent, std::string_view key) {
  for (std::size_t i = 0; i < parent.node->keys.size(); ++i)
    if (parent.node->keys[i].name == key) return child_item(parent, i);
  return std::nullopt;
}

std::string joined_path(const std::string& parent, std::string_view key) {
  return parent.empty() ? std::string(key) : fmt::format("{}.{}", parent, key);
}

}  // namespace supple
