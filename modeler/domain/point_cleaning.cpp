#include "modeler/domain/point_cleaning.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "modeler/domain/point_neighbors.h"
#include "modeler/domain/principal_axes.h"
#include "solver/core/parallel.h"

namespace supple {

namespace {

constexpr double one_place = 1e-9;  // of the diagonal
constexpr double outermost = 0.02;  // share of the points at each end of an axis
constexpr int neighbor_count = 16;
constexpr int most_rounds = 6;  // what is alone shows only when its like are gone

constexpr double far_for_cloud = 2.0;     // medians of the cloud
constexpr double too_far_for_cloud = 12;  // the same
constexpr double far_for_place = 3.0;     // medians of the neighbours
constexpr double not_a_sheet = 0.06;      // share of the spread off the plane
constexpr double off_sheet = 5.0;         // deviations of the neighbours from their plane
constexpr double far_off_sheet = 0.5;     // distances to the farthest neighbour

double quantile(std::vector<double> values, double share) {
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// Without the outermost along each axis: a few far outliers must not tell how large the cloud is.
Box box_of_most(const Points& positions) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double> values(positions.col(axis).begin(), positions.col(axis).end());
    box.lower[axis] = quantile(values, outermost);
    box.upper[axis] = quantile(values, 1 - outermost);
  }
  return box;
}

/// The first point at each place, ascending.
std::vector<int> first_at_each_place(const Points& positions) {
  struct Place {
    std::array<std::int64_t, 3> cell;
    int point;
    auto operator<=>(const Place&) const = default;
  };
  const Box box = box_of_most(positions);
  const double width = std::max(one_place * box.diagonal(), 1e-300);
  std::vector<Place> places;
  places.reserve(static_cast<std::size_t>(positions.rows()));
  for (Index i = 0; i < positions.rows(); ++i) {
    Place place{{}, static_cast<int>(i)};
    for (int axis = 0; axis < 3; ++axis)
      place.cell[axis] =
          std::llround(std::clamp((positions(i, axis) - box.lower[axis]) / width, -9e18, 9e18));
    places.push_back(place);
  }
  std::sort(places.begin(), places.end());
  const auto same = [](const Place& a, const Place& b) { return a.cell == b.cell; };
  places.erase(std::unique(places.begin(), places.end(), same), places.end());
  std::vector<int> result;
  result.reserve(places.size());
  for (const Place& place : places) result.push_back(place.point);
  std::sort(result.begin(), result.end());
  return result;
}

/// How a point lies to its neighbours.
class Loneliness {
 public:
  explicit Loneliness(const Points& positions)
      : positions_(positions), neighbors_(positions, neighbor_count) {
    for (Index i = 0; i < positions.rows(); ++i)
      reaches_.push_back(std::sqrt(neighbors_.squared_distances(i).back()));
    usual_ = quantile(reaches_, 0.5);
  }

  bool alone(Index i) const { return far_away(i) || off_the_sheet(i); }

 private:
  bool far_away(Index i) const {
    if (reaches_[i] <= far_for_cloud * usual_) return false;
    if (reaches_[i] > too_far_for_cloud * usual_) return true;
    std::vector<double> around;
    for (int j : neighbors_.of(i)) around.push_back(reaches_[j]);
    return reaches_[i] > far_for_place * quantile(std::move(around), 0.5) ||
           principal_axes(positions_, i, neighbors_.of(i)).off_plane() > not_a_sheet;
  }

  /// Off the plane of its neighbours, which lie well within it.
  bool off_the_sheet(Index i) const {
    const std::span<const int> others = neighbors_.of(i);
    const PrincipalAxes plane = principal_axes(positions_, others[0], others.subspan(1));
    const auto height = [&](Index j) {
      return std::abs(plane.axes.col(0).dot(positions_.row(j).transpose() - plane.mean));
    };
    if (height(i) <= far_off_sheet * reaches_[i]) return false;
    std::vector<double> heights;
    for (int j : others) heights.push_back(height(j));
    return height(i) > off_sheet * quantile(std::move(heights), 0.5);
  }

  const Points& positions_;
  PointNeighbors neighbors_;
  std::vector<double> reaches_;  ///< distance to the farthest of the neighbours [m]
  double usual_;
};

/// One for each row of `positions`: true where the point lies alone.
std::vector<char> lonely(const Points& positions) {
  const Loneliness loneliness(positions);
  std::vector<char> alone(static_cast<std::size_t>(positions.rows()));
  parallel_chunks(positions.rows(), 512, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) alone[i] = loneliness.alone(i);
  });
  return alone;
}

}  // namespace

CleanPoints clean_points(const Points& positions) {
  CleanPoints result{first_at_each_place(positions), 0, 0};
  result.duplicates = positions.rows() - static_cast<long>(result.kept.size());
  for (int round = 0; round < most_rounds && result.kept.size() > neighbor_count; ++round) {
    const std::vector<char> alone = lonely(positions(result.kept, Eigen::all));
    std::vector<int> kept;
    for (std::size_t i = 0; i < alone.size(); ++i)
      if (!alone[i]) kept.push_back(result.kept[i]);
    const auto cut = static_cast<long>(result.kept.size() - kept.size());
    result.outliers += cut;
    result.kept = std::move(kept);
    if (cut == 0) break;
  }
  return result;
}

}  // namespace supple
