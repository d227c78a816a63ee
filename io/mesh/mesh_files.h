#pragma once

#include <filesystem>
#include <string>

#include "io/errors.h"
#include "io/mesh/mesh.h"

namespace supple {

/// Reads OBJ, PLY (ASCII, both binaries), OFF, STL, glTF 2, or a point cloud in PLY, PCD, PWN or
/// XYZ by our own readers, chosen by the file's extension, or by its first bytes where the
/// extension says nothing; any other format by import_mesh.
/// Errors: InputError with the file and line (or byte) where it is empty, cut short, has a
/// number that is not finite, an index out of range, or a count that its size cannot hold;
/// ImporterError.
Mesh read_mesh(const std::filesystem::path& path);

/// Our own formats by name, for messages: "obj, off, ply, ...".
std::string mesh_formats();

/// True where `path` has an extension of a format that can be written.
bool can_write_mesh(const std::filesystem::path& path);

/// What of `mesh` the format of `path`'s extension, or `format` ("obj"), cannot hold, a sentence
/// each.
std::vector<std::string> left_out_by(const std::filesystem::path& path, const Mesh& mesh,
                                     std::string_view format = {});

/// Writes `mesh` in the format of `path`'s extension, or in `format` ("obj"), whole or not at all.
/// Numbers have enough digits to come back as the same float32 (OBJ, OFF: the same double).
/// Errors: OutputError.
void write_mesh(const Mesh& mesh, const std::filesystem::path& path, std::string_view format = {});

}  // namespace supple
