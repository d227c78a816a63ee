#pragma once

#include <memory>
#include <string>
#include <vector>

#include "solver/core/types.h"

namespace supple {

/// Values of one attribute and which of them each vertex or face corner takes.
template <int Columns>
struct Attribute {
  /// One value a row, n×Columns.
  Eigen::Matrix<double, Eigen::Dynamic, Columns, Eigen::RowMajor> values;
  /// A row of `values` for each face corner (−1: none), in the order of Mesh::face_vertices.
  /// Empty: the values belong to the vertices, one each, in their order.
  std::vector<int> corners;

  bool empty() const { return values.rows() == 0; }
  bool per_corner() const { return !corners.empty(); }
};

struct GltfMaterials;

/// A run of faces that starts at `first_face`: what OBJ's o, g, s and usemtl lines say.
struct FaceTag {
  enum class Kind { object, group, smoothing, material };
  Kind kind;
  std::string name;  ///< the rest of the line, bytes as they stood in the file
  int first_face;
};

/// A polygon mesh, or a point cloud where it has no faces, just as the file has it: order and
/// count of vertices and faces are the file's.
struct Mesh {
  Points positions;                 ///< [file units], n×3
  std::vector<int> face_starts{0};  ///< faces+1 offsets into face_vertices
  std::vector<int> face_vertices;   ///< the polygons' vertices, one after the other

  Attribute<3> normals;  ///< unit length where the file's are
  Attribute<2> texcoords;
  Attribute<4> colors;        ///< red, green, blue, alpha in [0, 1]; always per vertex
  Eigen::VectorXd radii;      ///< of a point cloud's points [file units]; n, or empty
  std::vector<FaceTag> tags;  ///< ordered by first_face
  std::vector<std::string> material_libraries;
  /// What the material tags name, of a glTF file and for another one; else null.
  std::shared_ptr<const GltfMaterials> gltf_materials;
  std::vector<std::string> notes;  ///< what the reader left out or mended, a sentence each

  int face_count() const { return static_cast<int>(face_starts.size()) - 1; }
  int face_size(int face) const { return face_starts[face + 1] - face_starts[face]; }
};

/// The polygons cut into triangles by their own vertices (ear clipping where not convex),
/// and the face each one is of.
struct Triangulation {
  Triangles triangles;     ///< n×3 vertex indices
  std::vector<int> faces;  ///< n
};
Triangulation triangulate(const Mesh& mesh);

/// The vertices alone, with what belongs to each of them.
Mesh points_of(Mesh mesh);

}  // namespace supple
