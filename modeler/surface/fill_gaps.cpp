#include "modeler/surface/fill_gaps.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <vector>

#include "io/points/spacing.h"
#include "modeler/domain/point_neighbors.h"
#include "modeler/surface/deform_mesh.h"
#include "solver/core/check.h"
#include "solver/field/neighbors.h"

namespace supple {
namespace {

/// Neighbours whose normals are farther apart lie on two sides of something.
constexpr double least_cosine = 0.5;

/// A new point keeps this share of the largest distance without a gap from all points but the two
/// that it stands between.
constexpr double least_distance = 0.45;

/// Each halves what is left of the widest gap.
constexpr int most_rounds = 20;

/// Two neighbours and how far they have parted.
struct Gap {
  int a, b;
  double length;  ///< deformed [m]
};

class GapFiller {
 public:
  GapFiller(const Mesh& rest, const Mesh& deformed, const DeformPoints& deform,
            const FillGapsOptions& options)
      : deform_(deform),
        options_(options),
        cloud_{.rest = rest, .deformed = deformed},
        spacing_(neighbor_spacing(rest.positions)),
        most_points_(
            static_cast<Index>(options.most_growth * static_cast<double>(rest.positions.rows()))) {}

  FilledCloud fill() {
    const Index before = cloud_.rest.positions.rows();
    for (int round = 0;; ++round) {
      std::vector<Gap> gaps = choose(find_gaps());
      const auto room = round == most_rounds
                            ? 0
                            : static_cast<std::size_t>(most_points_ - cloud_.rest.positions.rows());
      if (gaps.size() > room) {
        cloud_.gaps = static_cast<long>(gaps.size() - room);
        gaps.resize(room);
      }
      if (gaps.empty()) break;
      insert(gaps);
    }
    cloud_.added = cloud_.rest.positions.rows() - before;
    if (cloud_.added > 0) limit_radii();
    return std::move(cloud_);
  }

 private:
  Vec3 rest(int i) const { return cloud_.rest.positions.row(i).transpose(); }
  Vec3 deformed(int i) const { return cloud_.deformed.positions.row(i).transpose(); }

  static Vec3 normal(const Mesh& cloud, int i) {
    if (cloud.normals.empty()) return Vec3::Zero();
    return cloud.normals.values.row(i).transpose();
  }

  /// True where nothing says that the points lie on two sides of something.
  bool same_side(int a, int b) const {
    const Vec3 m = normal(cloud_.rest, a), n = normal(cloud_.rest, b);
    return m.isZero(0) || n.isZero(0) || m.dot(n) > least_cosine * m.norm() * n.norm();
  }

  double spacing(int a, int b) const { return 0.5 * (spacing_[a] + spacing_[b]); }

  /// Longest first.
  std::vector<Gap> find_gaps() const {
    std::vector<Gap> gaps;
    const PointNeighbors neighbors(cloud_.rest.positions, options_.neighbors);
    for (int a = 0; a < static_cast<int>(neighbors.size()); ++a)
      for (const int b : neighbors.of(a)) {
        const std::span<const int> back = neighbors.of(b);
        const bool mutual = std::find(back.begin(), back.end(), a) != back.end();
        if ((mutual && b < a) || !same_side(a, b)) continue;
        const double length = (deformed(b) - deformed(a)).norm();
        const double usual = std::max((rest(b) - rest(a)).norm(), spacing(a, b));
        if (length > options_.stretch * usual) gaps.push_back({a, b, length});
      }
    std::sort(gaps.begin(), gaps.end(), [](const Gap& g, const Gap& h) {
      return std::tie(h.length, g.a, g.b) < std::tie(g.length, h.a, h.b);
    });
    return gaps;
  }

