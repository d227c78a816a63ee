#include "modeler/domain/triangle_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace supple {

namespace {

constexpr int leaf_size = 8;
constexpr int stack_size = 64;  // halving 2³¹ triangles goes 31 deep

/// A node is far where its centre is more than this many reaches away.
constexpr double far_ratio = 2.0;

double squared_distance(const Box& box, const Vec3& x) {
  return (box.lower - x).cwiseMax(x - box.upper).cwiseMax(0.0).squaredNorm();
}

Vec3 closest_on_segment(const Vec3& a, const Vec3& b, const Vec3& x) {
  const Vec3 edge = b - a;
  const double length2 = edge.squaredNorm();
  if (length2 <= 0) return a;
  return a + std::clamp(edge.dot(x - a) / length2, 0.0, 1.0) * edge;
}

/// Takes over the triangle's point nearest to x where it is nearer than `best`. Safe for slivers
/// and for triangles that are a line or a point.
void improve(const std::array<Vec3, 3>& corners, int triangle, const Vec3& x, ClosestPoint& best) {
  const auto& [a, b, c] = corners;
  const Vec3 normal = (b - a).cross(c - a);
  const double area2 = normal.squaredNorm();
  const double height = normal.dot(x - a);
  if (height * height >= best.squared_distance * area2 && area2 > 0) return;
  bool inside = area2 > 0;
  for (int k = 0; k < 3; ++k) {
    const Vec3& from = corners[k];
    const Vec3& to = corners[(k + 1) % 3];
    if (area2 > 0 && normal.cross(to - from).dot(x - from) >= 0) continue;
    inside = false;
    const Vec3 point = closest_on_segment(from, to, x);
    const double distance2 = (point - x).squaredNorm();
    if (distance2 < best.squared_distance) best = {point, distance2, triangle};
  }
  if (inside) best = {x - height / area2 * normal, height * height / area2, triangle};
}

/// True where the segment from a with inverse direction may touch the box.
bool touches(const Box& box, const Vec3& a, const Vec3& inverse) {
  double enter = 0, leave = 1;
  for (int k = 0; k < 3; ++k) {
    double near = (box.lower[k] - a[k]) * inverse[k], far = (box.upper[k] - a[k]) * inverse[k];
    if (near > far) std::swap(near, far);
    // A segment within a face's plane gives 0·∞: it may touch.
    if (near > enter) enter = near;
    if (far < leave) leave = far;
  }
  return enter <= leave;
}

bool meet(const Box& a, const Box& b) {
  for (int k = 0; k < 3; ++k)
    if (a.lower[k] > b.upper[k] || b.lower[k] > a.upper[k]) return false;
  return true;
}

/// By the volumes of the tetrahedra that the segment spans with the triangle's edges.
bool passes(const std::array<Vec3, 3>& corners, const Vec3& a, const Vec3& b, Crossing& crossing) {
  const auto& [p, q, r] = corners;
  const Vec3 normal = (q - p).cross(r - p);
  const double from = normal.dot(a - p), to = normal.dot(b - p);
  if (from == to || (from > 0) == (to > 0)) return false;
  const Vec3 way = b - a, pa = p - a, qa = q - a, ra = r - a;
  const double u = way.dot(pa.cross(qa)), v = way.dot(qa.cross(ra)), w = way.dot(ra.cross(pa));
  if (std::min({u, v, w}) < 0 && std::max({u, v, w}) > 0) return false;
  crossing.share = std::clamp(from / (from - to), 0.0, 1.0);
  crossing.outward = from < to;
  return true;
}

/// The sum of triangles' solid angles at x (van Oosterom & Strackee 1983, Eq. 8: twice the angle of
/// a complex number). Their product has the sum of their angles, but for full turns: one arc
/// tangent does for all.
class SolidAngles {
 public:
  explicit SolidAngles(const Vec3& x) : x_(x) {}

  void add(const std::array<Vec3, 3>& corners) {
    const Vec3 a = corners[0] - x_, b = corners[1] - x_, c = corners[2] - x_;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    const double im = a.dot(b.cross(c));
    const double re = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    const double product_re = re_ * re - im_ * im, product_im = re_ * im + im_ * re;
    const double size = std::abs(product_re) + std::abs(product_im);
    if (!(size > 0)) return;  // x is a corner
    const bool up = im >= 0;
    if ((im_ >= 0) == up && (product_im >= 0) != up) turns_ += up ? 1 : -1;
    re_ = product_re / size;
    im_ = product_im / size;
  }

