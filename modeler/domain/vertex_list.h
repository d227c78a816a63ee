#pragma once

#include <filesystem>
#include <vector>

#include "io/scene/quantity.h"

namespace supple {

/// Reads 0-based vertex numbers that stand between blanks; `#` begins a comment. Returns for each
/// of `vertex_count` vertices whether it is listed.
/// Errors: UsageError with the line where a word is no number or out of range, or with `place`
/// where the file cannot be read.
std::vector<char> read_vertex_list(const std::filesystem::path& path, int vertex_count,
                                   const Place& place);

}  // namespace supple
