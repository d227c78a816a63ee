#include "modeler/domain/partition_of_unity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "modeler/domain/site_tree.h"
#include "solver/core/parallel.h"

namespace supple {

namespace {

/// Radius of a cell's ball over its diagonal. A half covers the cell; the balls of a cell's halves
/// lie within its own up to any value above that.
constexpr double ball_over_diagonal = 0.7;

/// Cells live on while points lie within this many of their half widths: quadrics are to follow
/// points, not to guess far from them.
constexpr double cube_share = 1.2;

/// A cell that borrows points is no larger than this many reaches of theirs.
constexpr double most_reaches = 2;

constexpr std::size_t least_points = 16;  // for a quadric
constexpr double enough_neighbors = 0.7;  // of the cloud's, for a quadric
constexpr std::size_t many_points = 400;  // cells of more are halved unseen
constexpr std::size_t few_shares = 5;     // cells of this part of enough points are never halved
constexpr int most_levels = 16;

constexpr double oppose = -0.2;    // cosine of normals on the two sides of a thin part
constexpr double far = 3;          // tolerances
constexpr double most_far = 0.02;  // share of the points beyond
constexpr double noise_slack = 1.1;
constexpr Index asked_points = 300;

}  // namespace

/// A cell while the tree grows.
struct PartitionOfUnity::Growing {
  Vec3 center;
  double half_width;
  std::vector<int> points;  ///< in its ball

  double radius() const { return ball_over_diagonal * 2 * std::sqrt(3.0) * half_width; }
};

class PartitionOfUnity::Builder {
 public:
  Builder(const Points& positions, const Points& normals, const PartitionOptions& options)
      : positions_(positions),
        normals_(normals),
        tree_(positions),
        tolerance_(options.tolerance),
        enough_points_(std::max(least_points,
                                static_cast<std::size_t>(enough_neighbors * options.neighbors))) {}

  /// Median over some points of how far their neighbours lie from a quadric.
  double noise() const {
    const Index step = std::max<Index>(1, positions_.rows() / asked_points);
    std::vector<double> offs;
    for (Index i = 0; i < positions_.rows(); i += step)
      offs.push_back(nearest_fit(positions_.row(i), 0).fit.rms);
    const auto middle = offs.begin() + static_cast<std::ptrdiff_t>(offs.size() / 2);
    std::nth_element(offs.begin(), middle, offs.end());
    return *middle;
  }

  void grow(PartitionOfUnity& result) {
    tolerance_ = std::max(tolerance_, noise_slack * result.noise_);
    std::vector<Growing> level = {root()};
    result.nodes_ = {node_of(level[0])};
    for (std::size_t first = 0; !level.empty(); ++depth_) {
      std::vector<Outcome> outcomes(level.size());
      parallel_chunks(static_cast<Index>(level.size()), 16, [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) outcomes[i] = look_at(level[i]);
      });
      std::vector<Growing> next;
      const std::size_t below = first + level.size();
      for (std::size_t i = 0; i < level.size(); ++i) {
        Node& node = result.nodes_[first + i];
        if (outcomes[i].quadric) {
          node.quadric = static_cast<int>(result.quadrics_.size());
          result.quadrics_.push_back(*outcomes[i].quadric);
        }
        node.first = static_cast<int>(below + next.size());
        node.children = static_cast<int>(outcomes[i].halves.size());
        for (Growing& half : outcomes[i].halves) next.push_back(std::move(half));
      }
      for (const Growing& cell : next) result.nodes_.push_back(node_of(cell));
      level = std::move(next);
      first = below;
    }
  }

 private:
  /// A leaf's quadric, or the halves that hold points: none where all lie at the ball's rim.
  struct Outcome {
    std::optional<Quadric> quadric;
    std::vector<Growing> halves;
  };

  static Node node_of(const Growing& cell) { return {cell.center, cell.radius() * cell.radius()}; }

  Growing root() const {
    const Box box = bounding_box(positions_);
    Growing cell{box.center(), 0.55 * box.size().maxCoeff(), {}};
    for (int i = 0; i < positions_.rows(); ++i) cell.points.push_back(i);
    return cell;
  }

