#pragma once

#include <span>
#include <string_view>

namespace supple {

enum class Relation { at_most, at_least, equal };

/// What a figure of a case must be.
struct Limit {
  std::string_view id, figure;
  Relation relation;
  double value;
  std::string_view doc;  ///< what is measured, over what

  /// False for a value that is not a number.
  bool holds_for(double measured) const;
};

/// "≤", "≥" or "=".
std::string_view symbol(Relation relation);

/// The limits of all cases, one case's in a row.
std::span<const Limit> limits();

}  // namespace supple
