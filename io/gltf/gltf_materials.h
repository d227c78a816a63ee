#pragma once

#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "io/gltf/gltf_document.h"
#include "io/mesh/mesh.h"

namespace supple {

/// The materials of a glTF file with all that they refer to, just as it has them, so that they
/// go into another one unchanged.
struct GltfMaterials {
  nlohmann::json materials, textures, samplers, images;  ///< arrays
  std::vector<std::string> image_bytes;          ///< of each image; empty: it could not be had
  std::vector<std::string> extensions;           ///< that they use
  std::vector<std::string> required_extensions;  ///< of these, what readers must know
  std::vector<std::string> names;                ///< of the materials, all different
  std::string copyright;                         ///< of the file
};

/// Null where there are neither materials nor a copyright. Notes go to `notes`.
/// Errors: InputError where a material refers to what is not there.
std::shared_ptr<const GltfMaterials> take_materials(const GltfDocument& document,
                                                    std::vector<std::string>& notes);

}  // namespace supple