  /// Those whose middles crowd neither a point nor one another.
  std::vector<Gap> choose(const std::vector<Gap>& gaps) const {
    if (gaps.empty()) return {};
    Points middles(static_cast<Index>(gaps.size()), 3);
    Eigen::VectorXd reaches(middles.rows());
    for (std::size_t k = 0; k < gaps.size(); ++k) {
      const auto& [a, b, length] = gaps[k];
      middles.row(static_cast<Index>(k)) = middle(cloud_.deformed, a, b).transpose();
      reaches[static_cast<Index>(k)] = least_distance * options_.stretch * spacing(a, b);
    }
    const Neighbors<3> among_middles(middles, reaches);
    const Neighbors<3> among_points(cloud_.deformed.positions,
                                    least_distance * options_.stretch * spacing_);
    std::vector<bool> taken(gaps.size(), false);
    std::vector<Gap> chosen;
    std::vector<int> near;
    for (std::size_t k = 0; k < gaps.size(); ++k) {
      const Vec3 x = middles.row(static_cast<Index>(k)).transpose();
      among_points.reaching(x, near);
      const bool crowds_point = std::any_of(near.begin(), near.end(), [&](int i) {
        return i != gaps[k].a && i != gaps[k].b && same_side(gaps[k].a, i);
      });
      if (crowds_point) continue;
      among_middles.reaching(x, near);
      const bool crowds_middle = std::any_of(near.begin(), near.end(), [&](int i) {
        const auto other = static_cast<std::size_t>(i);
        return taken[other] && same_side(gaps[k].a, gaps[other].a);
      });
      if (crowds_middle) continue;
      taken[k] = true;
      chosen.push_back(gaps[k]);
    }
    return chosen;
  }

  /// Halfway between two points, on the cubic that is perpendicular to their normals (Vlachos et
  /// al. 2001, "Curved PN triangles").
  static Vec3 middle(const Mesh& cloud, int a, int b) {
    const Vec3 x = cloud.positions.row(a).transpose(), y = cloud.positions.row(b).transpose();
    const Vec3 m = normal(cloud, a), n = normal(cloud, b);
    const auto towards = [&](const Vec3& normal) {
      return normal.isZero(0) ? Vec3(Vec3::Zero())
                              : Vec3(normal.dot(y - x) / normal.squaredNorm() * normal);
    };
    return 0.5 * (x + y) + 0.125 * (towards(n) - towards(m));
  }

  /// Adds points to the cloud at rest and to the deformed one.
  void insert(const std::vector<Gap>& gaps) {
    Mesh added;
    const auto count = static_cast<Index>(gaps.size());
    added.positions.resize(count, 3);
    Eigen::VectorXd added_spacing(count);
    for (Index k = 0; k < count; ++k) {
      const auto& [a, b, length] = gaps[static_cast<std::size_t>(k)];
      added.positions.row(k) = middle(cloud_.rest, a, b).transpose();
      added_spacing[k] = spacing(a, b);
    }
    added.normals.values = means(cloud_.rest.normals.values, gaps);
    for (Index k = 0; k < added.normals.values.rows(); ++k)
      added.normals.values.row(k) = added.normals.values.row(k).normalized();  // zeros stay
    added.colors.values = means(cloud_.rest.colors.values, gaps);
    added.radii = means(cloud_.rest.radii, gaps);
    const Mesh carried = deform_mesh(added, deform_(added.positions));
    append(added, cloud_.rest);
    append(carried, cloud_.deformed);
    append(added_spacing, spacing_);
  }

  /// Of the values at both ends of each gap; none where there are none.
  template <class Values>
  static Values means(const Values& values, const std::vector<Gap>& gaps) {
    Values result(values.rows() == 0 ? 0 : static_cast<Index>(gaps.size()), values.cols());
    for (Index k = 0; k < result.rows(); ++k) {
      const auto& [a, b, length] = gaps[static_cast<std::size_t>(k)];
      result.row(k) = 0.5 * (values.row(a) + values.row(b));
    }
    return result;
  }

  template <class Values>
  static void append(const Values& more, Values& values) {
    const Index before = values.rows();
    values.conservativeResize(before + more.rows(), values.cols());
    values.bottomRows(more.rows()) = more;
  }

  static void append(const Mesh& more, Mesh& cloud) {
    append(more.positions, cloud.positions);
    append(more.normals.values, cloud.normals.values);
    append(more.colors.values, cloud.colors.values);
    append(more.radii, cloud.radii);
  }

  void limit_radii() {
    cloud_.deformed.radii =
        cloud_.deformed.radii.cwiseMin(options_.stretch * cloud_.rest.radii).eval();
  }

  const DeformPoints& deform_;
  const FillGapsOptions& options_;
  FilledCloud cloud_;
  Eigen::VectorXd spacing_;  ///< usual distance of neighbours at rest [m]
  Index most_points_;
};

}  // namespace

FilledCloud fill_gaps(const Mesh& rest, const Mesh& deformed, const DeformPoints& deform,
                      const FillGapsOptions& options) {
  SUPPLE_CHECK(rest.face_count() == 0, "only point clouds have gaps between points");
  if (rest.positions.rows() < 2) return {.rest = rest, .deformed = deformed};
  return GapFiller(rest, deformed, deform, options).fill();
}

}  // namespace supple
