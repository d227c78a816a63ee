#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace supple {

std::string to_base64(std::string_view bytes);

/// Empty where `text` is not Base64 (RFC 4648, section 4), with or without padding.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace supple
