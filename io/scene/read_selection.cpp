#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "io/scene/read_value.h"
#include "io/scene/selection_check.h"

namespace supple {
namespace {

using Kind = Selection::Kind;

constexpr std::array<std::string_view, 8> forms{"box",   "sphere", "nearest", "vertices",
                                                "group", "and",    "or",      "not"};

std::string to_text(const LengthVector& v) {
  return fmt::format("{},{},{}", to_string(v[0]), to_string(v[1]), to_string(v[2]));
}

template <class T>
void read_needed(T& value, const SceneItem& item, std::string_view key) {
  const auto child = find_item(item, key);
  if (!child) complain(item.place, fmt::format("{}.{} is missing", item.path, key));
  read_value(value, *child, Described{});
}

Selection read_box(const SceneItem& item) {
  constexpr std::array<std::string_view, 2> keys{"min", "max"};
  require_map(item);
  check_keys(item, keys, {});
  Selection box;
  box.kind = Kind::box;
  read_needed(box.lower, item, "min");
  read_needed(box.upper, item, "max");
  box.text = fmt::format("box({},{})", to_text(box.lower), to_text(box.upper));
  return box;
}

Selection read_sphere(const SceneItem& item) {
  constexpr std::array<std::string_view, 2> keys{"center", "radius"};
  require_map(item);
  check_keys(item, keys, {});
  Selection sphere;
  sphere.kind = Kind::sphere;
  read_needed(sphere.center, item, "center");
  read_needed(sphere.radius, item, "radius");
  sphere.text = fmt::format("sphere({},{})", to_text(sphere.center), to_string(sphere.radius));
  return sphere;
}

Selection read_nearest(const SceneItem& item) {
  Selection nearest;
  nearest.kind = Kind::nearest;
  read_value(nearest.center, item, Described{});
  nearest.text = fmt::format("nearest({})", to_text(nearest.center));
  return nearest;
}

Selection read_named(Kind kind, std::string_view form, const SceneItem& item) {
  Selection named;
  named.kind = kind;
  read_value(named.name, item, Described{});
  named.text = fmt::format("{}({})", form, named.name);
  return named;
}

Selection read_list(Kind kind, std::string_view joint, const SceneItem& item) {
  Selection list;
  list.kind = kind;
  read_value(list.parts, item, Described{});
  if (list.parts.empty())
    complain(item.place, fmt::format("{} is empty, must be a list of selections", item.path));
  if (list.parts.size() == 1) return Selection(list.parts[0]);
  std::vector<std::string> texts;
  for (const Selection& part : list.parts) texts.push_back("(" + part.text + ")");
  list.text = fmt::format("{}", fmt::join(texts, fmt::format(" {} ", joint)));
  return list;
}

Selection read_negation(const SceneItem& item) {
  Selection negation;
  negation.kind = Kind::negation;
  read_value(negation.parts.emplace_back(), item, Described{});
  negation.text = fmt::format("not ({})", negation.parts[0].text);
  return negation;
}

Selection read_form(std::string_view form, const SceneItem& item) {
  if (form == "box") return read_box(item);
  if (form == "sphere") return read_sphere(item);
  if (form == "nearest") return read_nearest(item);
  if (form == "vertices") return read_named(Kind::vertices, form, item);
  if (form == "group") return read_named(Kind::group, form, item);
  if (form == "and") return read_list(Kind::all, form, item);
  if (form == "or") return read_list(Kind::any, form, item);
  return read_negation(item);
}

}  // namespace

void read_value(Selection& value, const SceneItem& item, const Described&) {
  const YamlNode& node = *item.node;
  if (node.kind != YamlNode::Kind::map) {
    value = parse_selection(scalar_text(item, "a selection, as y<10% or {box: …}"), item.place);
    return;
  }
  check_keys(item, forms, {});
  if (node.keys.size() != 1)
    complain(item.place, fmt::format("{} has {} keys, must have one; join selections as in "
                                     "{{and: [y<10%, {{group: arm}}]}}",
                                     item.path, node.keys.size()));
  value = read_form(node.keys[0].name, child_item(item, 0));
  value.place = item.place;
  check_selection(value);
}

}  // namespace supple
