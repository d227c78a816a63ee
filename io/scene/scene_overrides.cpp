#include "io/scene/scene_overrides.h"

#include <charconv>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "io/scene/complaint.h"

namespace supple {
namespace {

using Kind = YamlNode::Kind;

/// A step down the tree: a key of a map or an index of a list.
struct Step {
  std::string key;
  std::optional<std::size_t> index;
};

[[noreturn]] void complain_of_path(const Place& place) {
  complain(place,
           "the path is wrong; allowed: keys with dots between them and [index] for "
           "lists, as in pose.handles[1].weight=2");
}

/// Reads "handles[1]", appends the steps.
void append_steps(std::string_view part, const Place& place, std::vector<Step>& steps) {
  const std::string_view key = part.substr(0, part.find('['));
  if (key.empty()) complain_of_path(place);
  steps.push_back({std::string(key), {}});
  part.remove_prefix(key.size());
  while (!part.empty()) {
    const std::size_t close = part.find(']');
    if (part[0] != '[' || close == std::string_view::npos) complain_of_path(place);
    std::size_t index = 0;
    const auto [stop, error] = std::from_chars(&part[1], &part[close], index);
    if (error != std::errc{} || stop != &part[close]) complain_of_path(place);
    steps.push_back({{}, index});
    part.remove_prefix(close + 1);
  }
}

std::vector<Step> parse_path(std::string_view path, const Place& place) {
  std::vector<Step> steps;
  for (std::size_t start = 0; start <= path.size();) {
    const std::size_t end = std::min(path.find('.', start), path.size());
    append_steps(path.substr(start, end - start), place, steps);
    start = end + 1;
  }
  return steps;
}

YamlNode& step_into_map(YamlNode& node, const std::string& key, const Place& place) {
  if (node.kind == Kind::null) {
    node = YamlNode{};
    node.kind = Kind::map;
    node.place = place;
  }
  if (node.kind != Kind::map)
    complain(place, fmt::format("what holds {} is not a map", in_quotes(key)));
  for (std::size_t i = 0; i < node.keys.size(); ++i)
    if (node.keys[i].name == key) return node.items[i];
  node.keys.push_back({key, place});
  return node.items.emplace_back();
}

YamlNode& step_into_list(YamlNode& node, std::size_t index, const Place& place) {
  if (node.kind != Kind::sequence)
    complain(place, fmt::format("what holds [{}] is not a list", index));
  if (index >= node.items.size())
    complain(place, fmt::format("[{}] is beyond the list's end; it has {} entries, from [0]", index,
                                node.items.size()));
  return node.items[index];
}

void set_places(YamlNode& node, const Place& place) {
  node.place = place;
  for (YamlKey& key : node.keys) key.place = place;
  for (YamlNode& item : node.items) set_places(item, place);
}

}  // namespace

void override_value(YamlNode& scene, const std::string& path, const std::string& value) {
  const Place place{fmt::format("--set {}={}", path, value)};
  YamlNode* node = &scene;
  for (const Step& step : parse_path(path, place))
    node = step.index ? &step_into_list(*node, *step.index, place)
                      : &step_into_map(*node, step.key, place);
  *node = parse_yaml(value, place.file);
  if (node->kind == Kind::null) complain(place, "the value is missing");
  set_places(*node, place);
}

}  // namespace supple
