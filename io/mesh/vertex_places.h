#pragma once

#include <filesystem>
#include <vector>

#include "solver/core/types.h"

namespace supple {

/// Where some vertices of a shape shall be.
struct VertexPlaces {
  std::vector<int> vertices;  ///< from 0, ascending, all different
  Points places;              ///< [file units], one a row
};

/// Reads lines "number x y z", vertices numbered from 0 in any order; # begins a comment.
/// Errors: InputError with file:line where a number is missing, left over, not finite, not one of
/// `vertex_count` vertices, or a vertex is listed twice; InputError where none is listed.
VertexPlaces read_vertex_places(const std::filesystem::path& path, Index vertex_count);

}  // namespace supple
