#pragma once

#include <string>
#include <vector>

#include "io/mesh/mesh.h"

namespace supple {

/// Rows of the mesh's positions, normals and texture coordinates; −1: none.
struct GltfVertex {
  int position, normal, texcoord;
  auto operator<=>(const GltfVertex&) const = default;
};

/// Triangles of one material, or all vertices as points where there are no triangles.
struct GltfPrimitive {
  std::string material;      ///< its name; empty: none
  std::vector<int> corners;  ///< vertices of the part, three a triangle; empty: points
};

/// What becomes a mesh of a glTF file.
struct GltfPart {
  std::string name;
  std::vector<GltfVertex> vertices;
  std::vector<GltfPrimitive> primitives;
};

/// Whether the objects of `mesh` have vertices of their own, one object's behind the other's.
bool objects_are_apart(const Mesh& mesh);

/// The objects of `mesh` with vertices of their own; the mesh as one part without a name where
/// they are not apart. Each part begins with its run of the
/// mesh's vertices, in their order; those that a corner needs once more follow behind.
std::vector<GltfPart> gltf_parts(const Mesh& mesh);

}  // namespace supple
