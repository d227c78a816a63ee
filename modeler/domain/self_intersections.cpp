#include "modeler/domain/self_intersections.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "modeler/domain/orientation.h"
#include "modeler/domain/triangle_tree.h"
#include "modeler/domain/welded_surface.h"
#include "solver/core/parallel.h"

namespace supple {
namespace {

using Vec2 = Eigen::Vector2d;
using Corners = std::array<Vec3, 3>;
constexpr int chunk = 512;
constexpr Index probes = 512;

/// Without the coordinate along which the triangle is seen widest.
struct Shadow {
  int u, v;

  explicit Shadow(const Corners& t) {
    int axis = 0;
    (t[1] - t[0]).cross(t[2] - t[0]).cwiseAbs().maxCoeff(&axis);
    u = (axis + 1) % 3;
    v = (axis + 2) % 3;
  }
  Vec2 operator()(const Vec3& x) const { return {x[u], x[v]}; }
};

bool boxes_meet(const Vec2& a, const Vec2& b, const Vec2& p, const Vec2& q) {
  return (a.cwiseMin(b).array() <= p.cwiseMax(q).array()).all() &&
         (p.cwiseMin(q).array() <= a.cwiseMax(b).array()).all();
}

bool segments_meet(const Vec2& a, const Vec2& b, const Vec2& p, const Vec2& q) {
  const int ap = orientation(a, b, p), aq = orientation(a, b, q);
  const int pa = orientation(p, q, a), pb = orientation(p, q, b);
  if (ap == 0 && aq == 0) return boxes_meet(a, b, p, q);  // on one line
  return ap * aq <= 0 && pa * pb <= 0;
}

/// A segment and a triangle in one plane, rims included.
bool meets_in_plane(const Vec3& a, const Vec3& b, const Corners& t) {
  const Shadow shadow(t);
  const Vec2 from = shadow(a), to = shadow(b);
  const std::array<Vec2, 3> p{shadow(t[0]), shadow(t[1]), shadow(t[2])};
  std::array<int, 3> sides;
  for (int k = 0; k < 3; ++k) sides[k] = orientation(p[k], p[(k + 1) % 3], from);
  if (*std::min_element(sides.begin(), sides.end()) >= 0 ||
      *std::max_element(sides.begin(), sides.end()) <= 0)
    return true;
  for (int k = 0; k < 3; ++k)
    if (segments_meet(from, to, p[k], p[(k + 1) % 3])) return true;
  return false;
}

/// A segment and a triangle, ends and rims included.
bool meets(const Vec3& a, const Vec3& b, const Corners& t) {
  const int from = orientation(t[0], t[1], t[2], a), to = orientation(t[0], t[1], t[2], b);
  if (from * to > 0) return false;
  if (from == 0 && to == 0) return meets_in_plane(a, b, t);
  int least = 1, greatest = -1;
  for (int k = 0; k < 3; ++k) {
    const int side = orientation(a, b, t[k], t[(k + 1) % 3]);
    least = std::min(least, side);
    greatest = std::max(greatest, side);
  }
  return least >= 0 || greatest <= 0;
}

/// Two triangles by their corners' numbers, equal where they share them.
class TrianglePair {
 public:
  TrianglePair(const Points& positions, const Eigen::RowVector3i& s, const Eigen::RowVector3i& t)
      : first_(s), second_(t) {
    for (int k = 0; k < 3; ++k) {
      s_[k] = positions.row(s[k]);
      t_[k] = positions.row(t[k]);
    }
  }

  bool intersects() const {
    int shared = 0, own_s = 0, own_t = 0;  // sums of the corners that are shared, and of the others
    for (int k = 0; k < 3; ++k) {
      const bool in_t = (second_.array() == first_[k]).any();
      const bool in_s = (first_.array() == second_[k]).any();
      shared += in_t ? 1 : 0;
      own_s += in_t ? 0 : k;
      own_t += in_s ? 0 : k;
    }
    if (shared == 0) return disjoint_corners_meet();
    if (shared == 1) return fan_meets(3 - own_s, 3 - own_t);
    return shared == 2 && folded(own_s, own_t);
  }

 private:
  bool disjoint_corners_meet() const {
    for (int k = 0; k < 3; ++k)
      if (meets(s_[k], s_[(k + 1) % 3], t_) || meets(t_[k], t_[(k + 1) % 3], s_)) return true;
    return false;
  }

