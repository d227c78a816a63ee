#include "modeler/domain/surface_samples.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <tuple>

#include "solver/core/check.h"

namespace supple {

namespace {

struct Sample {
  Vec3 position;
  double area;
  int triangle, vertex;
};

/// One triangle's samples: one at the middle of each of its parts.
class TriangleSampler {
 public:
  TriangleSampler(const std::array<Vec3, 3>& corners, const Eigen::Vector3i& vertices, int triangle)
      : corners_(corners), vertices_(vertices), triangle_(triangle) {
    area_ = 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
  }

  /// Parts no wider than `width`.
  void append(double width, std::vector<Sample>& samples) const {
    if (!(area_ > 0)) return;
    const std::array<double, 3> edges = {edge(0), edge(1), edge(2)};  // each across from a corner
    const auto [shortest, longest] = std::minmax_element(edges.begin(), edges.end());
    const int pieces = std::max(1, static_cast<int>(std::ceil(*longest / width)));
    if (needle * *shortest < *longest)
      append_strips(static_cast<int>(shortest - edges.begin()), *shortest / width, pieces, samples);
    else
      append_grid(pieces, samples);
  }

 private:
  /// Of the longest edge and the shortest: such triangles are cut along their length.
  static constexpr double needle = 8;

  double edge(int corner) const {
    return (corners_[(corner + 2) % 3] - corners_[(corner + 1) % 3]).norm();
  }

  /// Parts between lines i, i+1 and j, j+1 of the grid: one upright, and one upside down.
  void append_grid(int pieces, std::vector<Sample>& samples) const {
    const double area = area_ / (double(pieces) * pieces);
    for (int i = 0; i < pieces; ++i)
      for (int j = 0; i + j < pieces; ++j) {
        samples.push_back(at((i + 1.0 / 3) / pieces, (j + 1.0 / 3) / pieces, area));
        if (i + j + 1 < pieces)
          samples.push_back(at((i + 2.0 / 3) / pieces, (j + 2.0 / 3) / pieces, area));
      }
  }

  /// Strips across, from the needle's tip on, each cut into parts; `base` long in their widths.
  void append_strips(int tip, double base, int strips, std::vector<Sample>& samples) const {
    for (int i = 0; i < strips; ++i) {
      const double begin = double(i) / strips, end = double(i + 1) / strips;
      const double share = end * end - begin * begin;
      const double along = 2 * (end * end * end - begin * begin * begin) / (3 * share);
      const int parts = std::max(1, static_cast<int>(std::ceil(along * base)));
      for (int j = 0; j < parts; ++j) {
        Vec3 weights;
        weights[tip] = 1 - along;
        weights[(tip + 1) % 3] = along * (1 - (j + 0.5) / parts);
        weights[(tip + 2) % 3] = along * (j + 0.5) / parts;
        samples.push_back(at(weights[1], weights[2], area_ * share / parts));
      }
    }
  }

  Sample at(double u, double v, double area) const {
    const Vec3 x = corners_[0] + u * (corners_[1] - corners_[0]) + v * (corners_[2] - corners_[0]);
    int nearest = 0;
    for (int k = 1; k < 3; ++k)
      if ((corners_[k] - x).squaredNorm() < (corners_[nearest] - x).squaredNorm()) nearest = k;
    return {x, area, triangle_, vertices_[nearest]};
  }

  std::array<Vec3, 3> corners_;
  Eigen::Vector3i vertices_;
  int triangle_;
  double area_;
};

/// A sample and the cell of a grid it lies in.
struct InCell {
  std::array<std::int64_t, 3> cell;
  int sample;

