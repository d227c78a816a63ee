#pragma once

#include <vector>

#include "io/gltf/gltf_accessor.h"
#include "io/gltf/gltf_nodes.h"
#include "io/mesh/mesh.h"

namespace supple {

/// An attribute of the vertices, of as many numbers as `fallback`, which stands where there is
/// none. Nothing is kept as long as all are missing.
struct GltfColumn {
  std::vector<double> fallback, values{};
  Index missing = 0;

  /// Before the first vertex that has a value, behind `before` others.
  void begin(Index before) {
    if (!values.empty()) return;
    for (Index i = 0; i < before; ++i) append(fallback);
  }
  template <class Values>
  void append(const Values& more) {
    values.insert(values.end(), more.begin(), more.end());
  }
  void append_missing(Index count) {
    missing += count;
    for (Index i = 0; i < count && !values.empty(); ++i) append(fallback);
  }
};

/// The vertices of a glTF file's primitives, one after the other, where their nodes put them.
class GltfVertices {
 public:
  explicit GltfVertices(const GltfDocument& document) : document_(document) {}

  int count() const { return static_cast<int>(positions_.size() / 3); }

  /// Reads the vertices of a primitive with these attributes; how many they are.
  /// Errors: InputError.
  int append(const PlacedMesh& placed, const GltfObject& attributes);

  /// Moves them into `mesh`.
  void take(Mesh& mesh);

 private:
  AccessorValues values_of(const GltfObject& attributes, std::string_view name,
                           std::initializer_list<int> columns, Index count) const;
  void append_texcoords(const AccessorValues& values, Index before, Index count);
  void append_colors(const AccessorValues& values, Index before, Index count);

  const GltfDocument& document_;
  std::vector<double> positions_;
  Index bright_ = 0;  ///< colors beyond what screens show
  GltfColumn normals_{{0, 0, 0}}, texcoords_{{0, 0}}, colors_{{1, 1, 1, 1}};
};

}  // namespace supple
