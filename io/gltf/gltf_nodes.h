#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "io/gltf/gltf_document.h"

namespace supple {

/// A mesh where a node of the scene puts it.
struct PlacedMesh {
  std::size_t mesh;
  std::string name;  ///< the node's, or else the mesh's
  Eigen::Affine3d transform;
  /// Of its skin's joints, from the places in the accessors to the scene; null without a skin.
  std::shared_ptr<const std::vector<Eigen::Affine3d>> joints;
};

/// The meshes of the default scene (the first where none is said, all nodes where there is none),
/// in the order of its tree.
/// Errors: InputError where the nodes are no tree, an index or a transform is wrong.
std::vector<PlacedMesh> placed_meshes(const GltfDocument& document);

}  // namespace supple