  Outcome look_at(const Growing& cell) const {
    const std::size_t count = cell.points.size();
    const bool last = depth_ >= most_levels || count <= enough_points_ / few_shares;
    if (!last && count > many_points) return {{}, halves(cell)};
    const bool two_sided = opposing(cell);
    if (!two_sided && count >= enough_points_) {
      const QuadricFit fit = fit_quadric(positions_, normals_, cell.points, cell.center,
                                         cell.radius(), far * tolerance_);
      if (last || (fit.rms <= tolerance_ && fit.beyond <= most_far)) return {fit.quadric, {}};
      return {{}, halves(cell)};
    }
    if (two_sided && !last) return {{}, halves(cell)};
    const NearestFit nearest = nearest_fit(cell.center, cell.radius());
    if (depth_ < most_levels && cell.radius() > most_reaches * nearest.reach)
      return {{}, halves(cell)};
    return {nearest.fit.quadric, {}};
  }

  std::vector<Growing> halves(const Growing& cell) const {
    std::vector<Growing> result;
    for (int octant = 0; octant < 8; ++octant) {
      Growing half{cell.center, 0.5 * cell.half_width, {}};
      for (int axis = 0; axis < 3; ++axis)
        half.center[axis] += (octant >> axis & 1 ? 1 : -1) * half.half_width;
      const double squared_radius = half.radius() * half.radius();
      double nearest = std::numeric_limits<double>::infinity();
      for (int i : cell.points) {
        const Vec3 way = positions_.row(i).transpose() - half.center;
        if (way.squaredNorm() >= squared_radius) continue;
        half.points.push_back(i);
        nearest = std::min(nearest, way.lpNorm<Eigen::Infinity>());
      }
      if (nearest <= cube_share * half.half_width) result.push_back(std::move(half));
    }
    return result;
  }

  /// True where some normals look against that of the point nearest to the centre.
  bool opposing(const Growing& cell) const {
    const auto nearer = [&](int a, int b) {
      return (positions_.row(a).transpose() - cell.center).squaredNorm() <
             (positions_.row(b).transpose() - cell.center).squaredNorm();
    };
    const int nearest = *std::min_element(cell.points.begin(), cell.points.end(), nearer);
    const auto against = std::count_if(cell.points.begin(), cell.points.end(), [&](int i) {
      return normals_.row(i).dot(normals_.row(nearest)) < oppose;
    });
    return static_cast<double>(against) > most_far * static_cast<double>(cell.points.size());
  }

  /// By the points nearest to x whose normals agree with the nearest one's.
  struct NearestFit {
    QuadricFit fit;
    double reach;  ///< distance from x to the farthest of the points [m]
  };
  NearestFit nearest_fit(const Vec3& x, double least_radius) const {
    std::vector<Index> sites(2 * enough_points_);
    std::vector<double> squared_distances(sites.size());
    const int found = tree_.nearest(x, sites, squared_distances);
    std::vector<int> chosen;
    double squared_reach = 0;
    for (int k = 0; k < found && chosen.size() < enough_points_ + 4; ++k) {
      if (normals_.row(sites[k]).dot(normals_.row(sites[0])) < oppose) continue;
      chosen.push_back(static_cast<int>(sites[k]));
      squared_reach = squared_distances[k];
    }
    const double reach = std::sqrt(squared_reach);
    const double radius = std::max(least_radius, 1.1 * reach + 1e-300);
    return {fit_quadric(positions_, normals_, chosen, x, radius, far * tolerance_), reach};
  }

  const Points& positions_;
  const Points& normals_;
  SiteTree tree_;
  double tolerance_;
  std::size_t enough_points_;
  int depth_ = 0;
};

PartitionOfUnity::PartitionOfUnity(const Points& positions, const Points& normals,
                                   const PartitionOptions& options) {
  Builder builder(positions, normals, options);
  noise_ = builder.noise();
  builder.grow(*this);
}

PartitionOfUnity::Value PartitionOfUnity::at(const Vec3& x) const {
  double weights = 0, values = 0;
  Vec3 weight_slopes = Vec3::Zero(), value_slopes = Vec3::Zero();
  std::array<int, 8 * most_levels> stack;
  int size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    const Vec3 d = x - node.center;
    const double share = d.squaredNorm() / node.squared_radius;
    if (share >= 1) continue;
    for (int child = 0; child < node.children; ++child) stack[size++] = node.first + child;
    if (node.quadric < 0) continue;
    // w = (1 − r²/R²)²
    const Quadric& quadric = quadrics_[node.quadric];
    const double w = (1 - share) * (1 - share);
    const Vec3 w_slope = -4 * (1 - share) / node.squared_radius * d;
    const double q = quadric.value(x);
    weights += w;
    values += w * q;
    weight_slopes += w_slope;
    value_slopes += q * w_slope + w * quadric.gradient(x);
  }
  if (!(weights > 0)) return {};
  const double f = values / weights;
  return {weights, f, (value_slopes - f * weight_slopes) / weights};
}

}  // namespace supple