  bool operator<(const InCell& other) const {
    return std::tie(cell, sample) < std::tie(other.cell, other.sample);
  }
};

std::vector<InCell> sort_into_cells(const SurfaceSamples& samples, const std::vector<int>& chosen,
                                    double width) {
  Box box;
  for (int i : chosen) box.extend(samples.positions.row(i).transpose());
  std::vector<InCell> result;
  result.reserve(chosen.size());
  for (int i : chosen) {
    // Off the box's corner, so that no regular row of samples lies on the cells' faces.
    const Vec3 steps =
        (samples.positions.row(i).transpose() - box.lower) / width + Vec3(0.3137, 0.1271, 0.2213);
    InCell entry{{}, i};
    for (int axis = 0; axis < 3; ++axis)
      entry.cell[axis] = static_cast<std::int64_t>(std::floor(steps[axis]));
    result.push_back(entry);
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// The sample nearest to the centroid of [begin, end), and all their area.
std::pair<int, double> gather(const SurfaceSamples& samples, const InCell* begin,
                              const InCell* end) {
  double area = 0;
  Vec3 moment = Vec3::Zero();
  const Vec3 origin = samples.positions.row(begin->sample);
  for (const InCell* entry = begin; entry != end; ++entry) {
    area += samples.areas[entry->sample];
    moment +=
        samples.areas[entry->sample] * (samples.positions.row(entry->sample).transpose() - origin);
  }
  const Vec3 centroid = origin + moment / area;
  const auto distance2 = [&](const InCell* entry) {
    return (samples.positions.row(entry->sample).transpose() - centroid).squaredNorm();
  };
  // The first of those that are as near but for rounding: the choice must not depend on units.
  const InCell* nearest = begin;
  for (const InCell* entry = begin + 1; entry != end; ++entry)
    if (distance2(entry) < (1 - 1e-6) * distance2(nearest)) nearest = entry;
  return {nearest->sample, area};
}

}  // namespace

SurfaceSamples sample_surface(const Points& positions, const Triangles& triangles,
                              double max_width) {
  SUPPLE_CHECK(max_width > 0, "the samples' width must be positive");
  std::vector<Sample> samples;
  for (Index t = 0; t < triangles.rows(); ++t) {
    const auto corner = [&](int k) -> Vec3 { return positions.row(triangles(t, k)); };
    const TriangleSampler sampler({corner(0), corner(1), corner(2)}, triangles.row(t),
                                  static_cast<int>(t));
    sampler.append(max_width, samples);
  }
  const Index count = static_cast<Index>(samples.size());
  SurfaceSamples result{Points(count, 3), Eigen::VectorXd(count), {}, {}};
  for (Index i = 0; i < count; ++i) {
    result.positions.row(i) = samples[i].position.transpose();
    result.areas[i] = samples[i].area;
    result.triangles.push_back(samples[i].triangle);
    result.vertices.push_back(samples[i].vertex);
  }
  return result;
}

SurfaceSamples vertex_samples(const Points& positions, const Triangles& triangles) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(positions.rows());
  std::vector<int> owners(static_cast<std::size_t>(positions.rows()), -1);
  for (Index t = 0; t < triangles.rows(); ++t) {
    const Vec3 a = positions.row(triangles(t, 0)), b = positions.row(triangles(t, 1)),
               c = positions.row(triangles(t, 2));
    for (const int vertex : triangles.row(t)) {
      areas[vertex] += (b - a).cross(c - a).norm() / 6;
      owners[static_cast<std::size_t>(vertex)] = static_cast<int>(t);
    }
  }
  SurfaceSamples result;
  for (Index i = 0; i < positions.rows(); ++i)
    if (areas[i] > 0) result.vertices.push_back(static_cast<int>(i));
  result.positions = positions(result.vertices, Eigen::all);
  result.areas = areas(result.vertices);
  for (const int vertex : result.vertices)
    result.triangles.push_back(owners[static_cast<std::size_t>(vertex)]);
  return result;
}

SurfaceSamples point_samples(const Points& positions, const Eigen::VectorXd& areas) {
  SUPPLE_CHECK(areas.size() == positions.rows(), "each point needs an area");
  const auto count = static_cast<std::size_t>(positions.rows());
  SurfaceSamples result{positions, areas, std::vector<int>(count, -1), std::vector<int>(count)};
  std::iota(result.vertices.begin(), result.vertices.end(), 0);
  return result;
}

ThinnedSamples thin_samples(const SurfaceSamples& samples, const std::vector<int>& chosen,
                            double width) {
  SUPPLE_CHECK(width > 0, "the cells' width must be positive");
  const std::vector<InCell> entries = sort_into_cells(samples, chosen, width);
  ThinnedSamples result;
  std::vector<double> areas;
  for (std::size_t begin = 0, end = 0; begin < entries.size(); begin = end) {
    while (end < entries.size() && entries[end].cell == entries[begin].cell) ++end;
    const auto [sample, area] = gather(samples, &entries[begin], &entries[begin] + (end - begin));
    result.indices.push_back(sample);
    areas.push_back(area);
  }
  result.areas = Eigen::Map<const Eigen::VectorXd>(areas.data(), Index(areas.size()));
  return result;
}

}  // namespace supple
