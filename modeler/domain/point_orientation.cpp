#include "modeler/domain/point_orientation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>

#include "solver/core/parallel.h"

namespace supple {

namespace {

constexpr int tree_neighbors = 10;
constexpr double doubt_of_length = 0.1;  // of a way as long as to the farthest neighbour
constexpr int most_sweeps = 4;
constexpr double scatters = 1;
constexpr Index asked_points = 1000;

/// How normals go from point to point.
class Transport {
 public:
  Transport(const Points& positions, const PointNeighbors& neighbors, const Points& normals)
      : positions_(positions), normals_(normals) {
    std::vector<double> variances;
    const Index step = std::max<Index>(1, positions.rows() / asked_points);
    for (Index i = 0; i < positions.rows(); i += step)
      variances.push_back(height_variance(i, neighbors.of(i)));
    const auto middle = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 2);
    std::nth_element(variances.begin(), middle, variances.end());
    scatter2_ = std::pow(scatters, 2) * *middle;
  }

  /// Cosine between the normal at j and the normal at i brought there. Ways no longer than the
  /// points scatter about their surface have no direction: the normal stays as it is.
  double agreement(Index i, Index j) const {
    const Vec3 way = (positions_.row(j) - positions_.row(i)).transpose();
    const Vec3 from = normals_.row(i), to = normals_.row(j);
    return from.dot(to) - 2 * way.dot(from) * way.dot(to) / (way.squaredNorm() + scatter2_);
  }

 private:
  double height_variance(Index i, std::span<const int> others) const {
    double sum = 0, squares = 0;
    for (int j : others) {
      const double height = normals_.row(i).dot(positions_.row(j) - positions_.row(i));
      sum += height;
      squares += height * height;
    }
    const auto count = static_cast<double>(others.size()) + 1;
    return squares / count - sum * sum / (count * count);
  }

  const Points& positions_;
  const Points& normals_;
  double scatter2_;  ///< [m²]
};

struct Link {
  float doubt;
  int a, b;
  bool opposite;
  bool operator<(const Link& other) const {
    return std::tie(doubt, a, b) < std::tie(other.doubt, other.a, other.b);
  }
};

std::vector<Link> links(const Points& positions, const PointNeighbors& neighbors,
                        const Points& normals) {
  const Transport transport(positions, neighbors, normals);
  std::vector<Link> result;
  const auto count = static_cast<std::size_t>(std::min(tree_neighbors, neighbors.count()));
  for (Index i = 0; i < positions.rows(); ++i) {
    const double farthest = std::sqrt(neighbors.squared_distances(i).back());
    for (std::size_t k = 0; k < count; ++k) {
      const int j = neighbors.of(i)[k];
      const double cosine = transport.agreement(i, j);
      const double length = std::sqrt(neighbors.squared_distances(i)[k]) / farthest;
      result.push_back({static_cast<float>(1 - std::abs(cosine) + doubt_of_length * length),
                        static_cast<int>(i), j, cosine < 0});
    }
  }
  return result;
}

/// Disjoint sets whose members know whether they are turned against their set's first member.
class TurnedSets {
 public:
  explicit TurnedSets(Index count)
      : parents_(static_cast<std::size_t>(count)),
        sizes_(parents_.size(), 1),
        turned_(parents_.size(), 0) {
    std::iota(parents_.begin(), parents_.end(), 0);
  }

  struct Place {
    int first;
    bool turned;
  };
  Place find(int i) {
    Place place{i, false};
    for (; parents_[place.first] != place.first; place.first = parents_[place.first])
      place.turned ^= turned_[place.first] != 0;
    // Everything on the way now hangs on the first member.
    for (bool turned = place.turned; parents_[i] != place.first && i != place.first;) {
      const int next = parents_[i];
      const bool own = turned_[i] != 0;
      parents_[i] = place.first;
      turned_[i] = turned;
      turned ^= own;
      i = next;
    }
    return place;
  }

  void join(const Link& link) {
    Place a = find(link.a), b = find(link.b);
    if (a.first == b.first) return;
    if (sizes_[a.first] < sizes_[b.first]) std::swap(a, b);
    parents_[b.first] = a.first;
    turned_[b.first] = a.turned ^ b.turned ^ link.opposite;
    sizes_[a.first] += sizes_[b.first];
  }

 private:
  std::vector<int> parents_, sizes_;
  std::vector<char> turned_;  ///< against the parent
};

}  // namespace

std::vector<int> orient_normals(const Points& positions, const PointNeighbors& neighbors,
                                Points& normals) {
  std::vector<Link> tree = links(positions, neighbors, normals);
  std::sort(tree.begin(), tree.end());
  TurnedSets sets(positions.rows());
  for (const Link& link : tree) sets.join(link);

  std::vector<int> parts, numbers(static_cast<std::size_t>(positions.rows()), -1);
  int count = 0;
  for (int i = 0; i < positions.rows(); ++i) {
    const auto [first, turned] = sets.find(i);
    if (turned) normals.row(i) *= -1;
    if (numbers[first] < 0) numbers[first] = count++;
    parts.push_back(numbers[first]);
  }
  turn_odd_normals(positions, neighbors, normals);
  return parts;
}

long turn_odd_normals(const Points& positions, const PointNeighbors& neighbors, Points& normals) {
  const Transport transport(positions, neighbors, normals);
  long turned = 0;
  std::vector<char> odd(static_cast<std::size_t>(positions.rows()));
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    parallel_chunks(positions.rows(), 512, [&](Index begin, Index end) {
      for (Index i = begin; i < end; ++i) {
        double votes = 0;
        for (int j : neighbors.of(i)) votes += transport.agreement(i, j);
        odd[i] = votes < 0;
      }
    });
    const auto count = std::count(odd.begin(), odd.end(), 1);
    for (Index i = 0; i < positions.rows(); ++i)
      if (odd[i]) normals.row(i) *= -1;
    turned += count;
    if (count == 0) break;
  }
  return turned;
}

}  // namespace supple
