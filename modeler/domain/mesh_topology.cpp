#include "modeler/domain/mesh_topology.h"

#include <algorithm>

#include "modeler/domain/disjoint_sets.h"

namespace supple {
namespace {

std::size_t vertex_count(const FaceList& faces) {
  const auto greatest = std::max_element(faces.vertices.begin(), faces.vertices.end());
  return greatest == faces.vertices.end() ? 0 : static_cast<std::size_t>(*greatest) + 1;
}

std::vector<FaceSide> unsorted_sides(const FaceList& faces) {
  std::vector<FaceSide> sides;
  sides.reserve(faces.vertices.size());
  for (int face = 0; face < faces.count(); ++face) {
    const int begin = faces.starts[face], end = faces.starts[face + 1];
    for (int from = begin; from < end; ++from) {
      const int to = from + 1 < end ? from + 1 : begin;
      const int a = faces.vertices[from], b = faces.vertices[to];
      if (a != b) sides.push_back({std::min(a, b), std::max(a, b), face, from, to, a < b});
    }
  }
  return sides;
}

/// Whether faces can be turned so that all edges of two faces pass consistently: no face may hang
/// together with itself turned over.
bool orientable(const FaceList& faces, const std::vector<FaceSide>& sides) {
  DisjointSets turned(2 * static_cast<std::size_t>(faces.count()));
  for_each_edge(sides, [&](FaceEdge edge) {
    if (edge.size() != 2) return;
    const int f = 2 * edge[0].face, g = 2 * edge[1].face, over = is_inconsistent(edge) ? 1 : 0;
    turned.unite(f, g + over);
    turned.unite(f + 1, g + 1 - over);
  });
  for (int face = 0; face < faces.count(); ++face)
    if (turned.together(2 * face, 2 * face + 1)) return false;
  return true;
}

/// Where corners that share a vertex do not reach each other over edges.
std::vector<int> nonmanifold_vertices(const FaceList& faces, const std::vector<FaceSide>& sides) {
  DisjointSets fans(faces.vertices.size());  // of corners
  for_each_edge(sides, [&](FaceEdge edge) {
    for (const FaceSide& side : edge) {
      const bool same = side.forward == edge[0].forward;
      fans.unite(side.from, same ? edge[0].from : edge[0].to);
      fans.unite(side.to, same ? edge[0].to : edge[0].from);
    }
  });
  std::vector<int> first(vertex_count(faces), -1), found;
  for (std::size_t corner = 0; corner < faces.vertices.size(); ++corner) {
    int& fan = first[faces.vertices[corner]];
    const int root = fans.root(static_cast<int>(corner));
    if (fan < 0) fan = root;
    if (fan != root) found.push_back(faces.vertices[corner]);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace

std::vector<FaceSide> face_sides(const FaceList& faces) {
  const std::vector<FaceSide> unsorted = unsorted_sides(faces);
  std::vector<std::size_t> starts(vertex_count(faces) + 1, 0);
  for (const FaceSide& side : unsorted) ++starts[side.low + 1];
  for (std::size_t v = 1; v < starts.size(); ++v) starts[v] += starts[v - 1];
  std::vector<FaceSide> sides(unsorted.size());
  std::vector<std::size_t> next = starts;
  for (const FaceSide& side : unsorted) sides[next[side.low]++] = side;
  for (std::size_t v = 0; v + 1 < starts.size(); ++v)
    std::sort(sides.begin() + static_cast<std::ptrdiff_t>(starts[v]),
              sides.begin() + static_cast<std::ptrdiff_t>(starts[v + 1]),
              [](const FaceSide& a, const FaceSide& b) {
                return a.high != b.high ? a.high < b.high : a.from < b.from;
              });
  return sides;
}

std::vector<int> face_components(const FaceList& faces) {
  DisjointSets joined(vertex_count(faces));
  for (int face = 0; face < faces.count(); ++face)
    for (const int vertex : faces.corners(face)) joined.unite(vertex, faces.corners(face)[0]);
  std::vector<int> numbers(vertex_count(faces), -1), components(faces.count());
  int count = 0;
  for (int face = 0; face < faces.count(); ++face) {
    int& number = numbers[joined.root(faces.corners(face)[0])];
    if (number < 0) number = count++;
    components[face] = number;
  }
  return components;
}

Topology topology(const FaceList& faces, const std::vector<FaceSide>& sides) {
  Topology result;
  result.faces = faces.count();
  std::vector<char> used(vertex_count(faces), 0);
  for (const int vertex : faces.vertices) used[vertex] = 1;
  result.vertices = std::count(used.begin(), used.end(), 1);
  for_each_edge(sides, [&](FaceEdge edge) {
    ++result.edges;
    result.boundary_edges += is_boundary(edge) ? 1 : 0;
    result.nonmanifold_edges += is_nonmanifold(edge) ? 1 : 0;
    result.inconsistent_edges += is_inconsistent(edge) ? 1 : 0;
  });
  result.nonmanifold_vertices = nonmanifold_vertices(faces, sides);
  const std::vector<int> components = face_components(faces);
  if (!components.empty())
    result.components = *std::max_element(components.begin(), components.end()) + 1;
  result.orientable = orientable(faces, sides);
  return result;
}

}  // namespace supple
