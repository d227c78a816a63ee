#include "modeler/domain/site_tree.h"

#include <array>
#include <cmath>
#include <limits>

#include <nanoflann.hpp>

namespace supple {

struct SiteTree::Tree {
  explicit Tree(const Points& points) : sites(points), search(3, std::cref(points)) {}

  const Points& sites;
  nanoflann::KDTreeEigenMatrixAdaptor<Points, 3> search;
};

SiteTree::SiteTree(const Points& sites) : tree_(std::make_unique<Tree>(sites)) {}

SiteTree::~SiteTree() = default;

double SiteTree::distance(const Vec3& x) const {
  Index site = 0;
  double squared_distance = 0;
  tree_->search.query(x.data(), 1, &site, &squared_distance);
  return std::sqrt(squared_distance);
}

int SiteTree::nearest(const Vec3& x, std::span<Index> sites,
                      std::span<double> squared_distances) const {
  nanoflann::KNNResultSet<double, Index> found(sites.size());
  found.init(sites.data(), squared_distances.data());
  tree_->search.index->findNeighbors(found, x.data(), nanoflann::SearchParams());
  return static_cast<int>(found.size());
}

std::vector<int> SiteTree::within(const Vec3& x, double radius) const {
  std::vector<std::pair<Index, double>> found;
  // The search leaves out what is exactly at the rim.
  const double reach = radius * radius * (1 + 1e-12) + std::numeric_limits<double>::min();
  tree_->search.index->radiusSearch(x.data(), reach, found, {32, 0, false});
  std::vector<int> sites;
  for (const auto& [site, distance2] : found) sites.push_back(static_cast<int>(site));
  return sites;
}

SiteTree::Pair SiteTree::closest_pair() const {
  Pair best{std::numeric_limits<double>::infinity(), -1, -1};
  if (tree_->sites.rows() < 2) return best;
  for (Index i = 0; i < tree_->sites.rows(); ++i) {
    std::array<Index, 2> sites{};
    std::array<double, 2> squared_distances{};
    const Vec3 x = tree_->sites.row(i);
    tree_->search.query(x.data(), 2, sites.data(), squared_distances.data());
    const Index other = sites[0] == i ? sites[1] : sites[0];
    const double distance = std::sqrt(squared_distances[1]);
    if (distance < best.distance) best = {distance, static_cast<int>(i), static_cast<int>(other)};
  }
  return best;
}

}  // namespace supple