  /// One corner shared, its numbers given: what they share beyond it reaches an opposite edge.
  bool fan_meets(int in_s, int in_t) const {
    return meets(s_[(in_s + 1) % 3], s_[(in_s + 2) % 3], t_) ||
           meets(t_[(in_t + 1) % 3], t_[(in_t + 2) % 3], s_);
  }

  /// An edge shared, the opposite corners given: they overlap where one is folded onto the other.
  bool folded(int in_s, int in_t) const {
    if (orientation(s_[0], s_[1], s_[2], t_[in_t]) != 0) return false;
    const Shadow shadow(s_);
    const Vec2 a = shadow(s_[(in_s + 1) % 3]), b = shadow(s_[(in_s + 2) % 3]);
    return orientation(a, b, shadow(s_[in_s])) == orientation(a, b, shadow(t_[in_t]));
  }

  Eigen::RowVector3i first_, second_;
  Corners s_, t_;
};

/// Triangles with area, in a scale in which no product of coordinates underflows.
struct Soup {
  Points positions;
  Triangles triangles;
  std::vector<int> numbers;  ///< the triangle of the caller's that each is
};

Soup make_soup(const Points& positions, const Triangles& triangles) {
  Soup soup;
  const double largest = positions.size() > 0 ? positions.cwiseAbs().maxCoeff() : 0;
  soup.positions = positions * (largest > 0 ? std::ldexp(1.0, -std::ilogb(largest)) : 1);
  soup.numbers = rows_with_area(positions, triangles);
  soup.triangles = triangles(soup.numbers, Eigen::all);
  return soup;
}

class Search {
 public:
  explicit Search(const Soup& soup) : soup_(soup), tree_(soup.positions, soup.triangles) {}

  /// Pairs that box tests leave, about; from a few triangles.
  double candidates() const {
    const Index count = soup_.triangles.rows(), step = std::max<Index>(1, count / probes);
    std::vector<int> near;
    double found = 0;
    Index asked = 0;
    for (Index t = 0; t < count; t += step, ++asked) {
      tree_.meeting(box(t), near);
      found += static_cast<double>(near.size());
    }
    return asked > 0 ? found / static_cast<double>(asked) * static_cast<double>(count) / 2 : 0;
  }

  /// Holds every `step`-th triangle against those behind it.
  std::vector<std::array<int, 2>> run(Index step) const {
    const Index count = (soup_.triangles.rows() + step - 1) / step;
    std::vector<std::vector<std::array<int, 2>>> found(
        static_cast<std::size_t>((count + chunk - 1) / chunk));
    parallel_chunks(count, chunk, [&](Index begin, Index end) {
      std::vector<int> near;
      for (Index i = begin; i < end; ++i) test(i * step, near, found[begin / chunk]);
    });
    std::vector<std::array<int, 2>> all;
    for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
    return all;
  }

 private:
  Box box(Index t) const {
    Box box;
    for (int k = 0; k < 3; ++k) box.extend(soup_.positions.row(soup_.triangles(t, k)).transpose());
    return box;
  }

  void test(Index t, std::vector<int>& near, std::vector<std::array<int, 2>>& found) const {
    tree_.meeting(box(t), near);
    for (const int other : near) {
      if (other <= t) continue;
      const TrianglePair pair(soup_.positions, soup_.triangles.row(t), soup_.triangles.row(other));
      if (pair.intersects()) found.push_back({soup_.numbers[t], soup_.numbers[other]});
    }
  }

  const Soup& soup_;
  TriangleTree tree_;
};

}  // namespace

SelfIntersections self_intersections(const Points& positions, const Triangles& triangles,
                                     const SelfIntersectionOptions& options) {
  const Soup soup = make_soup(positions, triangles);
  const Search search(soup);
  const double excess = search.candidates() / options.most_candidates;
  const Index step = excess > 1 ? static_cast<Index>(std::ceil(excess)) : 1;
  SelfIntersections result;
  result.pairs = search.run(step);
  result.count = static_cast<long>(result.pairs.size()) * static_cast<long>(step);
  result.tested = 1.0 / static_cast<double>(step);
  std::sort(result.pairs.begin(), result.pairs.end());
  result.pairs.resize(std::min(result.pairs.size(), static_cast<std::size_t>(options.most_pairs)));
  return result;
}

}  // namespace supple
