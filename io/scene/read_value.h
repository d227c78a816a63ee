#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/scene/complaint.h"
#include "io/scene/named_file.h"
#include "io/scene/scene_rules.h"
#include "io/scene/selection.h"
#include "io/scene/yaml_tree.h"
#include "solver/core/describe.h"

namespace supple {

// Reading one value of a scene into one member. All throw UsageError with the value's place.

void read_value(double& value, const SceneItem& item, const Described& described);
void read_value(int& value, const SceneItem& item, const Described& described);
void read_value(bool& value, const SceneItem& item, const Described& described);
void read_value(std::string& value, const SceneItem& item, const Described& described);
void read_value(Length& value, const SceneItem& item, const Described& described);
void read_value(LengthVector& value, const SceneItem& item, const Described& described);
void read_value(Vec3& value, const SceneItem& item, const Described& described);
void read_value(NamedFile& value, const SceneItem& item, const Described& described);
void read_value(Selection& value, const SceneItem& item, const Described& described);

/// The text of a scalar; `expected` says what should stand there, for the message.
const std::string& scalar_text(const SceneItem& item, std::string_view expected);

/// Throws unless the item is a map, a list.
void require_map(const SceneItem& item);
void require_list(const SceneItem& item, std::string_view expected);

/// Throws where a map has a key that is not in `names`.
void check_keys(const SceneItem& item, std::span<const std::string_view> names,
                std::span<const std::string_view> later);

template <class E>
requires std::is_enum_v<E>
void read_value(E& value, const SceneItem& item, const Described&) {
  std::vector<std::string_view> names;
  const std::string& text = scalar_text(item, "a name");
  for (const auto& [candidate, name] : enum_names(E{})) {
    if (name == text) {
      value = candidate;
      return;
    }
    names.push_back(name);
  }
  complain(item.place, item.path + " = " + in_quotes(text) + allowed_names(text, names));
}

template <class T>
void read_value(std::optional<T>& value, const SceneItem& item, const Described& described) {
  read_value(value ? *value : value.emplace(), item, described);
}

template <class T>
void read_value(std::vector<T>& values, const SceneItem& item, const Described& described) {
  require_list(item, "a list");
  values.resize(item.node->items.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    read_value(values[i], child_item(item, i), described);
}

/// Reads the members of a described struct that are given, after all its keys are known to be
/// valid; then checks what its members must be together.
template <class T>
requires(std::is_class_v<T>) void read_value(T& value, const SceneItem& item, const Described&) {
  require_map(item);
  std::vector<std::string_view> names;
  T::describe(value,
              [&](std::string_view name, auto&, const Described&) { names.push_back(name); });
  check_keys(item, names, later_keys(value));
  T::describe(value, [&](std::string_view name, auto& member, const Described& described) {
    if (const auto child = find_item(item, name)) read_value(member, *child, described);
  });
  if constexpr (requires { value.place; }) value.place = item.place;
  check_rules(value, item);
}

}  // namespace supple
