#include "io/picture/smooth_corners.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace supple {
namespace {

std::vector<Vec3> area_normals(const Points& positions, const Triangles& triangles) {
  std::vector<Vec3> normals(triangles.rows());
  for (Index t = 0; t < triangles.rows(); ++t) {
    const Vec3 a = positions.row(triangles(t, 0)), b = positions.row(triangles(t, 1)),
               c = positions.row(triangles(t, 2));
    normals[t] = (b - a).cross(c - a);
  }
  return normals;
}

/// Union–find whose root is the smallest member.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int i, int j) {
    const auto [low, high] = std::minmax({root(i), root(j)});
    parent_[high] = low;
  }

 private:
  std::vector<int> parent_;
};

/// The edge that starts at a corner and runs to the triangle's next one.
struct Edge {
  int far_vertex;  // the greater of its two
  int corner;
};

/// All edges, sorted into one bucket for each smaller vertex and by `far_vertex` inside it.
struct EdgeTable {
  std::vector<int> starts;
  std::vector<Edge> edges;
};

int next_corner(int corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}

EdgeTable sort_edges(Index vertex_count, const Triangles& triangles) {
  const int* vertex = triangles.data();
  const int corners = static_cast<int>(triangles.size());
  EdgeTable table{std::vector<int>(vertex_count + 1, 0), std::vector<Edge>(corners)};
  for (int c = 0; c < corners; ++c) ++table.starts[std::min(vertex[c], vertex[next_corner(c)]) + 1];
  std::partial_sum(table.starts.begin(), table.starts.end(), table.starts.begin());
  std::vector<int> fill(table.starts.begin(), table.starts.end() - 1);
  for (int c = 0; c < corners; ++c) {
    const auto [near, far] = std::minmax(vertex[c], vertex[next_corner(c)]);
    table.edges[fill[near]++] = {far, c};
  }
  for (Index v = 0; v < vertex_count; ++v)
    std::stable_sort(table.edges.begin() + table.starts[v],
                     table.edges.begin() + table.starts[v + 1],
                     [](const Edge& a, const Edge& b) { return a.far_vertex < b.far_vertex; });
  return table;
}

/// Two faces without area between them decide nothing, so they count as smooth.
bool meet_smoothly(const Vec3& a, const Vec3& b, double least_cosine) {
  return a.dot(b) >= least_cosine * a.norm() * b.norm();
}

void join_across(const int* vertex, const Edge& a, const Edge& b, DisjointSets& sets) {
  const int a_next = next_corner(a.corner), b_next = next_corner(b.corner);
  const bool same_way = vertex[a.corner] == vertex[b.corner];
  sets.join(a.corner, same_way ? b.corner : b_next);
  sets.join(a_next, same_way ? b_next : b.corner);
}

}  // namespace

SmoothCorners smooth_corners(const Points& positions, const Triangles& triangles,
                             double crease_angle_deg) {
  const double least_cosine = std::cos(crease_angle_deg * std::numbers::pi / 180);
  const std::vector<Vec3> normals = area_normals(positions, triangles);
  const int* vertex = triangles.data();
  DisjointSets sets(triangles.size());
  const EdgeTable table = sort_edges(positions.rows(), triangles);
  for (Index v = 0; v < positions.rows(); ++v)
    for (int e = table.starts[v] + 1; e < table.starts[v + 1]; ++e) {
      const Edge &a = table.edges[e - 1], &b = table.edges[e];
      if (a.far_vertex == b.far_vertex &&
          meet_smoothly(normals[a.corner / 3], normals[b.corner / 3], least_cosine))
        join_across(vertex, a, b, sets);
    }

  SmoothCorners result;
  result.group.resize(triangles.size());
  for (int c = 0; c < static_cast<int>(triangles.size()); ++c) {
    const int root = sets.root(c);
    if (root == c) {
      result.group[c] = static_cast<int>(result.vertex.size());
      result.vertex.push_back(vertex[c]);
      result.normal.emplace_back(Vec3::Zero());
    }
    result.group[c] = result.group[root];  // the root, being the smallest, was there before
    result.normal[result.group[c]] += normals[c / 3];
  }
  return result;
}

}  // namespace supple
