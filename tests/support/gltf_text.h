#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "io/gltf/base64.h"

namespace supple {

/// A glTF file in the making: accessors over one buffer that stands in a data URI.
class GltfText {
 public:
  nlohmann::json json = {{"asset", {{"version", "2.0"}}}};

  /// An accessor's number.
  template <class Number>
  int add(const std::vector<Number>& numbers, const char* type, int component_type) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    const std::size_t begin = bytes_.size(), size = numbers.size() * sizeof(Number);
    bytes_.resize(begin + size);
    std::memcpy(bytes_.data() + begin, numbers.data(), size);
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", begin}, {"byteLength", size}});
    const std::size_t columns = std::string(type) == "SCALAR" ? 1
                                : std::string(type) == "MAT4" ? 16
                                                              : type[3] - '0';
    json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                 {"componentType", component_type},
                                 {"type", type},
                                 {"count", numbers.size() / columns}});
    return static_cast<int>(json["accessors"].size()) - 1;
  }
  int add_vectors(const std::vector<float>& numbers) { return add(numbers, "VEC3", 5126); }
  int add_indices(const std::vector<std::uint16_t>& numbers) {
    return add(numbers, "SCALAR", 5123);
  }

  /// A mesh of one primitive, and a node that shows it.
  void show(const nlohmann::json& primitive, nlohmann::json node = nlohmann::json::object()) {
    node["mesh"] = json["meshes"].size();
    json["meshes"].push_back({{"primitives", {primitive}}});
    json["nodes"].push_back(node);
  }

  std::string text() const {
    nlohmann::json whole = json;
    whole["buffers"] = {{{"byteLength", bytes_.size()},
                         {"uri", "data:application/octet-stream;base64," + to_base64(bytes_)}}};
    return whole.dump();
  }

 private:
  std::string bytes_;
};

/// Four points, no three in a line.
inline const std::vector<float> four_points = {0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0, 4};

/// A triangle of three of the four points.
inline GltfText one_triangle() {
  GltfText gltf;
  const int positions = gltf.add_vectors(four_points);
  gltf.show({{"attributes", {{"POSITION", positions}}}, {"indices", gltf.add_indices({0, 1, 2})}});
  return gltf;
}

}  // namespace supple
