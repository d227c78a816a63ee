#include "modeler/domain/octree_particles.h"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io/mesh/mesh_files.h"
#include "modeler/domain/shape_error.h"
#include "solver/core/parallel.h"
#include "solver/core/random.h"
#include "solver/field/kernel.h"
#include "solver/field/moving_least_squares.h"
#include "tests/support/region_shapes.h"

namespace supple {
namespace {

Particles place(const Region& region, int count, KernelKind kernel = KernelKind::polynomial) {
  OctreeParticleOptions options;
  options.count = count;
  options.kernel = kernel;
  return octree_particles(region, options);
}

Particles place_by_spacing(const Region& region, double spacing, KernelKind kernel) {
  OctreeParticleOptions options;
  options.spacing = spacing;
  options.kernel = kernel;
  return octree_particles(region, options);
}

void expect_particles(const Region& region, const Particles& particles) {
  ASSERT_GT(particles.size(), 0);
  EXPECT_NEAR(particles.volumes.sum() / region.volume(), 1, 1e-12);
  EXPECT_GT(particles.volumes.minCoeff(), 0);
  EXPECT_LT(particles.volumes.maxCoeff(), 2.5 * std::pow(particles.spacing, 3));
  for (Index i = 0; i < particles.size(); ++i) {
    const Vec3 x = particles.positions.row(i);
    EXPECT_TRUE(region.contains(x));
    for (Index j = 0; j < i; ++j) {
      const Vec3 y = particles.positions.row(j);
      if ((x - y).norm() < 0.3 * particles.spacing * (1 - 1e-9)) {
        EXPECT_FALSE(connects(region, x, y));
      }
    }
  }
}

TEST(OctreeParticles, LieInsideApartAndShareTheVolume) {
  for (const Mesh& mesh : {make_bar({1, 1.3, 0.7}, {1, 1, 1}), make_icosphere(1, 3),
                           make_torus(1, 0.3, 48, 24), make_dumbbell(0.1), make_l_shape()}) {
    const auto region = region_of(mesh);
    for (int count : {1, 30, 200}) {
      SCOPED_TRACE(count);
      expect_particles(region, place(region, count));
    }
  }
}

TEST(OctreeParticles, ComeNearToTheCount) {
  for (const Mesh& mesh : {make_icosphere(1, 3), make_torus(1, 0.3, 48, 24), make_dumbbell(0.1)}) {
    const auto region = region_of(mesh);
    for (int count : {60, 200})
      EXPECT_NEAR(static_cast<double>(place(region, count).size()), count, 0.15 * count);
  }
}

TEST(OctreeParticles, SpacingIsTheLeavesWidth) {
  const auto region = region_of(make_bar({1, 1, 2}, {1, 1, 1}));
  const Particles particles = place_by_spacing(region, 0.125, KernelKind::box);
  EXPECT_EQ(particles.size(), 8 * 8 * 16);
  EXPECT_EQ(particles.spacing, 0.125);
  EXPECT_NEAR(particles.volumes.minCoeff(), std::pow(0.125, 3), 1e-12);
  EXPECT_NEAR(particles.supports.maxCoeff(), 1.6 * 0.125, 1e-15);
}

TEST(OctreeParticles, AFaceThroughLeavesCentresHasNodes) {
  // Whether these centres count as inside must not matter.
  const auto narrow = [](const Vec3& x) -> Vec3 { return {x[0] == 1 ? 0.9 : x[0], x[1], x[2]}; };
  const auto region = region_of(mapped(make_l_shape(), narrow));
  const Particles particles = place_by_spacing(region, 0.2, KernelKind::box);
  expect_particles(region, particles);
  const auto at_face = (particles.positions.col(0).array() - 0.9).abs() < 0.01;
  const auto above = particles.positions.col(1).array() > 1;
  EXPECT_EQ((at_face && above).count(), 10 * 5);
}

/// Condition of the linear basis's moment matrix Σ w p pᵀ at x, in units of the leaves' width.
double moment_condition(const Particles& particles, const Vec3& x, KernelKind kernel) {
  Eigen::Matrix4d moments = Eigen::Matrix4d::Zero();
  for (Index i = 0; i < particles.size(); ++i) {
    const Vec3 offset = x - particles.positions.row(i).transpose();
    const double w = kernel_weight<3, 0>(kernel, offset, Support<3>{particles.supports[i]}).c[0];
    Eigen::Vector4d p;
    p << 1, offset / particles.spacing;
    moments += w * p * p.transpose();
  }
  const Eigen::Vector4d values =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(moments).eigenvalues();
  return values[3] / values[0];
}

TEST(OctreeParticles, CubesThatFillTheShapeGiveFullRankUpToItsCorners) {
  const auto region = region_of(make_bar({1, 1, 1}, {1, 1, 1}));
  for (const KernelKind kernel : {KernelKind::box, KernelKind::polynomial, KernelKind::wendland}) {
    SCOPED_TRACE(enum_name(kernel));
    const Particles particles = place_by_spacing(region, 0.125, kernel);
    ASSERT_EQ(particles.size(), 512);
    const MovingLeastSquares<3> field(particles.positions, particles.supports,
                                      {BasisOrder::linear, kernel});
    ShapeFunctions<3> at_x;
    for (double x : {0.0, 0.001, 0.0625, 0.125, 0.4, 1.0})
      for (double y : {0.0, 0.125, 0.3, 1.0})
        for (double z : {0.0, 0.01, 0.5, 1.0}) {
          field.evaluate({x, y, z}, Derivatives::none, at_x);
          EXPECT_EQ(at_x.rank, 4) << x << " " << y << " " << z;
          EXPECT_LE(moment_condition(particles, {x, y, z}, kernel), 460);
        }
    std::printf("%s: condition at the corner %.1f\n", std::string(enum_name(kernel)).c_str(),
                moment_condition(particles, {0, 0, 0}, kernel));
  }
}

TEST(OctreeParticles, GradedTreesGiveWiderSupportsInside) {
  const auto region = region_of(make_icosphere(1, 3));
  OctreeOptions tree;
  tree.width = 0.1;
  tree.coarser_inside = 2;
  OctreeParticleOptions options;
  options.kernel = KernelKind::box;
  const Particles particles = particles_in_leaves(region, {region, tree}, options);
  EXPECT_NEAR(particles.supports.minCoeff(), 0.16, 1e-12);
  EXPECT_NEAR(particles.supports.maxCoeff(), 0.64, 1e-12);
  EXPECT_NEAR(particles.volumes.sum(), region.volume(), 1e-12);
  const MovingLeastSquares<3> field(particles.positions, particles.supports,
                                    {BasisOrder::linear, KernelKind::box});
  ShapeFunctions<3> at_x;
  Random random(11);
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 x = random.in_cube(-1, 1);
    if (!region.contains(x)) continue;
    field.evaluate(x, Derivatives::none, at_x);
    EXPECT_EQ(at_x.rank, 4) << x.transpose();
  }
}

TEST(OctreeParticles, SameForEveryNumberOfThreads) {
  const auto region = region_of(make_torus(1, 0.3, 48, 24));
  const auto particles = [&](int threads) {
    const ThreadLimit limit(threads);
    return place(region, 150);
  };
  const Particles one = particles(1), two = particles(2);
  EXPECT_EQ(one.positions, two.positions);
  EXPECT_EQ(one.volumes, two.volumes);
}

TEST(OctreeParticles, TooSmallASpacingIsRefusedAtOnce) {
  const auto region = region_of(make_bar({1, 1, 1}, {1, 1, 1}));
  EXPECT_THROW(place_by_spacing(region, 1e-7, KernelKind::box), ShapeError);
}

TEST(OctreeParticles, RealMeshes) {
  const std::filesystem::path data = std::filesystem::path(SUPPLE_SHARED_DATA) / "data";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "skipped: no shared data";
  for (const char* name : {"armadillo_1k.off", "stanford_bunny_3k.obj", "camel_10k.off"}) {
    SCOPED_TRACE(name);
    const auto region = region_of(as_fans(read_mesh(data / name)));
    const Particles particles = place(region, 200);
    EXPECT_NEAR(static_cast<double>(particles.size()), 200, 20);
    expect_particles(region, particles);
  }
}

}  // namespace
}  // namespace supple
