#include "modeler/domain/mesh_defects.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "modeler/domain/self_intersections.h"
#include "modeler/domain/welded_surface.h"

namespace supple {
namespace {

constexpr std::size_t most_places = 5;  // kept of each kind

constexpr std::array<std::pair<DefectKind, std::string_view>, 10> defect_names{{
    {DefectKind::boundary_edges, "boundary_edges"},
    {DefectKind::nonmanifold_edges, "nonmanifold_edges"},
    {DefectKind::nonmanifold_vertices, "nonmanifold_vertices"},
    {DefectKind::inconsistent_edges, "inconsistent_edges"},
    {DefectKind::duplicate_faces, "duplicate_faces"},
    {DefectKind::zero_area_triangles, "zero_area_triangles"},
    {DefectKind::repeated_index_faces, "repeated_index_faces"},
    {DefectKind::unreferenced_vertices, "unreferenced_vertices"},
    {DefectKind::duplicated_vertices, "duplicated_vertices"},
    {DefectKind::self_intersections, "self_intersections"},
}};

/// No vertex stands in two corners.
bool is_loose(const Mesh& mesh) {
  std::vector<bool> seen(static_cast<std::size_t>(mesh.positions.rows()), false);
  for (const int vertex : mesh.face_vertices) {
    if (seen[vertex]) return false;
    seen[vertex] = true;
  }
  return mesh.face_count() > 1;
}

/// The faces with the numbers of their corners put through `numbers`; corners that then repeat the
/// one before are left out, and so are faces that fewer than three are left of.
struct WeldedFaces {
  FaceList list{{0}, {}};
  std::vector<int> numbers;  ///< for each face its number in `list`; −1: left out
};
WeldedFaces weld_faces(const FaceList& faces, const std::vector<int>& numbers) {
  WeldedFaces welded;
  std::vector<int> corners;
  for (int face = 0; face < faces.count(); ++face) {
    corners.clear();
    for (const int vertex : faces.corners(face))
      if (corners.empty() || corners.back() != numbers[vertex]) corners.push_back(numbers[vertex]);
    while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    welded.numbers.push_back(corners.size() < 3 ? -1 : welded.list.count());
    if (corners.size() < 3) continue;
    welded.list.vertices.insert(welded.list.vertices.end(), corners.begin(), corners.end());
    welded.list.starts.push_back(static_cast<int>(welded.list.vertices.size()));
  }
  return welded;
}

/// Order-free, so that faces with the same vertices have the same value.
std::uint64_t vertices_hash(std::span<const int> corners) {
  std::uint64_t hash = 0;
  for (const int vertex : corners) {
    std::uint64_t x = static_cast<std::uint64_t>(vertex) + 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    hash += x ^ (x >> 31);
  }
  return hash;
}

std::vector<int> sorted(std::span<const int> corners) {
  std::vector<int> result(corners.begin(), corners.end());
  std::sort(result.begin(), result.end());
  return result;
}

/// Faces and the earlier one that has the same vertices, ascending.
std::vector<std::array<int, 2>> duplicate_faces(const FaceList& faces) {
  std::vector<std::pair<std::uint64_t, int>> order;
  order.reserve(faces.count());
  for (int face = 0; face < faces.count(); ++face)
    order.emplace_back(vertices_hash(faces.corners(face)), face);
  std::sort(order.begin(), order.end());
  std::vector<std::array<int, 2>> found;
  for (std::size_t first = 0, next = 1; next < order.size(); ++next) {
    if (order[next].first != order[first].first)
      first = next;
    else if (sorted(faces.corners(order[next].second)) ==
             sorted(faces.corners(order[first].second)))
      found.push_back({order[next].second, order[first].second});
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Counts defects and keeps the first places of each.
class Surveyor {
 public:
  explicit Surveyor(const Mesh& mesh)
      : mesh_(mesh), cut_(triangulate(mesh)), firsts_(first_at_position(mesh.positions)) {
    for (const auto& [kind, name] : defect_names) survey_.defects.push_back({kind, 0, false, {}});
    survey_.loose = is_loose(mesh);
    joined_ = {mesh.face_starts, mesh.face_vertices};
    welded_ = weld_faces(joined_, firsts_);
    if (survey_.loose)
      for (int& vertex : joined_.vertices) vertex = firsts_[vertex];
  }

  MeshSurvey run() {
    count_parts();
    find_edges();
    find_faces();
    find_vertices();
    find_intersections();
    measure_components();
    return std::move(survey_);
  }

 private:
  Vec3 position(int vertex) const { return mesh_.positions.row(vertex); }

  Vec3 center(int face) const {
    Vec3 sum = Vec3::Zero();
    for (const int vertex : joined_.corners(face)) sum += position(vertex);
    return sum / static_cast<double>(joined_.corners(face).size());
  }

  /// One more of `kind`; `place()` is asked where it is only for the first few.
  template <class Place>
  void add(DefectKind kind, const Place& place) {
    Defect& defect = survey_.defects[static_cast<std::size_t>(kind)];
    if (defect.places.size() < most_places) defect.places.push_back(place());
    ++defect.count;
  }

  void add_vertex(DefectKind kind, int vertex) {
    add(kind, [&] { return DefectPlace{{vertex}, {}, position(vertex)}; });
  }

  void add_face(DefectKind kind, std::vector<int> faces) {
    add(kind, [&] { return DefectPlace{{}, faces, center(faces.front())}; });
  }

  void add_edge(DefectKind kind, FaceEdge edge) {
    add(kind, [&] {
      const int a = edge[0].low, b = edge[0].high;
      DefectPlace place{{a, b}, {}, 0.5 * (position(a) + position(b))};
      for (const FaceSide& side : edge) place.faces.push_back(side.face);
      return place;
    });
  }

  void count_parts() {
    survey_.vertices = static_cast<long>(mesh_.positions.rows());
    survey_.faces = mesh_.face_count();
    survey_.triangles = static_cast<long>(cut_.triangles.rows());
    for (int face = 0; face < mesh_.face_count(); ++face)
      ++survey_.faces_by_sides[mesh_.face_size(face)];
    for (const int vertex : mesh_.face_vertices) survey_.box.extend(position(vertex));
  }

  void find_edges() {
    const std::vector<FaceSide> sides = face_sides(joined_);
    for_each_edge(sides, [&](FaceEdge edge) {
      if (is_boundary(edge)) add_edge(DefectKind::boundary_edges, edge);
      if (is_nonmanifold(edge)) add_edge(DefectKind::nonmanifold_edges, edge);
      if (is_inconsistent(edge)) add_edge(DefectKind::inconsistent_edges, edge);
    });
    survey_.topology = topology(joined_, sides);
    for (const int vertex : survey_.topology.nonmanifold_vertices)
      add_vertex(DefectKind::nonmanifold_vertices, vertex);
  }

  void find_faces() {
    for (const auto& [face, earlier] : duplicate_faces(joined_))
      add_face(DefectKind::duplicate_faces, {face, earlier});
    for (int face = 0; face < mesh_.face_count(); ++face) {
      const std::vector<int> vertices = sorted(joined_.corners(face));
      if (std::adjacent_find(vertices.begin(), vertices.end()) != vertices.end())
        add_face(DefectKind::repeated_index_faces, {face});
    }
    std::vector<char> has_area(cut_.faces.size(), 0);
    for (const int t : rows_with_area(mesh_.positions, cut_.triangles)) has_area[t] = 1;
    for (std::size_t t = 0; t < has_area.size(); ++t)
      if (!has_area[t]) add_face(DefectKind::zero_area_triangles, {cut_.faces[t]});
  }

  void find_vertices() {
    std::vector<char> used(firsts_.size(), 0);
    for (const int vertex : mesh_.face_vertices) used[vertex] = 1;
    for (int vertex = 0; vertex < static_cast<int>(firsts_.size()); ++vertex) {
      if (!used[vertex]) add_vertex(DefectKind::unreferenced_vertices, vertex);
      if (firsts_[vertex] != vertex && !survey_.loose)
        add(DefectKind::duplicated_vertices, [&] {
          return DefectPlace{{vertex, firsts_[vertex]}, {}, position(vertex)};
        });
    }
  }

  void find_intersections() {
    const SelfIntersections found = self_intersections(
        mesh_.positions, cut_.triangles.unaryExpr([this](int vertex) { return firsts_[vertex]; }));
    for (const auto& [s, t] : found.pairs)
      add_face(DefectKind::self_intersections, {cut_.faces[s], cut_.faces[t]});
    Defect& defect = survey_.defects[static_cast<std::size_t>(DefectKind::self_intersections)];
    defect.count = found.count;
    defect.estimated = found.tested < 1;
  }

  void measure_components() {
    const FaceList& faces = welded_.list;
    const std::vector<FaceSide> sides = face_sides(faces);
    survey_.welded = topology(faces, sides);
    const std::vector<int> owners = face_components(faces);
    std::vector<Component>& components = survey_.components;
    components.resize(static_cast<std::size_t>(survey_.welded.components));
    std::vector<bool> counted(firsts_.size(), false);
    for (int face = 0; face < faces.count(); ++face) {
      Component& component = components[owners[face]];
      ++component.faces;
      for (const int vertex : faces.corners(face)) {
        if (!counted[vertex]) ++component.vertices;
        counted[vertex] = true;
        component.box.extend(position(vertex));
      }
    }
    for_each_edge(sides, [&](FaceEdge edge) {
      if (is_boundary(edge)) components[owners[edge[0].face]].closed = false;
    });
    measure_triangles(owners);
    rank_components();
  }

  void measure_triangles(const std::vector<int>& owners) {
    const Vec3 origin = survey_.box.center();
    for (Index t = 0; t < cut_.triangles.rows(); ++t) {
      const int face = welded_.numbers[cut_.faces[static_cast<std::size_t>(t)]];
      if (face < 0) continue;  // it has no area either
      const Vec3 a = position(cut_.triangles(t, 0)) - origin;
      const Vec3 b = position(cut_.triangles(t, 1)) - origin;
      const Vec3 c = position(cut_.triangles(t, 2)) - origin;
      Component& component = survey_.components[owners[face]];
      component.area += 0.5 * (b - a).cross(c - a).norm();
      component.volume += a.dot(b.cross(c)) / 6;
    }
  }

  void rank_components() {
    double magnitude = 0;
    for (const Component& component : survey_.components) {
      survey_.area += component.area;
      survey_.volume += component.volume;
      magnitude += std::abs(component.volume);
    }
    for (Component& component : survey_.components)
      component.volume_share = magnitude > 0 ? std::abs(component.volume) / magnitude : 0;
    std::stable_sort(survey_.components.begin(), survey_.components.end(),
                     [](const Component& a, const Component& b) { return a.area > b.area; });
  }

  const Mesh& mesh_;
  const Triangulation cut_;
  const std::vector<int> firsts_;
  FaceList joined_;
  WeldedFaces welded_;
  MeshSurvey survey_;
};

}  // namespace

EnumNames<DefectKind> enum_names(DefectKind) {
  return defect_names;
}

MeshSurvey survey_mesh(const Mesh& mesh) {
  return Surveyor(mesh).run();
}

}  // namespace supple
