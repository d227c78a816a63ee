#include "modeler/domain/oriented_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "modeler/domain/surface_measures.h"
#include "modeler/domain/triangle_tree.h"
#include "modeler/domain/welded_surface.h"
#include "solver/core/parallel.h"
#include "solver/core/random.h"

namespace supple {

namespace {

/// Where more than this share of a part had to be turned, the file says nothing about it.
constexpr double unsure_share = 0.1;

/// A part is turned where its front looks outside by less than this (1/2: rays cannot tell).
constexpr double clearly_inside = 0.35;

constexpr double most_rays = 10000, least_rays_a_part = 8;
constexpr int most_rays_a_part = 128;

/// Parts of a smaller share of the area keep the file's turning: rays for each would take long.
constexpr double least_area_share = 1e-6;

void turn(Triangles& triangles, Index row) {
  std::swap(triangles(row, 1), triangles(row, 2));
}

/// Six times each part's signed volume.
std::vector<double> part_volumes(const Points& positions, const Triangles& triangles,
                                 const std::vector<int>& parts) {
  std::vector<double> volumes;
  for (Index t = 0; t < triangles.rows(); ++t) {
    const Vec3 a = positions.row(triangles(t, 0)), b = positions.row(triangles(t, 1)),
               c = positions.row(triangles(t, 2));
    volumes.resize(std::max(volumes.size(), std::size_t(parts[t]) + 1), 0);
    volumes[parts[t]] += a.dot(b.cross(c));
  }
  return volumes;
}

/// A point a little above the middle of a triangle, on the side it looks to.
Vec3 above(const Points& positions, const Triangles& triangles, Index t) {
  const Vec3 middle = (positions.row(triangles(t, 0)) + positions.row(triangles(t, 1)) +
                       positions.row(triangles(t, 2)))
                          .transpose() /
                      3;
  const Vec3 normal = double_area_normal(positions, triangles, t);
  return middle + 1e-4 / std::sqrt(normal.norm()) * normal;
}

/// One side of an edge: the edge of a triangle, the lesser vertex first.
struct EdgeUse {
  int a, b;
  Index triangle;
  bool forward;
};

std::vector<EdgeUse> edge_uses(const Triangles& triangles) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * static_cast<std::size_t>(triangles.rows()));
  for (Index t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(t, k), b = triangles(t, (k + 1) % 3);
      uses.push_back({std::min(a, b), std::max(a, b), t, a < b});
    }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& x, const EdgeUse& y) {
    return std::tie(x.a, x.b, x.triangle) < std::tie(y.a, y.b, y.triangle);
  });
  return uses;
}

/// A triangle that shares an edge with another and no third.
struct Neighbor {
  Index triangle = -1;
  bool agrees = true;
};

std::vector<std::array<Neighbor, 3>> neighbors(const Triangles& triangles) {
  std::vector<std::array<Neighbor, 3>> result(triangles.rows());
  const auto add = [&](Index t, Index other, bool agrees) {
    for (Neighbor& slot : result[t])
      if (slot.triangle < 0) {
        slot = {other, agrees};
        return;
      }
  };
  const std::vector<EdgeUse> uses = edge_uses(triangles);
  for (std::size_t i = 0, end = 0; i < uses.size(); i = end) {
    while (end < uses.size() && uses[end].a == uses[i].a && uses[end].b == uses[i].b) ++end;
    if (end - i != 2) continue;
    const bool agrees = uses[i].forward != uses[i + 1].forward;
    add(uses[i].triangle, uses[i + 1].triangle, agrees);
    add(uses[i + 1].triangle, uses[i].triangle, agrees);
  }
  return result;
}

/// A part whose triangles hang together by edges that two of them share.
struct Patch {
  std::vector<Index> rows;
  double area = 0, turned_area = 0;
  long turned = 0;
  bool closed = false;
  /// False where so much was turned that the file's own turning says nothing.
  bool sure() const { return turned_area <= unsure_share * area; }
};

/// Finds the patches, breadth first, and turns the triangles of each one way.
class PatchFinder {
 public:
  PatchFinder(const Points& positions, Triangles& triangles)
      : positions_(positions), triangles_(triangles), neighbors_(neighbors(triangles)) {
    seen_.assign(neighbors_.size(), 0);
    turned_.assign(neighbors_.size(), 0);
  }

  std::vector<Patch> find() {
    std::vector<Patch> patches;
    for (Index t = 0; t < triangles_.rows(); ++t)
      if (!seen_[t]) patches.push_back(grow(t));
    count_conflicts();
    for (Index t = 0; t < triangles_.rows(); ++t)
      if (turned_[t]) turn(triangles_, t);
    for (Patch& patch : patches)
      patch.closed = boundary_edges(rows_of(triangles_, patch.rows)).empty();
    return patches;
  }