  double sum() const { return 2 * (std::atan2(im_, re_) + 2 * std::numbers::pi * turns_); }

 private:
  const Vec3& x_;
  double re_ = 1, im_ = 0;
  int turns_ = 0;
};

}  // namespace

/// Integrals over a node's triangles, about the origin.
struct TriangleTree::Sums {
  double area = 0;
  Vec3 area_position = Vec3::Zero();
  Vec3 normal = Vec3::Zero();
  Mat3 moment = Mat3::Zero();

  void add(const Corners& t) {
    const Vec3 n = 0.5 * (t[1] - t[0]).cross(t[2] - t[0]);
    const Vec3 centroid = (t[0] + t[1] + t[2]) / 3;
    area += n.norm();
    area_position += n.norm() * centroid;
    normal += n;
    moment += centroid * n.transpose();
  }
  void add(const Sums& other) {
    area += other.area;
    area_position += other.area_position;
    normal += other.normal;
    moment += other.moment;
  }
};

TriangleTree::TriangleTree(const Points& positions, const Triangles& triangles) {
  const int count = static_cast<int>(triangles.rows());
  if (count == 0) return;
  const auto corner = [&](int t, int k) -> Vec3 { return positions.row(triangles(t, k)); };
  std::vector<Centroid> centroids(count);
  for (int t = 0; t < count; ++t)
    centroids[t] = {(corner(t, 0) + corner(t, 1) + corner(t, 2)) / 3, t};
  nodes_.reserve(count);
  split(centroids, 0, count);

  triangles_.reserve(count);
  corners_.reserve(count);
  for (const Centroid& c : centroids) {
    triangles_.push_back(c.triangle);
    corners_.push_back({corner(c.triangle, 0), corner(c.triangle, 1), corner(c.triangle, 2)});
  }
  measure_nodes();
}

/// Halves a run of centroids at the median of their box's longest side.
void TriangleTree::split(std::vector<Centroid>& centroids, int first, int count) {
  const std::size_t node = nodes_.size();
  nodes_.push_back({{}, first, count, 0});
  if (count <= leaf_size) return;
  Box box;
  const auto begin = centroids.begin() + first;
  std::for_each(begin, begin + count, [&](const Centroid& c) { box.extend(c.position); });
  int axis;
  box.size().maxCoeff(&axis);
  const int half = count / 2;
  std::nth_element(begin, begin + half, begin + count, [axis](const auto& a, const auto& b) {
    return a.position[axis] < b.position[axis];
  });
  split(centroids, first, half);
  nodes_[node].second = static_cast<int>(nodes_.size());
  split(centroids, first + half, count - half);
}

/// Boxes and dipoles of all nodes, children first.
void TriangleTree::measure_nodes() {
  dipoles_.resize(nodes_.size());
  std::vector<Sums> sums(nodes_.size());
  for (int i = static_cast<int>(nodes_.size()) - 1; i >= 0; --i) {
    Node& node = nodes_[i];
    if (node.leaf()) {
      for (int t = node.first; t < node.first + node.count; ++t) {
        sums[i].add(corners_[t]);
        for (const Vec3& corner : corners_[t]) node.box.extend(corner);
      }
    } else {
      for (int child : {i + 1, node.second}) {
        sums[i].add(sums[child]);
        node.box.extend(nodes_[child].box.lower);
        node.box.extend(nodes_[child].box.upper);
      }
    }
    dipoles_[i] = dipole(i, sums[i]);
  }
}

TriangleTree::Dipole TriangleTree::dipole(int node, const Sums& sums) const {
  Dipole result;
  result.center = sums.area > 0 ? Vec3(sums.area_position / sums.area) : nodes_[node].box.center();
  for (int t = nodes_[node].first; t < nodes_[node].first + nodes_[node].count; ++t)
    for (const Vec3& corner : corners_[t])
      result.squared_reach = std::max(result.squared_reach, (corner - result.center).squaredNorm());
  result.normal = sums.normal;
  result.moment = sums.moment - result.center * sums.normal.transpose();
  return result;
}

