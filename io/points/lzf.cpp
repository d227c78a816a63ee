#include "io/points/lzf.h"

namespace supple {
namespace {

/// Three bytes stand for 264 at the most.
constexpr std::size_t greatest_ratio = 88;

}  // namespace

std::optional<std::string> unpack_lzf(std::string_view packed, std::size_t size) {
  if (size / greatest_ratio > packed.size()) return std::nullopt;
  std::string bytes;
  bytes.reserve(size);
  std::size_t at = 0;
  const auto next = [&] { return static_cast<unsigned char>(packed[at++]); };
  while (at < packed.size()) {
    const std::size_t control = next();
    if (control < 32) {
      const std::size_t length = control + 1;
      if (length > packed.size() - at || length > size - bytes.size()) return std::nullopt;
      bytes.append(packed.substr(at, length));
      at += length;
      continue;
    }
    std::size_t length = control >> 5;
    if (packed.size() - at < (length == 7 ? 2u : 1u)) return std::nullopt;
    if (length == 7) length += next();
    length += 2;
    const std::size_t distance = ((control & 31) << 8) + next() + 1;
    if (distance > bytes.size() || length > size - bytes.size()) return std::nullopt;
    // Byte by byte: what is repeated may reach into what it writes.
    for (std::size_t from = bytes.size() - distance; length > 0; --length)
      bytes.push_back(bytes[from++]);
  }
  if (bytes.size() != size) return std::nullopt;
  return bytes;
}

}  // namespace supple
