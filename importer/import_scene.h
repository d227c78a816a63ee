#pragma once

#include <filesystem>

#include "io/mesh/mesh.h"

namespace supple {

/// Reads a file by assimp, but only by readers of formats that we do not read ourselves, and only
/// files in its folder and below. The nodes' transforms are applied; each mesh of a node is an
/// object with its material's name. Bones, animations and textures are left out, with notes.
/// Errors: std::runtime_error where assimp cannot read it, or gives an index or a number that no
/// mesh can have.
Mesh import_scene(const std::filesystem::path& path);

}  // namespace supple
