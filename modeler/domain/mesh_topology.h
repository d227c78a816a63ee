#pragma once

#include <span>
#include <vector>

namespace supple {

/// Polygons by the numbers of their vertices.
struct FaceList {
  std::vector<int> starts;    ///< faces + 1 offsets into `vertices`
  std::vector<int> vertices;  ///< one face's corners after the other's

  int count() const { return static_cast<int>(starts.size()) - 1; }
  std::span<const int> corners(int face) const {
    return std::span(vertices).subspan(starts[face], starts[face + 1] - starts[face]);
  }
};

/// A side of one face, between its corner `from` and the next one, `to`.
struct FaceSide {
  int low, high;  ///< its vertices, low < high
  int face;
  int from, to;  ///< places in FaceList::vertices
  bool forward;  ///< from `low` to `high`
};

/// The edge that sides with the same vertices make.
using FaceEdge = std::span<const FaceSide>;

/// The sides of all faces, those of one edge together, edges ascending by their vertices. Sides
/// that end where they start are left out.
std::vector<FaceSide> face_sides(const FaceList& faces);

/// Calls body(FaceEdge) for one edge after the other.
template <class Body>
void for_each_edge(const std::vector<FaceSide>& sides, const Body& body) {
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].low == sides[begin].low &&
           sides[end].high == sides[begin].high)
      ++end;
    body(FaceEdge(sides).subspan(begin, end - begin));
  }
}

inline bool is_boundary(FaceEdge edge) {
  return edge.size() == 1;
}
inline bool is_nonmanifold(FaceEdge edge) {
  return edge.size() > 2;
}

/// Its two faces pass it the same way, so they look to opposite sides.
inline bool is_inconsistent(FaceEdge edge) {
  return edge.size() == 2 && edge[0].forward == edge[1].forward;
}

/// How faces hang together.
struct Topology {
  long vertices = 0;  ///< that faces use
  long edges = 0, faces = 0;
  long boundary_edges = 0, nonmanifold_edges = 0, inconsistent_edges = 0;
  std::vector<int> nonmanifold_vertices;  ///< around which faces do not hang together, ascending
  long components = 0;                    ///< of faces that share vertices
  bool orientable = true;  ///< faces can be turned one way, across all edges of two faces

  bool closed() const { return boundary_edges == 0; }
  bool manifold() const { return nonmanifold_edges == 0 && nonmanifold_vertices.empty(); }
  bool watertight() const { return closed() && nonmanifold_edges == 0 && inconsistent_edges == 0; }

  long euler_characteristic() const { return vertices - edges + faces; }

  /// Handles of all components together; only of a surface that has a genus.
  bool has_genus() const { return closed() && manifold() && orientable; }
  long genus() const { return components - euler_characteristic() / 2; }
};
Topology topology(const FaceList& faces, const std::vector<FaceSide>& sides);

/// For each face the component it is of, numbered from 0 in the order of the faces.
std::vector<int> face_components(const FaceList& faces);

}  // namespace supple
