#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace supple {

/// A whole file in memory, and its name for messages.
struct FileBytes {
  std::string name;
  std::string bytes;
};

inline constexpr std::size_t largest_file = std::size_t{1} << 32;  ///< [bytes]

/// All bytes of a regular file; nothing is read of one that is larger than `most_bytes`.
/// Errors: InputError where it is missing, a folder or no regular file, too large, or the system
/// refuses.
std::string read_regular_file(const std::filesystem::path& path,
                              std::size_t most_bytes = largest_file);

/// The same of a file that may not be empty.
FileBytes read_file_bytes(const std::filesystem::path& path);

}  // namespace supple
