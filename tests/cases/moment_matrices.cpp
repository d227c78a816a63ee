#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "solver/field/samples.h"
#include "tests/cases/cases.h"
#include "tests/cases/clouds.h"
#include "tests/cases/posed_bar.h"
#include "tests/support/all_of.h"
#include "tests/support/lattice.h"

namespace supple {
namespace {

const std::vector<BasisOrder> orders = all_of<BasisOrder>();
const std::vector<KernelKind> kernels = all_of<KernelKind>();

/// A1's sums at `points`. Returns the rank, NaN where the points differ in it.
double measure_flat_cloud(const Field& field, const Points& points, Figures& figures) {
  int lowest = std::numeric_limits<int>::max(), highest = 0;
  for (Index k = 0; k < points.rows(); ++k) {
    const ShapeAtPoint shape(field, points.row(k).transpose());
    const auto phi = shape.rows.col(0);
    const Eigen::RowVector3d linear =
        phi.transpose() * (field.positions().rowwise() - points.row(k));
    keep_worst(figures["partition_of_unity"], shape.unity_error());
    keep_worst(figures["linear_reproduction"], linear.norm() / field.supports()[0]);
    keep_worst(figures["sum_of_absolutes"], phi.lpNorm<1>());
    figures["not_finite"] += shape.not_finite();
    lowest = std::min(lowest, shape.rank);
    highest = std::max(highest, shape.rank);
  }
  return lowest == highest ? lowest : std::numeric_limits<double>::quiet_NaN();
}

/// One neighbourhood of 60 random particles in a unit square, then on a unit line: all reach all.
void measure_flat_clouds(Figures& figures) {
  for (const int axes : {2, 1})
    for (const BasisOrder order : {BasisOrder::linear, BasisOrder::quadratic}) {
      const Field field = Cloud{random_points(60, axes, 1), 2}.field({order});
      figures[fmt::format("rank_{}_{}", axes == 2 ? "plane" : "line", enum_name(order))] =
          measure_flat_cloud(field, random_points(500, axes, 2), figures);
    }
}

/// One, two and three random particles that reach all of the unit cube.
void measure_few_neighbors(Figures& figures) {
  const Points points = random_points(100, 3, 2);
  double counted = 0, countable = 0;
  for (const Index count : {1, 2, 3})
    for (const BasisOrder order : orders)
      for (const KernelKind kernel : kernels) {
        const Field field = Cloud{random_points(count, 3, 1), 2}.field({order, kernel});
        for (Index k = 0; k < points.rows(); ++k) {
          const ShapeAtPoint shape(field, points.row(k).transpose());
          keep_worst(figures["partition_of_unity"], shape.unity_error());
          figures["not_finite"] += shape.not_finite();
          if (count > 1) continue;
          keep_worst(figures["one_neighbor_value"], std::abs(shape.rows(0, 0) - 1));
          keep_worst(figures["one_neighbor_slope"], shape.rows.middleCols<3>(1).norm());
        }
        if (order == BasisOrder::constant) continue;
        countable += static_cast<double>(points.rows());
        counted += static_cast<double>(
            sample_field(field, points, SampleContent::values_and_gradients).rank_lost);
      }
  figures["counted"] = counted / countable;
}

/// A jittered lattice in the unit cube, where every point sees some dozens of particles.
Cloud convex_body() {
  return {lattice_particles({1, 1, 1}, 1.0 / 6).positions, 0.5};
}

/// The same cloud in three sizes.
void measure_scales(Figures& figures) {
  const Cloud cloud = convex_body();
  const Points points = random_points(100, 3, 2);
  const auto keep_change = [&](const char* name, const auto& a, const auto& b) {
    keep_worst(figures[name], (a - b).cwiseAbs().maxCoeff() / a.cwiseAbs().maxCoeff());
  };
  for (const BasisOrder order : orders) {
    const Field field = cloud.field({order});
    for (const double scale : {1e-9, 1e9}) {
      const Field scaled = Cloud{scale * cloud.positions, scale * cloud.h}.field({order});
      for (Index k = 0; k < points.rows(); ++k) {
        const auto a = ShapeAtPoint(field, points.row(k).transpose()).rows;
        const auto b = ShapeAtPoint(scaled, scale * points.row(k).transpose()).rows;
        keep_change("values", a.leftCols<1>(), b.leftCols<1>());
        keep_change("gradients", a.middleCols<3>(1), b.middleCols<3>(1));
        keep_change("second_derivatives", a.rightCols<6>(), b.rightCols<6>());
      }
    }
  }
}

/// A way of `lengths` diagonals, by whole numbers: there and back is exact for the bar.
Eigen::RowVector3d whole_offset(double lengths, double diagonal) {
  return (lengths * diagonal * Eigen::RowVector3d(0.6, -0.5, 0.62)).array().round();
}

/// A cloud, and a bar bent by its handles, far from the origin.
void measure_offsets(Figures& figures) {
  const Cloud cloud = convex_body();
  const Points points = random_points(100, 3, 2);
  const Mesh bar = case_bar();
  const double L = diagonal_of(bar);
  const std::string handles = "    - fix: z<10%\n    - {move: z>90%, by: [20%, 10%, 0]}\n";
  const Points here = pose_with(bar, handles).mesh.positions;
  for (const auto& [name, lengths] : {std::pair{"1e3", 1e3}, {"1e6", 1e6}, {"1e7", 1e7}}) {
    for (const BasisOrder order : orders) {
      const Eigen::RowVector3d offset = whole_offset(lengths, std::sqrt(3.0));
      const Field field = Cloud{cloud.positions.rowwise() + offset, cloud.h}.field({order});
      for (Index k = 0; k < points.rows(); ++k)
        keep_worst(figures["partition_of_unity"],
                   ShapeAtPoint(field, (points.row(k) + offset).transpose()).unity_error());
    }
    const Eigen::RowVector3d offset = whole_offset(lengths, L);
    Mesh moved = bar;
    moved.positions.rowwise() += offset;
    const Points there = pose_with(moved, handles).mesh.positions;
    figures[fmt::format("pose_at_{}_L", name)] =
        greatest_distance(here, there.rowwise() - offset) / L;
  }
}

/// Central differences of φ, free of units.
Eigen::MatrixX3d slopes_by_differences(const Field& field, const Vec3& x) {
  constexpr double step = 1e-7;  // of h: short, since the box kernel's slope has kinks
  const double h = field.supports()[0];
  Eigen::MatrixX3d slopes(field.positions().rows(), 3);
  for (int k = 0; k < 3; ++k) {
    const Vec3 way = step * h * Vec3::Unit(k);
    slopes.col(k) =
        (ShapeAtPoint(field, x + way).rows.col(0) - ShapeAtPoint(field, x - way).rows.col(0)) /
        (2 * step);
  }
  return slopes;
}

void measure_gradients(Figures& figures) {
  const Cloud cloud = convex_body();
  const Points points = random_points(50, 3, 2);
  const Vec3 b(0.3, -1.1, 0.7);
  const Eigen::VectorXd affine = (cloud.positions * b).array() + 2;
  for (const BasisOrder order : orders)
    for (const KernelKind kernel : kernels) {
      const Field field = cloud.field({order, kernel});
      for (Index k = 0; k < points.rows(); ++k) {
        const Vec3 x = points.row(k).transpose();
        const Eigen::MatrixX3d slopes = ShapeAtPoint(field, x).rows.middleCols<3>(1);
        keep_worst(figures["constant_field"], slopes.colwise().sum().norm());
        keep_worst(figures["finite_differences"],
                   (slopes - slopes_by_differences(field, x)).rowwise().norm().maxCoeff());
        if (order == BasisOrder::constant) continue;
        const Vec3 gradient = slopes.transpose() * affine / cloud.h;
        keep_worst(figures["affine_field"], (gradient - b).norm() / b.norm());
      }
    }
  measure_concave_gradients(figures);
}

constexpr Case cases[] = {{"A1", measure_flat_clouds},
                          {"A2", measure_few_neighbors},
                          {"A10", measure_scales},
                          {"A11", measure_offsets},
                          {"A14", measure_gradients}};

}  // namespace

std::span<const Case> moment_matrix_cases() {
  return cases;
}

}  // namespace supple
