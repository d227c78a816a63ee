#pragma once

#include <span>
#include <string>
#include <string_view>

namespace supple {

/// The name in `names` with the least Levenshtein distance to `wanted`, letter case apart; the
/// first of equals; empty where more than half of the longer one's letters differ.
std::string nearest_name(std::string_view wanted, std::span<const std::string_view> names);

}  // namespace supple