ClosestPoint TriangleTree::closest(const Vec3& x, double within) const {
  ClosestPoint best;
  best.squared_distance = within * within;
  if (nodes_.empty()) return best;
  std::array<std::pair<int, double>, stack_size> stack;
  int size = 0;
  stack[size++] = {0, squared_distance(nodes_[0].box, x)};
  while (size > 0) {
    const auto [at, distance2] = stack[--size];
    if (distance2 >= best.squared_distance) continue;
    const Node& node = nodes_[at];
    if (node.leaf()) {
      for (int t = node.first; t < node.first + node.count; ++t)
        improve(corners_[t], triangles_[t], x, best);
      continue;
    }
    std::pair near(at + 1, squared_distance(nodes_[at + 1].box, x));
    std::pair far(node.second, squared_distance(nodes_[node.second].box, x));
    if (far.second < near.second) std::swap(near, far);
    stack[size++] = far;
    stack[size++] = near;
  }
  return best;
}

template <class Enter, class Stop>
bool TriangleTree::walk(const Enter& enter, const Stop& stop) const {
  if (nodes_.empty()) return false;
  std::array<int, stack_size> stack;
  int size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const int at = stack[--size];
    if (!enter(at)) continue;
    const Node& node = nodes_[at];
    if (!node.leaf()) {
      stack[size++] = node.second;
      stack[size++] = at + 1;
      continue;
    }
    for (int t = node.first; t < node.first + node.count; ++t)
      if (stop(t)) return true;
  }
  return false;
}

template <class Stop>
bool TriangleTree::cross(const Vec3& a, const Vec3& b, const Stop& stop) const {
  const Vec3 inverse = (b - a).cwiseInverse();
  return walk([&](int node) { return touches(nodes_[node].box, a, inverse); },
              [&](int t) {
                Crossing crossing{0, triangles_[t], false};
                return passes(corners_[t], a, b, crossing) && stop(crossing);
              });
}

void TriangleTree::crossings(const Vec3& a, const Vec3& b, std::vector<Crossing>& found) const {
  found.clear();
  cross(a, b, [&](const Crossing& crossing) {
    found.push_back(crossing);
    return false;
  });
}

bool TriangleTree::leaves(const Vec3& a, const Vec3& b) const {
  return cross(a, b, [](const Crossing& crossing) { return crossing.outward; });
}

void TriangleTree::meeting(const Box& box, std::vector<int>& found) const {
  found.clear();
  walk([&](int node) { return meet(nodes_[node].box, box); },
       [&](int t) {
         const auto& [p, q, r] = corners_[t];
         if (meet({p.cwiseMin(q).cwiseMin(r), p.cwiseMax(q).cwiseMax(r)}, box))
           found.push_back(triangles_[t]);
         return false;
       });
}

template <class Far, class Near>
void TriangleTree::sum_up(const Vec3& x, const Far& far, const Near& near) const {
  const auto is_near = [&](int node) {
    const Dipole& dipole = dipoles_[node];
    const Vec3 r = dipole.center - x;
    if (r.squaredNorm() <= far_ratio * far_ratio * dipole.squared_reach) return true;
    far(dipole, r);
    return false;
  };
  walk(is_near, [&](int t) {
    near(corners_[t]);
    return false;
  });
}

double TriangleTree::winding_number(const Vec3& x) const {
  double sum = 0;
  SolidAngles angles(x);
  sum_up(
      x,
      [&](const Dipole& dipole, const Vec3& r) {
        const double r2 = r.squaredNorm();
        sum += (dipole.normal.dot(r) + dipole.moment.trace() - 3 * r.dot(dipole.moment * r) / r2) /
               (r2 * std::sqrt(r2));
      },
      [&](const Corners& corners) { angles.add(corners); });
  return (sum + angles.sum()) / (4 * std::numbers::pi);
}

long TriangleTree::counted_exactly(const Vec3& x) const {
  long count = 0;
  sum_up(
      x, [](const Dipole&, const Vec3&) {}, [&](const Corners&) { ++count; });
  return count;
}

}  // namespace supple
