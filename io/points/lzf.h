#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace supple {

/// Unpacks what LZF (Marc Lehmann's LibLZF) packed: a byte below 32 is followed by that many
/// bytes and one more; any other holds the length − 2 (3 bits; 7: a byte more) and, with the byte
/// behind it, the distance − 1 (13 bits) of bytes to repeat.
/// Returns nothing where `packed` is damaged or does not give `size` bytes.
std::optional<std::string> unpack_lzf(std::string_view packed, std::size_t size);

}  // namespace supple
