#pragma once

#include <algorithm>
#include <filesystem>

#include "io/mesh/mesh_files.h"
#include "tests/support/mesh_comparison.h"
#include "tests/support/sample_files.h"
#include "tests/support/temporary_folder.h"

/// What comes of files that end too early.
namespace supple {

inline bool is_same(const Mesh& a, const Mesh& b) {
  return relative_difference(a.positions, b.positions) == 0 && a.face_starts == b.face_starts &&
         a.face_vertices == b.face_vertices &&
         relative_difference(a.colors.values, b.colors.values) == 0 &&
         relative_difference(corner_values(a, a.normals), corner_values(b, b.normals)) == 0 &&
         relative_difference(a.radii, b.radii) == 0 &&
         relative_difference(corner_values(a, a.texcoords), corner_values(b, b.texcoords)) == 0 &&
         a.tags.size() == b.tags.size();
}

inline bool has_note(const Mesh& mesh, std::string_view words) {
  return std::any_of(mesh.notes.begin(), mesh.notes.end(), [&](const std::string& note) {
    return note.find(words) != std::string::npos;
  });
}

enum class CutFate { refused, told, whole, silent };

/// Reads the first `length` bytes of `sample`, whose whole is `mesh`; the file stands at `path`
/// with as many bytes or more.
inline CutFate fate_of_cut(const std::filesystem::path& path, const SampleFile& sample,
                           const Mesh& mesh, std::size_t length) {
  std::filesystem::resize_file(path, length);
  try {
    const Mesh part = read_mesh(path);
    if (has_note(part, "may be cut short")) return CutFate::told;
    const bool ends_with_line = length > 0 && sample.bytes[length - 1] == '\n';
    const bool whole = is_same(part, mesh) || (!sample.tells_its_length && ends_with_line);
    return whole ? CutFate::whole : CutFate::silent;
  } catch (const InputError&) {
    return CutFate::refused;
  }
}

}  // namespace supple
