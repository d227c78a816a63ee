#include "modeler/domain/cell_quadrature.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "modeler/domain/leaf_parts.h"
#include "solver/core/check.h"
#include "solver/core/parallel.h"

namespace supple {

namespace {

constexpr Index leaves_a_chunk = 16;

struct GaussRule {
  std::array<double, 3> nodes, weights;  ///< on [−1, 1]; the weights' sum is 1
};

GaussRule gauss_rule(int order) {
  if (order == 1) return {{0}, {1}};
  if (order == 2) return {{-std::sqrt(1.0 / 3), std::sqrt(1.0 / 3)}, {0.5, 0.5}};
  return {{-std::sqrt(0.6), 0, std::sqrt(0.6)}, {5.0 / 18, 8.0 / 18, 5.0 / 18}};
}

/// The pieces of a leaf in one of its order³ boxes.
struct BoxOfParts {
  double volume = 0;
  Vec3 first = Vec3::Zero();
  std::vector<Vec3> centroids;

  void add(const LeafPart& part) {
    volume += part.volume;
    first += part.volume * part.centroid;
    centroids.push_back(part.centroid);
  }

  void add(const BoxOfParts& other) {
    volume += other.volume;
    first += other.first;
    centroids.insert(centroids.end(), other.centroids.begin(), other.centroids.end());
  }
};

/// Places quadrature points in leaves, one after another.
class LeafQuadrature {
 public:
  LeafQuadrature(const Region& region, const CellQuadratureOptions& options,
                 std::vector<LeafPart>& points)
      : region_(region), options_(options), rule_(gauss_rule(options.order)), points_(points) {}

  void add(const OctreeLeaf& leaf) {
    if (leaf.kind == LeafKind::interior)
      add_gauss(leaf);
    else if (leaf.kind != LeafKind::exterior)
      add_cut(leaf);
  }

 private:
  std::size_t boxes() const {
    const auto order = static_cast<std::size_t>(options_.order);
    return order * order * order;
  }

  void add_gauss(const OctreeLeaf& leaf) {
    const double volume = std::pow(2 * leaf.half_width, 3);
    for (std::size_t box = 0; box < boxes(); ++box) {
      LeafPart point{leaf.center, volume};
      std::size_t rest = box;
      for (int axis = 0; axis < 3; ++axis) {
        const std::size_t k = rest % static_cast<std::size_t>(options_.order);
        rest /= static_cast<std::size_t>(options_.order);
        point.centroid[axis] += leaf.half_width * rule_.nodes[k];
        point.volume *= rule_.weights[k];
      }
      points_.push_back(point);
    }
  }

  void add_cut(const OctreeLeaf& leaf) {
    parts_.clear();
    append_parts(region_, leaf, options_.halvings, parts_);
    std::vector<BoxOfParts> boxes(this->boxes());
    for (const LeafPart& part : parts_) boxes[box_of(leaf, part.centroid)].add(part);
    join_small(leaf, boxes);
    for (const BoxOfParts& box : boxes)
      if (box.volume > 0) points_.push_back({place_in(box), box.volume});
  }

  std::size_t box_of(const OctreeLeaf& leaf, const Vec3& x) const {
    std::size_t box = 0;
    for (int axis = 2; axis >= 0; --axis) {
      const double at = 0.5 * (1 + (x[axis] - leaf.center[axis]) / leaf.half_width);
      const int k = std::clamp(static_cast<int>(at * options_.order), 0, options_.order - 1);
      box = box * static_cast<std::size_t>(options_.order) + static_cast<std::size_t>(k);
    }
    return box;
  }

  void join_small(const OctreeLeaf& leaf, std::vector<BoxOfParts>& boxes) const {
    const auto greatest = std::max_element(
        boxes.begin(), boxes.end(),
        [](const BoxOfParts& a, const BoxOfParts& b) { return a.volume < b.volume; });
    const double full = std::pow(2 * leaf.half_width, 3) / static_cast<double>(boxes.size());
    for (BoxOfParts& box : boxes) {
      if (&box == &*greatest || box.volume >= options_.least_share * full) continue;
      greatest->add(box);
      box = {};
    }
  }

  /// The centroid, or the piece nearest to it where that is outside.
  Vec3 place_in(const BoxOfParts& box) const {
    const Vec3 centroid = box.first / box.volume;
    if (region_.contains(centroid)) return centroid;
    return *std::min_element(box.centroids.begin(), box.centroids.end(),
                             [&](const Vec3& a, const Vec3& b) {
                               return (a - centroid).norm() < (b - centroid).norm();
                             });
  }

  const Region& region_;
  const CellQuadratureOptions& options_;
  GaussRule rule_;
  std::vector<LeafPart>& points_;
  std::vector<LeafPart> parts_;
};

}  // namespace

Quadrature cell_quadrature(const Region& region, const Octree& octree,
                           const CellQuadratureOptions& options) {
  SUPPLE_CHECK(options.order >= 1 && options.order <= 3, "a Gauss rule of one to three points");
  const std::vector<OctreeLeaf>& leaves = octree.leaves();
  const Index count = static_cast<Index>(leaves.size());
  std::vector<std::vector<LeafPart>> chunks(
      static_cast<std::size_t>((count + leaves_a_chunk - 1) / leaves_a_chunk));
  parallel_chunks(count, leaves_a_chunk, [&](Index begin, Index end) {
    LeafQuadrature quadrature(region, options,
                              chunks[static_cast<std::size_t>(begin / leaves_a_chunk)]);
    for (Index i = begin; i < end; ++i) quadrature.add(leaves[static_cast<std::size_t>(i)]);
  });
  std::size_t size = 0;
  for (const auto& chunk : chunks) size += chunk.size();
  Quadrature result{Points(static_cast<Index>(size), 3), Eigen::VectorXd(static_cast<Index>(size))};
  Index row = 0;
  for (const auto& chunk : chunks)
    for (const LeafPart& point : chunk) {
      result.points.row(row) = point.centroid.transpose();
      result.volumes[row++] = point.volume;
    }
  return result;
}

}  // namespace supple
