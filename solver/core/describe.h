#pragma once

#include <limits>
#include <span>
#include <string_view>
#include <utility>

namespace supple {

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
