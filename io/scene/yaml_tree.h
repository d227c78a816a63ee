#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "io/scene/quantity.h"

namespace supple {

struct YamlKey {
  std::string name;
  Place place;
};

/// A value of a YAML document, with the place where it begins.
struct YamlNode {
  enum class Kind { null, scalar, sequence, map };

  Kind kind = Kind::null;
  Place place;
  std::string text;             ///< scalar
  bool quoted = false;          ///< scalar: stands in quotes, so it is text and nothing else
  bool flow = false;            ///< sequence, map: written in [ ] or { }
  std::vector<YamlKey> keys;    ///< map: one for each item, all different
  std::vector<YamlNode> items;  ///< sequence, map
};

/// The size of the largest scene that is read [bytes].
inline constexpr std::size_t largest_scene = 1 << 20;

/// Reads one YAML document strictly: UTF-8 text without tags, anchors, aliases, merges, duplicate
/// keys and keys that are not text. A document nested deeper than 64, of more than 100,000 values
/// or 1 MB is refused, so that hostile text costs little. An empty document is a null.
/// Errors: UsageError with name:line:column and the mend.
YamlNode parse_yaml(std::string_view text, const std::string& name);

}  // namespace supple