  long conflicts() const { return conflicts_; }

 private:
  Patch grow(Index seed) {
    Patch patch;
    patch.rows.push_back(seed);
    seen_[seed] = 1;
    for (std::size_t at = 0; at < patch.rows.size(); ++at)
      for (const Neighbor& neighbor : neighbors_[patch.rows[at]]) {
        if (neighbor.triangle < 0 || seen_[neighbor.triangle]) continue;
        seen_[neighbor.triangle] = 1;
        turned_[neighbor.triangle] = turned_[patch.rows[at]] != !neighbor.agrees;
        patch.rows.push_back(neighbor.triangle);
      }
    for (const Index t : patch.rows) {
      const double area = double_area_normal(positions_, triangles_, t).norm();
      patch.area += area;
      if (turned_[t]) patch.turned_area += area;
    }
    if (2 * patch.turned_area > patch.area) {
      for (const Index t : patch.rows) turned_[t] = !turned_[t];
      patch.turned_area = patch.area - patch.turned_area;
    }
    for (const Index t : patch.rows) patch.turned += turned_[t];
    return patch;
  }

  void count_conflicts() {
    long twice = 0;
    for (std::size_t t = 0; t < neighbors_.size(); ++t)
      for (const Neighbor& neighbor : neighbors_[t])
        if (neighbor.triangle >= 0 && neighbor.agrees != (turned_[t] == turned_[neighbor.triangle]))
          ++twice;
    conflicts_ = twice / 2;
  }

  const Points& positions_;
  Triangles& triangles_;
  std::vector<std::array<Neighbor, 3>> neighbors_;
  std::vector<char> seen_, turned_;
  long conflicts_ = 0;
};

/// Asks rays whether patches look outside.
class RayVote {
 public:
  RayVote(const Points& positions, const Triangles& triangles)
      : positions_(positions),
        triangles_(triangles),
        tree_(positions, triangles),
        diagonal_(box_of_corners(positions, triangles).diagonal()) {}

  /// 1 where the patch's front looks outside and its back inside, 0 where it is the other way.
  double looks_outside(const std::vector<Index>& rows, int rays, std::uint64_t seed) const {
    std::vector<double> areas(rows.size());
    double area = 0;
    for (std::size_t i = 0; i < rows.size(); ++i)
      areas[i] = area += double_area_normal(positions_, triangles_, rows[i]).norm();
    if (!(area > 0)) return 0.5;
    Random random(seed);
    long right = 0;
    for (int ray = 0; ray < rays; ++ray) {
      const auto at = std::upper_bound(areas.begin(), areas.end(), random.uniform() * area);
      const Index t = rows[std::min<std::size_t>(at - areas.begin(), rows.size() - 1)];
      right += escapes(t, 1, random) ? 1 : 0;
      right += escapes(t, -1, random) ? 0 : 1;
    }
    return right / (2.0 * rays);
  }

 private:
  /// True where a ray from the triangle's front (side 1) or back (−1) passes an even number.
  bool escapes(Index t, double side, Random& random) const {
    double u = random.uniform(), v = random.uniform();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const Vec3 a = positions_.row(triangles_(t, 0)), b = positions_.row(triangles_(t, 1)),
               c = positions_.row(triangles_(t, 2));
    const Vec3 normal = side * (b - a).cross(c - a).normalized();
    const Vec3 start = a + u * (b - a) + v * (c - a) + 1e-6 * diagonal_ * normal;
    // On the sphere about the normal's tip: denser along the normal (Lambert).
    Vec3 way = random.in_cube(-1, 1);
    while (way.squaredNorm() > 1 || way.squaredNorm() < 1e-6) way = random.in_cube(-1, 1);
    way = normal + 0.999 * way.normalized();
    std::vector<Crossing> crossings;
    tree_.crossings(start, start + 2 * diagonal_ * way.normalized(), crossings);
    return crossings.size() % 2 == 0;
  }

  const Points& positions_;
  const Triangles& triangles_;
  TriangleTree tree_;
  double diagonal_;
};

/// The patches' triangles and the patch that each is of.
struct Gathered {
  std::vector<Index> rows;
  std::vector<int> parts;
  explicit Gathered(const std::vector<const Patch*>& patches) {
    for (std::size_t p = 0; p < patches.size(); ++p) {
      rows.insert(rows.end(), patches[p]->rows.begin(), patches[p]->rows.end());
      parts.resize(rows.size(), static_cast<int>(p));
    }
  }
};

