#pragma once

#include <span>
#include <string>
#include <string_view>

#include "io/scene/quantity.h"

namespace supple {

/// Throws UsageError "place: message".
[[noreturn]] void complain(const Place& place, const std::string& message);

/// `text` in single quotes for a message, shortened, control characters escaped.
std::string in_quotes(std::string_view text);

/// "; allowed: a, b; did you mean 'a'?"
std::string allowed_names(std::string_view wanted, std::span<const std::string_view> names);

}  // namespace supple
