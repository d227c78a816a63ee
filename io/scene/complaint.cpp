#include "io/scene/complaint.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "io/errors.h"
#include "io/scene/nearest_name.h"

namespace supple {

void complain(const Place& place, const std::string& message) {
  throw UsageError(to_string(place) + ": " + message);
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::size_t length = std::min(text.size(), longest);
  const auto continues_letter = [&](std::size_t i) { return (text[i] & 0xC0) == 0x80; };  // UTF-8
  if (length < text.size())
    while (length > 0 && continues_letter(length)) --length;
  std::string shown = "'";
  for (const char c : text.substr(0, length)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F)
      shown += fmt::format("\\x{:02x}", byte);
    else
      shown += c;
  }
  return shown + (length < text.size() ? "…'" : "'");
}

std::string allowed_names(std::string_view wanted, std::span<const std::string_view> names) {
  std::string message = fmt::format("; allowed: {}", fmt::join(names, ", "));
  const std::string nearest = nearest_name(wanted, names);
  if (!nearest.empty()) message += fmt::format("; did you mean '{}'?", nearest);
  return message;
}

}  // namespace supple
