#pragma once

#include <string>

#include "io/scene/yaml_tree.h"

namespace supple {

/// Sets the value at a path such as pose.handles[1].weight to `value`, which is read as YAML;
/// missing maps on the way are made. Errors: UsageError that names "--set path=value".
void override_value(YamlNode& scene, const std::string& path, const std::string& value);

}  // namespace supple
