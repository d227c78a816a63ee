#include "solver/field/neighbors.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <nanoflann.hpp>

#include "solver/core/check.h"

namespace supple {
namespace {

/// Some of the particles, as nanoflann wants to see them.
template <int Dim>
struct PointSet {
  PointsOf<Dim> positions;
  std::vector<int> particles;

  std::size_t kdtree_get_point_count() const { return particles.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t k) const {
    return positions(static_cast<Index>(i), static_cast<Index>(k));
  }
  template <class Bounds>
  bool kdtree_get_bbox(Bounds&) const {
    return false;
  }
};

template <int Dim>
struct Tree {
  using Search =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointSet<Dim>>,
                                          PointSet<Dim>, Dim, unsigned>;
  PointSet<Dim> set;
  double reach;  ///< the widest in the set
  std::unique_ptr<Search> search;
};

/// Collects into a caller's array without ordering or allocating for every query.
struct ReachingSet {
  using DistanceType = double;
  double squared_radius;
  const std::vector<int>& particles;
  const Eigen::VectorXd& reaches;
  std::vector<int>& found;

  std::size_t size() const { return found.size(); }
  bool full() const { return true; }
  double worstDist() const { return squared_radius; }
  bool addPoint(double squared_distance, unsigned i) {
    const int particle = particles[i];
    const double reach = reaches[particle];
    if (squared_distance < reach * reach) found.push_back(particle);
    return true;
  }
};

/// The same for one radius.
struct NearSet {
  using DistanceType = double;
  double squared_radius;
  const std::vector<int>& particles;
  std::vector<int>& found;

  std::size_t size() const { return found.size(); }
  bool full() const { return true; }
  double worstDist() const { return squared_radius; }
  bool addPoint(double squared_distance, unsigned i) {
    if (squared_distance < squared_radius) found.push_back(particles[i]);
    return true;
  }
};

}  // namespace

template <int Dim>
struct Neighbors<Dim>::Trees {
  Eigen::VectorXd reaches;
  std::vector<Tree<Dim>> trees;
};

template <int Dim>
Neighbors<Dim>::Neighbors(const PointsOf<Dim>& positions, const Eigen::VectorXd& reaches)
    : trees_(std::make_unique<Trees>()) {
  SUPPLE_CHECK(positions.rows() == reaches.size(), "one reach a particle");
  SUPPLE_CHECK(positions.allFinite() && reaches.allFinite(), "positions and reaches are finite");
  trees_->reaches = reaches;
  std::map<int, std::vector<int>> octaves;
  for (Index i = 0; i < reaches.size(); ++i) {
    SUPPLE_CHECK(reaches[i] > 0, "reaches are positive");
    octaves[std::ilogb(reaches[i])].push_back(static_cast<int>(i));
  }
  trees_->trees.reserve(octaves.size());  // the searches keep references into the trees
  for (auto& [octave, particles] : octaves) {
    Tree<Dim>& tree = trees_->trees.emplace_back();
    tree.reach = 0;
    tree.set.positions.resize(static_cast<Index>(particles.size()), Dim);
    for (std::size_t i = 0; i < particles.size(); ++i) {
      tree.set.positions.row(static_cast<Index>(i)) = positions.row(particles[i]);
      tree.reach = std::max(tree.reach, reaches[particles[i]]);
    }
    tree.set.particles = std::move(particles);
    tree.search = std::make_unique<typename Tree<Dim>::Search>(Dim, tree.set);
    tree.search->buildIndex();
  }
}

template <int Dim>
Neighbors<Dim>::~Neighbors() = default;
template <int Dim>
Neighbors<Dim>::Neighbors(Neighbors&&) noexcept = default;
template <int Dim>
Neighbors<Dim>& Neighbors<Dim>::operator=(Neighbors&&) noexcept = default;

template <int Dim>
void Neighbors<Dim>::reaching(const VectorOf<Dim>& x, std::vector<int>& particles) const {
  particles.clear();
  for (const Tree<Dim>& tree : trees_->trees) {
    ReachingSet found{tree.reach * tree.reach, tree.set.particles, trees_->reaches, particles};
    tree.search->findNeighbors(found, x.data(), nanoflann::SearchParams());
  }
  std::sort(particles.begin(), particles.end());
}

template <int Dim>
void Neighbors<Dim>::within(const VectorOf<Dim>& x, double radius,
                            std::vector<int>& particles) const {
  particles.clear();
  for (const Tree<Dim>& tree : trees_->trees) {
    NearSet found{radius * radius, tree.set.particles, particles};
    tree.search->findNeighbors(found, x.data(), nanoflann::SearchParams());
  }
  std::sort(particles.begin(), particles.end());
}

template <int Dim>
std::vector<int> Neighbors<Dim>::nearest(const VectorOf<Dim>& x, int count) const {
  std::vector<std::pair<double, int>> all;
  std::vector<unsigned> found(static_cast<std::size_t>(count));
  std::vector<double> squared_distances(static_cast<std::size_t>(count));
  for (const Tree<Dim>& tree : trees_->trees) {
    const std::size_t n = tree.search->knnSearch(x.data(), static_cast<std::size_t>(count),
                                                 found.data(), squared_distances.data());
    for (std::size_t i = 0; i < n; ++i)
      all.emplace_back(squared_distances[i], tree.set.particles[found[i]]);
  }
  std::sort(all.begin(), all.end());
  all.resize(std::min(all.size(), static_cast<std::size_t>(count)));
  std::vector<int> particles;
  for (const auto& [distance, particle] : all) particles.push_back(particle);
  return particles;
}

template class Neighbors<1>;
template class Neighbors<2>;
template class Neighbors<3>;

}  // namespace supple
