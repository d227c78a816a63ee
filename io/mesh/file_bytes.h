#pragma once

#include <filesystem>
#include <string>

namespace supple {

/// A whole file in memory, and its name for messages.
struct FileBytes {
  std::string name;
  std::string bytes;
};

/// Reads a regular file of 1 byte to 4 GiB.
/// Errors: InputError where it is missing, empty, a folder or no regular file, too large, or
/// the system refuses.
FileBytes read_file_bytes(const std::filesystem::path& path);

}  // namespace supple
