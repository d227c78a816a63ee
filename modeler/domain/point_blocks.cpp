#include "modeler/domain/point_blocks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "modeler/domain/site_tree.h"
#include "solver/core/parallel.h"
#include "solver/core/random.h"

namespace supple {

namespace {

constexpr Index points_a_block = 32;
constexpr Index blocks_a_chunk = 16;
constexpr double preference = 1e-4;  // the most by which a squared distance is favoured

}  // namespace

PointBlocks::PointBlocks(const Points& points) : points_(points) {
  for (Index first = 0; first < points_.rows(); first += points_a_block) {
    Block block;
    block.first = first;
    block.count = std::min(points_a_block, points_.rows() - first);
    const auto rows = points_.middleRows(first, block.count);
    block.center = rows.colwise().mean();
    block.radius = (rows.rowwise() - block.center.transpose()).rowwise().norm().maxCoeff();
    blocks_.push_back(block);
  }
}

PointBlocks::Nearest PointBlocks::nearest_sites(const Points& sites) const {
  Nearest nearest;
  nearest.sites.resize(points_.rows());
  nearest.squared_distances.resize(points_.rows());
  const SiteTree tree(sites);
  parallel_chunks(static_cast<Index>(blocks_.size()), blocks_a_chunk, [&](Index begin, Index end) {
    for (Index b = begin; b < end; ++b) nearest_in_block(blocks_[b], sites, tree, nearest);
  });
  return nearest;
}

void PointBlocks::nearest_in_block(const Block& block, const Points& sites, const SiteTree& tree,
                                   Nearest& nearest) const {
  const double reach = tree.distance(block.center) + 2 * block.radius;
  const std::vector<int> candidates = tree.within(block.center, reach);
  for (Index i = block.first; i < block.first + block.count; ++i) {
    double best = std::numeric_limits<double>::infinity();
    for (int site : candidates) {
      const double distance2 = (sites.row(site) - points_.row(i)).squaredNorm();
      // Points on a grid often lie midway between sites: rounding must not choose there either.
      if (distance2 < (1 - 1e-6) * best) {
        best = distance2;
        nearest.sites[i] = site;
      }
    }
    nearest.squared_distances[i] = best;
  }
}

/// Distances of all points to the sites so far, and the farthest of each block.
///
/// Every point's squared distance carries a small factor of its own: points on a regular grid are
/// often equally far, and rounding, so the place and unit of the shape, must not choose among them.
class PointBlocks::Farthest {
 public:
  explicit Farthest(const PointBlocks& owner, const Points& sites) : owner_(owner) {
    const Index count = owner.points_.rows();
    preferences_.resize(count);
    Random random(1);
    for (Index i = 0; i < count; ++i) preferences_[i] = random.uniform(1, 1 + preference);
    if (sites.rows() > 0)
      squared_distances_ = owner.nearest_sites(sites).squared_distances.cwiseProduct(preferences_);
    else
      squared_distances_.setConstant(count, std::numeric_limits<double>::infinity());
    for (const Block& block : owner_.blocks_)
      block_maxima_.push_back(squared_distances_.segment(block.first, block.count).maxCoeff());
  }

  void add(const Vec3& site) {
    for (std::size_t b = 0; b < block_maxima_.size(); ++b) {
      const Block& block = owner_.blocks_[b];
      const double nearest = (block.center - site).norm() - block.radius;
      const auto preferences = preferences_.segment(block.first, block.count);
      if (nearest > 0 && nearest * nearest >= block_maxima_[b]) continue;
      auto distances2 = squared_distances_.segment(block.first, block.count);
      const auto points = owner_.points_.middleRows(block.first, block.count);
      distances2 = distances2.cwiseMin(
          (points.rowwise() - site.transpose()).rowwise().squaredNorm().cwiseProduct(preferences));
      block_maxima_[b] = distances2.maxCoeff();
    }
  }

  Index point() const {
    const auto block = std::max_element(block_maxima_.begin(), block_maxima_.end());
    const Block& b = owner_.blocks_[block - block_maxima_.begin()];
    Index offset;
    squared_distances_.segment(b.first, b.count).maxCoeff(&offset);
    return b.first + offset;
  }

  double distance() const {
    return std::sqrt(*std::max_element(block_maxima_.begin(), block_maxima_.end()));
  }

 private:
  const PointBlocks& owner_;
  Eigen::VectorXd preferences_;
  Eigen::VectorXd squared_distances_;
  std::vector<double> block_maxima_;
};

Points PointBlocks::farthest_points(const Points& sites, const Vec3& start,
                                    const Continue& more) const {
  std::vector<Vec3> result(sites.rows());
  for (Index i = 0; i < sites.rows(); ++i) result[i] = sites.row(i);
  Farthest farthest(*this, sites);
  if (result.empty()) {
    Index first;
    (points_.rowwise() - start.transpose()).rowwise().squaredNorm().minCoeff(&first);
    result.push_back(points_.row(first));
    farthest.add(result.back());
  }
  while (more(static_cast<Index>(result.size()), farthest.distance())) {
    result.push_back(points_.row(farthest.point()));
    farthest.add(result.back());
  }
  return Eigen::Map<const Points>(result.front().data(), static_cast<Index>(result.size()), 3);
}

}  // namespace supple
