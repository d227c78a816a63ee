#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "io/errors.h"
#include "io/mesh/mesh_checks.h"

namespace supple {

/// The mesh that `read` makes of the bytes, which holds together; nothing where they are refused.
inline std::optional<Mesh> check_fuzzed_mesh(Mesh (*read)(const FileBytes&),
                                             std::span<const std::uint8_t> bytes) {
  try {
    Mesh mesh = read({.name = "/no/such/folder/fuzzed", .bytes = {bytes.begin(), bytes.end()}});
    check_mesh(mesh);
    triangulate(mesh);
    return mesh;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace supple
