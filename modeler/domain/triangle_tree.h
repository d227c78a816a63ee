#pragma once

#include <array>
#include <limits>
#include <vector>

#include "solver/core/types.h"

namespace supple {

/// The point of a set of triangles that is nearest to some place.
struct ClosestPoint {
  Vec3 point = Vec3::Zero();
  double squared_distance = std::numeric_limits<double>::infinity();  ///< [m²]
  int triangle = -1;
};

/// Where a segment passes through a triangle.
struct Crossing {
  double share;  ///< of the segment, in [0, 1]
  int triangle;
  bool outward;  ///< from the triangle's back to its front
};

/// Bounding-volume hierarchy over triangles that need not join: closest points and generalised
/// winding numbers. Queries have no state, so any number of threads may ask.
class TriangleTree {
 public:
  /// `positions` [m] n×3, near the origin when compared with their extent.
  TriangleTree(const Points& positions, const Triangles& triangles);

  /// Of the triangles nearer than `within` [m]; where there is none, `triangle` is −1.
  ClosestPoint closest(const Vec3& x,
                       double within = std::numeric_limits<double>::infinity()) const;

  /// The triangles that the segment from a to b passes through, in no order. A segment through an
  /// edge passes through each triangle at that edge.
  void crossings(const Vec3& a, const Vec3& b, std::vector<Crossing>& found) const;

  /// True where the segment from a to b passes through any triangle from its back to its front.
  bool leaves(const Vec3& a, const Vec3& b) const;

  /// The triangles whose boxes meet `box`, in no order.
  void meeting(const Box& box, std::vector<int>& found) const;

  /// Σ solid angles / 4π. Far nodes count by the first two terms of their expansion, near
  /// triangles exactly (Barill et al. 2018, Eq. 4–13; van Oosterom & Strackee 1983). Off by less
  /// than 0.1 on closed surfaces: enough to tell one integer from the next.
  double winding_number(const Vec3& x) const;

  /// How many triangles the winding number at x counts exactly: what it costs.
  long counted_exactly(const Vec3& x) const;

 private:
  using Corners = std::array<Vec3, 3>;

  /// A run of triangles; its halves are the next node and `second`, a leaf has none.
  struct Node {
    Box box;
    int first = 0, count = 0, second = 0;
    bool leaf() const { return second == 0; }
  };

  /// What a node's triangles look like from afar.
  struct Dipole {
    Vec3 center = Vec3::Zero();  ///< centroid of the area [m]
    double squared_reach = 0;    ///< no corner is farther from the centre [m²]
    Vec3 normal = Vec3::Zero();  ///< Σ area normals [m²]
    Mat3 moment = Mat3::Zero();  ///< Σ (centroid − centre) ⊗ area normal [m³]
  };

  struct Centroid {
    Vec3 position;
    int triangle;
  };
  struct Sums;

  /// What the nodes far from x have of its winding number goes into far(dipole, r).
  template <class Far, class Near>
  void sum_up(const Vec3& x, const Far& far, const Near& near) const;

  /// Goes down into the nodes that enter(node) lets in, and calls stop(t) for the triangles of
  /// their leaves, until it returns true.
  template <class Enter, class Stop>
  bool walk(const Enter& enter, const Stop& stop) const;

  /// Calls stop(crossing) for the triangles that a segment passes through, until it returns true.
  template <class Stop>
  bool cross(const Vec3& a, const Vec3& b, const Stop& stop) const;

  void split(std::vector<Centroid>& centroids, int first, int count);
  void measure_nodes();
  Dipole dipole(int node, const Sums& sums) const;

  std::vector<Node> nodes_;  ///< parents before children
  std::vector<Dipole> dipoles_;
  std::vector<Corners> corners_;  ///< in the order of the leaves
  std::vector<int> triangles_;    ///< the triangle that each of corners_ is
};

}  // namespace supple
