#include "io/scene/scene_reader.h"

#include <fmt/format.h>

#include "io/file_bytes.h"
#include "io/scene/read_value.h"
#include "io/scene/scene_overrides.h"
#include "io/scene/yaml_tree.h"

namespace supple {
namespace {

constexpr std::string_view version_key = "supple";

/// Takes the version key out of the scene; without one the scene is of this version.
void take_version(YamlNode& root) {
  for (std::size_t i = 0; i < root.keys.size(); ++i) {
    if (root.keys[i].name != version_key) continue;
    int version = 0;
    read_value(version, child_item({&root, "", root.place}, i), {.doc = "", .min = 1});
    if (version != 1)
      complain(
          root.items[i].place,
          fmt::format("supple = {}: this program reads version 1 of the scene language", version));
    root.keys.erase(root.keys.begin() + static_cast<std::ptrdiff_t>(i));
    root.items.erase(root.items.begin() + static_cast<std::ptrdiff_t>(i));
    return;
  }
}

}  // namespace

Scene read_scene_text(const std::string& text, const std::string& name,
                      const std::filesystem::path& folder, const SceneOverrides& overrides) {
  YamlNode root = parse_yaml(text, name);
  for (const auto& [path, value] : overrides) override_value(root, path, value);
  if (root.kind == YamlNode::Kind::null) complain({name, 1, 1}, "the scene is empty");
  take_version(root);
  Scene scene;
  scene.folder = folder;
  read_value(scene, {&root, "", root.place}, {.doc = "the scene"});
  return scene;
}

Scene overridden(Scene scene, const SceneOverrides& overrides) {
  for (const auto& [path, value] : overrides) {
    YamlNode root;
    override_value(root, path, value);
    read_value(scene, {&root, "", root.place}, {.doc = "the scene"});
  }
  return scene;
}

Scene read_scene(const std::filesystem::path& path, const SceneOverrides& overrides) {
  return read_scene_text(read_regular_file(path, largest_scene), path.string(), path.parent_path(),
                         overrides);
}

}  // namespace supple
