#include "io/gltf/gltf_parts.h"

#include <algorithm>
#include <map>

namespace supple {
namespace {

/// Faces and vertices of an object, each from one on up to another.
struct Run {
  std::string name;
  int first_face, end_face;
  int first_vertex, end_vertex;
};

std::vector<Run> runs_of_faces(const Mesh& mesh) {
  std::vector<Run> runs{{"", 0, 0, 0, 0}};
  for (const FaceTag& tag : mesh.tags) {
    if (tag.kind != FaceTag::Kind::object) continue;
    runs.back().end_face = tag.first_face;
    if (runs.back().first_face == tag.first_face) runs.pop_back();
    runs.push_back({tag.name, tag.first_face, tag.first_face, 0, 0});
  }
  runs.back().end_face = mesh.face_count();
  if (runs.size() > 1 && runs.back().first_face == mesh.face_count()) runs.pop_back();
  return runs;
}

/// Gives each run the vertices from its first to that of the next; whether all its faces have
/// theirs among them.
bool share_out_vertices(const Mesh& mesh, std::vector<Run>& runs) {
  int next = static_cast<int>(mesh.positions.rows());
  for (auto run = runs.rbegin(); run != runs.rend(); ++run) {
    const auto begin = mesh.face_vertices.begin() + mesh.face_starts[run->first_face];
    const auto end = mesh.face_vertices.begin() + mesh.face_starts[run->end_face];
    if (begin == end) return false;
    const auto [least, most] = std::minmax_element(begin, end);
    if (*most >= next) return false;
    run->end_vertex = next;
    next = run->first_vertex = *least;
  }
  runs.front().first_vertex = 0;
  return true;
}

std::vector<Run> runs_of(const Mesh& mesh) {
  std::vector<Run> runs = runs_of_faces(mesh);
  if (share_out_vertices(mesh, runs)) return runs;
  const std::string name = runs.size() == 1 ? runs.front().name : "";
  return {{name, 0, mesh.face_count(), 0, static_cast<int>(mesh.positions.rows())}};
}

class PartBuilder {
 public:
  PartBuilder(const Mesh& mesh, const Run& run) : mesh_(mesh), run_(run) {
    part_.name = run.name;
    for (int vertex = run.first_vertex; vertex < run.end_vertex; ++vertex)
      part_.vertices.push_back({vertex, row(mesh.normals, vertex), row(mesh.texcoords, vertex)});
    taken_.assign(part_.vertices.size(),
                  !mesh.normals.per_corner() && !mesh.texcoords.per_corner());
  }

  void add(const Eigen::RowVector3i& triangle, int face, const std::string& material) {
    const auto [found, is_new] = primitives_.try_emplace(material, part_.primitives.size());
    if (is_new) part_.primitives.push_back({material, {}});
    for (const int vertex : triangle)
      part_.primitives[found->second].corners.push_back(slot(corner_of(face, vertex)));
  }

  GltfPart take() {
    if (part_.primitives.empty()) part_.primitives.push_back({});
    return std::move(part_);
  }

 private:
  template <int Columns>
  static int row(const Attribute<Columns>& attribute, int vertex) {
    return attribute.empty() || attribute.per_corner() ? -1 : vertex;
  }

  template <int Columns>
  int corner_row(const Attribute<Columns>& attribute, int corner) const {
    return attribute.per_corner() ? attribute.corners[corner]
                                  : row(attribute, mesh_.face_vertices[corner]);
  }

  GltfVertex corner_of(int face, int vertex) const {
    int corner = mesh_.face_starts[face];
    while (mesh_.face_vertices[corner] != vertex) ++corner;
    return {vertex, corner_row(mesh_.normals, corner), corner_row(mesh_.texcoords, corner)};
  }

  /// The vertex's own place where it is free or has the same values; else one behind the others.
  int slot(const GltfVertex& vertex) {
    const int own = vertex.position - run_.first_vertex;
    if (!taken_[own]) {
      taken_[own] = true;
      part_.vertices[own] = vertex;
    }
    if (part_.vertices[own] == vertex) return own;
    const int next = static_cast<int>(part_.vertices.size());
    const auto [copy, is_new] = copies_.try_emplace(vertex, next);
    if (is_new) part_.vertices.push_back(vertex);
    return copy->second;
  }

  const Mesh& mesh_;
  const Run& run_;
  GltfPart part_;
  std::vector<bool> taken_;
  std::map<GltfVertex, int> copies_;
  std::map<std::string, std::size_t> primitives_;  ///< by material
};

}  // namespace

bool objects_are_apart(const Mesh& mesh) {
  std::vector<Run> runs = runs_of_faces(mesh);
  return runs.size() == 1 || share_out_vertices(mesh, runs);
}

std::vector<GltfPart> gltf_parts(const Mesh& mesh) {
  const Triangulation triangulation = triangulate(mesh);
  std::vector<GltfPart> parts;
  std::size_t triangle = 0;
  auto tag = mesh.tags.begin();
  std::string material;
  for (const Run& run : runs_of(mesh)) {
    PartBuilder builder(mesh, run);
    for (; triangle < triangulation.faces.size() && triangulation.faces[triangle] < run.end_face;
         ++triangle) {
      const int face = triangulation.faces[triangle];
      for (; tag != mesh.tags.end() && tag->first_face <= face; ++tag)
        if (tag->kind == FaceTag::Kind::material) material = tag->name;
      builder.add(triangulation.triangles.row(static_cast<Index>(triangle)), face, material);
    }
    parts.push_back(builder.take());
  }
  return parts;
}

}  // namespace supple
