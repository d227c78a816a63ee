#include "modeler/domain/cell_quadrature.h"

#include <cmath>
#include <filesystem>
#include <functional>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io/mesh/mesh_files.h"
#include "solver/core/parallel.h"
#include "tests/support/region_shapes.h"

namespace supple {
namespace {

Quadrature quadrature_of(const Region& region, double width,
                         const CellQuadratureOptions& options = {}) {
  OctreeOptions cells;
  cells.width = width;
  return cell_quadrature(region, {region, cells}, options);
}

/// The edge of as many cubes as `count` of the region's volume.
double width_for(const Region& region, int count) {
  return std::cbrt(region.volume() / count);
}

/// ∫ x dV / V of closed triangles.
Vec3 centroid_of(const Points& positions, const Triangles& triangles) {
  Vec3 first = Vec3::Zero();
  double volume = 0;
  for (Index t = 0; t < triangles.rows(); ++t) {
    const Vec3 a = positions.row(triangles(t, 0)), b = positions.row(triangles(t, 1)),
               c = positions.row(triangles(t, 2));
    const double part = a.dot(b.cross(c)) / 6;
    volume += part;
    first += part * (a + b + c) / 4;
  }
  return first / volume;
}

double integral(const Quadrature& quadrature, const std::function<double(const Vec3&)>& f) {
  double sum = 0;
  for (Index k = 0; k < quadrature.points.rows(); ++k)
    sum += quadrature.volumes[k] * f(quadrature.points.row(k).transpose());
  return sum;
}

/// Errors in percent of the volume, and of the centroid in percent of the diagonal.
void expect_moments(const Region& region, const Quadrature& quadrature, const Vec3& centroid,
                    double percent) {
  const double volume = quadrature.volumes.sum();
  const Vec3 found = quadrature.points.transpose() * quadrature.volumes / volume;
  EXPECT_NEAR(100 * volume / region.volume(), 100, percent);
  EXPECT_LT(100 * (found - centroid).norm() / region.bounds().diagonal(), percent);
  EXPECT_GT(quadrature.volumes.minCoeff(), 0);
  for (Index k = 0; k < quadrature.points.rows(); ++k)
    EXPECT_TRUE(region.contains(quadrature.points.row(k)));
}

struct Shape {
  const char* name;
  Mesh mesh;
};

TEST(CellQuadrature, VolumeAndCentroidOfExactShapes) {
  const auto oblique = [](const Vec3& x) -> Vec3 {
    return Eigen::AngleAxisd(0.5, Vec3(1, 2, 3).normalized()) * x;
  };
  for (const Shape& shape :
       {Shape{"box", make_bar({1, 1.3, 0.7}, {1, 1, 1})},
        Shape{"oblique box", mapped(make_bar({1, 1.3, 0.7}, {1, 1, 1}), oblique)},
        Shape{"ball", make_icosphere(1, 4)}, Shape{"torus", make_torus(1, 0.3, 96, 48)},
        Shape{"l-shape", make_l_shape()}}) {
    const auto region = region_of(shape.mesh);
    const Vec3 centroid = centroid_of(shape.mesh.positions, triangles_of(shape.mesh));
    for (int cells : {60, 200}) {
      SCOPED_TRACE(fmt::format("{} {}", shape.name, cells));
      expect_moments(region, quadrature_of(region, width_for(region, cells)), centroid, 0.5);
    }
  }
}

TEST(CellQuadrature, PlatesThinnerThanACellCount) {
  // A plate of 0.4 cells, oblique to them all.
  const auto oblique = [](const Vec3& x) -> Vec3 {
    return Eigen::AngleAxisd(0.5, Vec3(1, 2, 3).normalized()) * (x - Vec3(2, 2, 0.1));
  };
  const auto region = region_of(mapped(make_bar({4, 4, 0.2}, {1, 1, 1}), oblique));
  expect_moments(region, quadrature_of(region, 0.5), Vec3::Zero(), 0.5);
}

/// ∫ z² dV of closed triangles.
double second_moment(const Points& positions, const Triangles& triangles) {
  double sum = 0;
  for (Index t = 0; t < triangles.rows(); ++t) {
    const Vec3 a = positions.row(triangles(t, 0)), b = positions.row(triangles(t, 1)),
               c = positions.row(triangles(t, 2));
    const double z = a[2] + b[2] + c[2];
    sum += a.dot(b.cross(c)) / 120 * (z * z + a[2] * a[2] + b[2] * b[2] + c[2] * c[2]);
  }
  return sum;
}

TEST(CellQuadrature, ErrorFallsWithTheSquareOfTheWidth) {
  const Mesh torus = make_torus(1, 0.3, 48, 24);
  const auto region = region_of(torus);
  const double exact = second_moment(torus.positions, triangles_of(torus));
  const auto error = [&](double width) {
    // Several positions of the grid, since single errors change sign.
    double sum = 0;
    for (double factor : {0.95, 1.0, 1.05}) {
      const Quadrature quadrature = quadrature_of(region, factor * width);
      sum += std::abs(integral(quadrature, [](const Vec3& x) { return x[2] * x[2]; }) / exact - 1);
    }
    return sum / 3;
  };
  const double coarse = error(0.3), fine = error(0.12);
  EXPECT_GT(std::log(coarse / fine) / std::log(2.5), 1.8);
  EXPECT_LT(fine, 0.01);
}

TEST(CellQuadrature, GaussPointsIntegratePolynomialsOfTheirDegree) {
  const auto region = region_of(make_bar({1, 1, 1}, {1, 1, 1}));
  for (int order : {1, 2, 3}) {
    CellQuadratureOptions options;
    options.order = order;
    const Quadrature quadrature = quadrature_of(region, 0.25, options);
    EXPECT_EQ(quadrature.points.rows(), 64 * order * order * order);
    const int degree = 2 * order - 1;
    const auto power = [&](int n) {
      return integral(quadrature, [&](const Vec3& x) { return std::pow(x[1], n); });
    };
    EXPECT_NEAR(power(degree), 1.0 / (degree + 1), 1e-12);
    EXPECT_GT(std::abs(power(degree + 1) - 1.0 / (degree + 2)), 1e-9);
  }
}

TEST(CellQuadrature, SameForEveryNumberOfThreads) {
  const auto region = region_of(make_torus(1, 0.3, 48, 24));
  const auto points = [&](int threads) {
    const ThreadLimit limit(threads);
    return quadrature_of(region, 0.2);
  };
  const Quadrature one = points(1), two = points(2);
  EXPECT_EQ(one.points, two.points);
  EXPECT_EQ(one.volumes, two.volumes);
}

class CellQuadratureOfRealMeshes : public testing::TestWithParam<const char*> {};

TEST_P(CellQuadratureOfRealMeshes, VolumeAndCentroid) {
  const std::filesystem::path path =
      std::filesystem::path(SUPPLE_SHARED_DATA) / "data" / GetParam();
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "skipped: no shared data";
  const Mesh mesh = read_mesh(path);
  const Triangles triangles = triangulate(mesh).triangles;
  const auto region = region_of(as_fans(mesh));
  const Vec3 centroid = centroid_of(mesh.positions, triangles);
  for (int cells : {60, 200}) {
    SCOPED_TRACE(cells);
    const Quadrature quadrature = quadrature_of(region, width_for(region, cells));
    std::printf("%s: %d cells, %ld points, volume %+.3f %%\n", GetParam(), cells,
                static_cast<long>(quadrature.points.rows()),
                100 * (quadrature.volumes.sum() / region.volume() - 1));
    expect_moments(region, quadrature, centroid, 0.5);
    EXPECT_LT(quadrature.points.rows(), 16 * cells);
  }
}

INSTANTIATE_TEST_SUITE_P(Shared, CellQuadratureOfRealMeshes,
                         testing::Values("armadillo_26k.off", "stanford_bunny_3k.obj",
                                         "camel_10k.off"));

}  // namespace
}  // namespace supple