/// Turns the patches that the file says nothing about outwards, or inwards where they are
/// cavities: rays leave them by an odd number of walls.
void turn_unsure(const Points& positions, Triangles& closed, const std::vector<int>& parts,
                 const std::vector<const Patch*>& patches) {
  const std::vector<double> volumes = part_volumes(positions, closed, parts);
  std::vector<std::vector<Index>> unsure(patches.size());
  for (Index t = 0; t < closed.rows(); ++t) {
    if (patches[parts[t]]->sure()) continue;
    unsure[parts[t]].push_back(t);
    if (volumes[parts[t]] < 0) turn(closed, t);
  }
  const RayVote vote(positions, closed);
  for (std::size_t p = 0; p < patches.size(); ++p)
    if (!unsure[p].empty() && vote.looks_outside(unsure[p], most_rays_a_part, p) < 0.5)
      for (const Index t : unsure[p]) turn(closed, t);
}

/// Returns whether any patch was turned against a clear file.
bool turn_closed(const Points& positions, Triangles& triangles,
                 const std::vector<const Patch*>& patches) {
  const Gathered all(patches);
  Triangles closed = rows_of(triangles, all.rows);
  if (!std::all_of(patches.begin(), patches.end(),
                   [](const Patch* patch) { return patch->sure(); }))
    turn_unsure(positions, closed, all.parts, patches);
  const Triangles before = closed;
  turn_closed_parts(positions, closed, all.parts);
  bool any = false;
  for (Index t = 0; t < closed.rows(); ++t) {
    any = any || (patches[all.parts[t]]->sure() && closed.row(t) != before.row(t));
    triangles.row(all.rows[t]) = closed.row(t);
  }
  return any;
}

/// Turns open patches by rays among themselves. Returns whether any was turned against a clear
/// file.
bool turn_open(const Points& positions, Triangles& triangles,
               const std::vector<const Patch*>& patches) {
  std::vector<Index> rows;
  std::vector<Index> starts = {0};
  double area = 0;
  for (const Patch* patch : patches) {
    rows.insert(rows.end(), patch->rows.begin(), patch->rows.end());
    starts.push_back(static_cast<Index>(rows.size()));
    area += patch->area;
  }
  const Triangles open = rows_of(triangles, rows);
  const RayVote vote(positions, open);
  std::vector<char> turned(patches.size(), 0);
  parallel_chunks(static_cast<Index>(patches.size()), 4, [&](Index begin, Index end) {
    for (Index p = begin; p < end; ++p) {
      const double share = patches[p]->area / area;
      if (!(share > least_area_share)) continue;
      std::vector<Index> own(patches[p]->rows.size());
      for (std::size_t i = 0; i < own.size(); ++i) own[i] = starts[p] + static_cast<Index>(i);
      const int rays = static_cast<int>(
          std::clamp<double>(most_rays * share, least_rays_a_part, most_rays_a_part));
      const double outside = vote.looks_outside(own, rays, static_cast<std::uint64_t>(p));
      turned[p] = outside < (patches[p]->sure() ? clearly_inside : 0.5);
    }
  });
  bool any = false;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    if (!turned[p]) continue;
    any = any || patches[p]->sure();
    for (const Index t : patches[p]->rows) turn(triangles, t);
  }
  return any;
}

}  // namespace

bool turn_closed_parts(const Points& positions, Triangles& triangles,
                       const std::vector<int>& parts) {
  std::vector<double> volumes = part_volumes(positions, triangles, parts);
  double whole = 0;
  for (const double volume : volumes) whole += volume;
  if (whole < 0) {
    for (Index t = 0; t < triangles.rows(); ++t) turn(triangles, t);
    for (double& volume : volumes) volume = -volume;
  }
  if (std::none_of(volumes.begin(), volumes.end(), [](double v) { return v < 0; }))
    return whole < 0;

  std::vector<Index> first(volumes.size(), -1);
  for (Index t = triangles.rows() - 1; t >= 0; --t) first[parts[t]] = t;
  const TriangleTree tree(positions, triangles);
  std::vector<char> turned(volumes.size(), 0);
  for (std::size_t part = 0; part < volumes.size(); ++part)
    turned[part] =
        volumes[part] < 0 && tree.winding_number(above(positions, triangles, first[part])) < -0.5;
  for (Index t = 0; t < triangles.rows(); ++t)
    if (turned[parts[t]]) turn(triangles, t);
  return whole < 0 || std::find(turned.begin(), turned.end(), 1) != turned.end();
}

Turning orient(const Points& positions, Triangles& triangles) {
  PatchFinder finder(positions, triangles);
  const std::vector<Patch> patches = finder.find();
  Turning turning;
  turning.conflicts = finder.conflicts();
  std::vector<const Patch*> closed, open;
  for (const Patch& patch : patches) {
    turning.turned += patch.turned;
    (patch.closed ? closed : open).push_back(&patch);
  }
  if (!closed.empty()) turning.inside_out |= turn_closed(positions, triangles, closed);
  if (!open.empty()) turning.inside_out |= turn_open(positions, triangles, open);
  return turning;
}

}  // namespace supple
