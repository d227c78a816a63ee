#pragma once

#include <filesystem>
#include <optional>

#include "io/file_bytes.h"
#include "io/mesh/mesh.h"

namespace supple {

struct ImporterOptions {
  /// Empty: `supple-import` beside this program, or where it was installed.
  std::filesystem::path program;
  /// Most time [s] and memory [bytes] that it may take; empty: by the size of the file.
  std::optional<double> most_seconds;
  std::optional<std::size_t> most_bytes;
};

/// Reads a format that is not ours by a process of its own (assimp), in which a hostile file can
/// do no harm: it answers in OBJ on a pipe, which is read as any other OBJ file.
/// The order of the vertices is the importer's, and a note says so.
/// Errors: InputError where it cannot read the file, or what it answers cannot be read;
/// ImporterError where it crashes or takes more than it may.
Mesh import_mesh(const FileBytes& file, const ImporterOptions& options = {});

}  // namespace supple
