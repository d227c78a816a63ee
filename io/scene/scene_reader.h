#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "io/errors.h"
#include "io/scene/scene.h"

namespace supple {

/// `path.to.key=value` overrides, as given by --set, applied before the scene is checked.
using SceneOverrides = std::vector<std::pair<std::string, std::string>>;

/// Reads a YAML scene. Errors: InputError where the file cannot be read; UsageError with
/// file:line:column, what is wrong, what is allowed and the nearest valid name.
Scene read_scene(const std::filesystem::path& path, const SceneOverrides& overrides = {});

/// The same for text in memory; `name` stands in messages.
Scene read_scene_text(const std::string& text, const std::string& name,
                      const std::filesystem::path& folder, const SceneOverrides& overrides = {});

/// `scene` with values replaced as --set does, of maps only; its rules are checked again.
/// Errors: UsageError that names "--set path=value".
Scene overridden(Scene scene, const SceneOverrides& overrides);

/// The manual of the scene language (Markdown), made from `describe`.
std::string scene_manual();

}  // namespace supple
