#include "io/scene/read_value.h"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

namespace supple {
namespace {

using Kind = YamlNode::Kind;

constexpr std::array<std::string_view, 4> boolean_words{"yes", "no", "on", "off"};

/// YAML 1.1 reads these words without quotes as booleans, whatever the letter case.
bool is_boolean_word(const YamlNode& node) {
  if (node.quoted) return false;
  std::string lower = node.text;
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return lower == "true" || lower == "false" ||
         std::find(boolean_words.begin(), boolean_words.end(), lower) != boolean_words.end();
}

std::string_view kind_name(const YamlNode& node) {
  if (node.kind == Kind::map) return "a map";
  return node.kind == Kind::sequence ? "a list" : "text";
}

/// Throws unless the item has a value of that kind.
void require_kind(const SceneItem& item, Kind kind, std::string_view expected) {
  if (item.node->kind == kind) return;
  const std::string path = item.path.empty() ? "the scene" : item.path;
  if (item.node->kind == Kind::null)
    complain(item.place, fmt::format("{} has no value, must be {}", path, expected));
  const bool lacks_space = kind == Kind::map && item.node->text.find(':') != std::string::npos;
  complain(item.place, fmt::format("{} is {}, must be {}{}", path, kind_name(*item.node), expected,
                                   lacks_space ? "; a space is missing after ':'" : ""));
}

std::string interval(const Described& described) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::string lower, upper;
  if (described.min > -infinity)
    lower = fmt::format("{} {}", described.exclusive_min ? ">" : ">=", described.min);
  if (described.max < infinity) upper = fmt::format("<= {}", described.max);
  return lower + (!lower.empty() && !upper.empty() ? " and " : "") + upper;
}

void check_bounds(double value, const SceneItem& item, const Described& described) {
  const bool below = described.exclusive_min ? value <= described.min : value < described.min;
  if (below || value > described.max)
    complain(item.place,
             fmt::format("{} = {}, must be {}", item.path, item.node->text, interval(described)));
}

/// The text of a number: not in quotes.
const std::string& number_text(const SceneItem& item, std::string_view expected) {
  const std::string& text = scalar_text(item, expected);
  if (item.node->quoted)
    complain(item.place, fmt::format("{} is text in quotes, must be {}; leave the quotes out",
                                     item.path, expected));
  return text;
}

void require_three(const SceneItem& item, std::string_view expected) {
  require_list(item, expected);
  if (item.node->items.size() != 3)
    complain(item.place, fmt::format("{} has {} entries, must have 3: {}", item.path,
                                     item.node->items.size(), expected));
}

}  // namespace

const std::string& scalar_text(const SceneItem& item, std::string_view expected) {
  require_kind(item, Kind::scalar, expected);
  return item.node->text;
}

void require_map(const SceneItem& item) {
  require_kind(item, Kind::map, "a map (key: value)");
}

void require_list(const SceneItem& item, std::string_view expected) {
  require_kind(item, Kind::sequence, expected);
}

void check_keys(const SceneItem& item, std::span<const std::string_view> names,
                std::span<const std::string_view> later) {
  for (std::size_t i = 0; i < item.node->keys.size(); ++i) {
    const YamlKey& key = item.node->keys[i];
    const auto is_key = [&](std::string_view name) { return name == key.name; };
    if (std::any_of(names.begin(), names.end(), is_key)) continue;
    if (std::any_of(later.begin(), later.end(), is_key))
      complain(key.place, joined_path(item.path, key.name) + " is not available yet");
    const bool lacks_value = item.node->items[i].kind == Kind::null;
    complain(
        key.place,
        fmt::format("unknown key {}{}{}{}", in_quotes(key.name),
                    item.path.empty() ? "" : " in " + item.path, allowed_names(key.name, names),
                    lacks_value ? "; it has no value: ': ' is missing in it, or the text "
                                  "before it needs quotes"
                                : ""));
  }
}

void read_value(double& value, const SceneItem& item, const Described& described) {
  const std::string& text = number_text(item, "a number");
  const std::optional<double> number = to_number(text);
  if (!number)
    complain(item.place, fmt::format("{} = {}, must be a finite number in double precision",
                                     item.path, in_quotes(text)));
  check_bounds(*number, item, described);
  value = *number;
}

void read_value(int& value, const SceneItem& item, const Described& described) {
  constexpr double largest = std::numeric_limits<int>::max();
  const std::string& text = number_text(item, "a whole number");
  const std::optional<double> number =
      text.find_first_not_of("+-0123456789") == std::string::npos ? to_number(text) : std::nullopt;
  if (!number)
    complain(item.place,
             fmt::format("{} = {}, must be a whole number", item.path, in_quotes(text)));
  Described limits = described;
  limits.min = std::max(limits.min, -largest);
  limits.max = std::min(limits.max, largest);
  check_bounds(*number, item, limits);
  value = static_cast<int>(*number);
}

void read_value(bool& value, const SceneItem& item, const Described&) {
  constexpr std::array<std::string_view, 2> names{"true", "false"};
  const std::string& text = scalar_text(item, "true or false");
  const bool is_name = !item.node->quoted && (text == "true" || text == "false");
  if (!is_name)
    complain(item.place, item.path + " = " + in_quotes(text) + allowed_names(text, names));
  value = text == "true";
}

void read_value(std::string& value, const SceneItem& item, const Described&) {
  const std::string& text = scalar_text(item, "text");
  if (is_boolean_word(*item.node))
    complain(item.place,
             fmt::format("{} = {} is a boolean to YAML, must be text; quote it", item.path, text));
  if (text.empty()) complain(item.place, fmt::format("{} is empty, must be text", item.path));
  value = text;
}

void read_value(NamedFile& value, const SceneItem& item, const Described& described) {
  read_value(value.path, item, described);
  value.place = item.place;
}

void read_value(Length& value, const SceneItem& item, const Described& described) {
  const std::string& text = scalar_text(item, "a length, as 0.3 or 30%");
  value = parse_length(text, item.place, item.path);
  check_bounds(value.value, item, described);
}

void read_value(LengthVector& value, const SceneItem& item, const Described& described) {
  require_three(item, "three lengths, as [0.3, 0, 0] or [30%, 0, 0]");
  for (std::size_t i = 0; i < 3; ++i) read_value(value[i], child_item(item, i), described);
  check_units(value, item.place, item.path);
}

void read_value(Vec3& value, const SceneItem& item, const Described& described) {
  if (described.unit == factor_unit && item.node->kind == Kind::scalar) {
    double factor = 0;
    read_value(factor, item, described);
    value = Vec3::Constant(factor);
    return;
  }
  require_three(item, "three numbers, as [0, 0, 1]");
  for (std::size_t i = 0; i < 3; ++i)
    read_value(value[static_cast<Index>(i)], child_item(item, i), described);
}

}  // namespace supple
