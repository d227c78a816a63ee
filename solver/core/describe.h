#pragma once

#include <limits>
#include <span>
#include <string_view>
#include <utility>

namespace supple {

/// How a study varies a member, from coarse to fine, to show what its values cost and bring. The
/// scene's own value is always among them.
struct Sweep {
  enum class Kind {
    none,    ///< it does not
    names,   ///< all names of an enumeration
    range,   ///< `from` to `to` in equal ratios
    doubles  ///< the own value halved once, then doubled; the results converge to the exact one
  };
  Kind kind = Kind::none;
  double from = 0, to = 0;  ///< of a range
  double exact = 0;         ///< value whose result counts as exact, all else unchanged; 0: none
  double usual = 0;         ///< what the program takes where the scene leaves the member open
};

/// What a reader of scenes, a command line or a manual needs to know of one member.
///
/// An options struct names its members once, for every such reader:
///
///     template <class Self, class Visitor>
///     static void describe(Self& self, Visitor&& visit) {
///       visit("particles", self.particles, {.doc = "number of particles", .min = 1});
///     }
struct Described {
  std::string_view doc;                                   ///< one line
  std::string_view unit = "";                             ///< "" for pure numbers
  double min = -std::numeric_limits<double>::infinity();  ///< least allowed value
  double max = std::numeric_limits<double>::infinity();   ///< greatest allowed value
  bool exclusive_min = false;                             ///< min itself is not allowed
  Sweep sweep = {};                                       ///< how a study varies it
};

/// The names of an enumeration's values, as they stand in scenes and reports. Every enumeration
/// in an options struct has an overload of `enum_names(E)`, found by argument-dependent lookup.
template <class E>
using EnumNames = std::span<const std::pair<E, std::string_view>>;

/// The name of `value`, or "?" for a value without one.
template <class E>
std::string_view enum_name(E value) {
  for (const auto& [candidate, name] : enum_names(value))
    if (candidate == value) return name;
  return "?";
}

}  // namespace supple
