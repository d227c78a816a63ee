#pragma once

#include <string>

#include "io/file_bytes.h"
#include "io/mesh/mesh.h"

namespace supple {

/// What every reader ends with. Checks that there are vertices; brings colours from [0, 255]
/// to [0, 1]; makes an attribute per vertex where each corner takes the value of its vertex's
/// number; notes what is odd about the faces.
/// Errors: InputError where there is no vertex, a colour lies outside [0, 255], or a radius is
/// negative.
void finish_mesh(Mesh& mesh, const FileBytes& file);

/// Appends to mesh.notes that `count` things were left out, where there are any.
void note_left_out(Mesh& mesh, long long count, std::string_view what);

/// Appends to mesh.notes that a text file ends inside a line.
void note_open_end(Mesh& mesh);

/// Throws InternalError where `mesh` is not what mesh.h says or holds a number that is not finite.
void check_mesh(const Mesh& mesh);

}  // namespace supple
