#include "modeler/domain/sample_particles.h"

#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "io/mesh/mesh_files.h"
#include "modeler/domain/mesh_region.h"
#include "modeler/domain/shape_error.h"
#include "solver/core/parallel.h"
#include "solver/core/random.h"
#include "tests/support/region_shapes.h"

namespace supple {
namespace {

ParticleSampling sample(const Region& region, int count) {
  ParticleSamplingOptions options;
  options.count = count;
  return sample_particles(region, options);
}

double closest_pair(const Points& points) {
  double least = std::numeric_limits<double>::infinity();
  for (Index i = 0; i < points.rows(); ++i)
    for (Index j = 0; j < i; ++j) least = std::min(least, (points.row(i) - points.row(j)).norm());
  return least;
}

/// Greatest distance of random inside points to the particles.
double random_cover(const Region& region, const Points& particles, int trials) {
  Random random(99);
  const Box box = region.bounds();
  double cover = 0;
  for (int i = 0; i < trials; ++i) {
    const Vec3 x = box.lower + random.in_cube(0, 1).cwiseProduct(box.size());
    const double d2 = (particles.rowwise() - x.transpose()).rowwise().squaredNorm().minCoeff();
    if (d2 > cover * cover && region.contains(x)) cover = std::sqrt(d2);
  }
  return cover;
}

/// Everything the header promises.
void expect_contract(const Region& region, const ParticleSampling& sampling, int trials) {
  const Particles& p = sampling.particles;
  ASSERT_GT(p.size(), 0);
  const double s = p.spacing;
  EXPECT_GT(s, 0);
  EXPECT_GE(std::min(closest_pair(p.positions), 1e300), 0.7 * s * (1 - 1e-9));
  EXPECT_LE(sampling.covering_radius, 1.2 * s * (1 + 1e-9));
  EXPECT_LE(random_cover(region, p.positions, trials), sampling.covering_radius);
  EXPECT_NEAR(p.volumes.sum() / region.volume(), 1, 1e-12);
  EXPECT_GT(p.volumes.minCoeff(), 0);
  for (Index i = 0; i < p.size(); ++i) EXPECT_TRUE(region.contains(p.positions.row(i)));
}

struct Shape {
  const char* name;
  Mesh mesh;
};

std::vector<Shape> shapes() {
  return {{"box", make_bar({1, 1, 1}, {1, 1, 1})},
          {"plate", make_bar({100, 100, 1}, {4, 4, 1})},
          {"dumbbell", make_dumbbell(0.06)},
          {"l-shape", make_l_shape()},
          {"needle", make_bar({50, 0.1, 0.1}, {9, 1, 1})}};
}

TEST(SampleParticles, CountsAreExactAndSpacingHolds) {
  for (const Shape& shape : shapes()) {
    const MeshRegion region = region_of(shape.mesh);
    for (int count : {1, 8, 60, 200, 1000}) {
      SCOPED_TRACE(std::string(shape.name) + " " + std::to_string(count));
      const ParticleSampling sampling = sample(region, count);
      EXPECT_EQ(sampling.particles.size(), count);
      expect_contract(region, sampling, 5000);
    }
  }
}

TEST(SampleParticles, GivenSpacingHolds) {
  for (const Shape& shape : shapes()) {
    const MeshRegion region = region_of(shape.mesh);
    for (double share : {0.3, 0.08, 0.04}) {
      SCOPED_TRACE(std::string(shape.name) + " " + std::to_string(share));
      ParticleSamplingOptions options;
      options.spacing = share * region.bounds().diagonal();
      const ParticleSampling sampling = sample_particles(region, options);
      EXPECT_EQ(sampling.particles.spacing, options.spacing);
      expect_contract(region, sampling, 5000);
    }
  }
}

TEST(SampleParticles, SpacingOfABulkMeansItsCubeAParticle) {
  const MeshRegion region = region_of(make_bar({1, 1, 1}, {1, 1, 1}));
  ParticleSamplingOptions options;
  options.spacing = 0.1;
  const Index count = sample_particles(region, options).particles.size();
  EXPECT_GT(count, 750);
  EXPECT_LT(count, 1350);
}

TEST(SampleParticles, BoxIsEven) {
  const ParticleSampling sampling = sample(region_of(make_bar({1, 1, 1}, {1, 1, 1})), 200);
  const Particles& p = sampling.particles;
  EXPECT_NEAR(p.spacing, std::cbrt(1.0 / 200), 1e-12);
  EXPECT_GT(sampling.min_pair_distance, 0.7 * p.spacing);
  const double mean = p.volumes.mean();
  EXPECT_LT(std::sqrt((p.volumes.array() - mean).square().mean()), 0.25 * mean);
}

TEST(SampleParticles, ThinPartsGetTheirShareOfVolume) {
  const MeshRegion region = region_of(make_dumbbell(0.06));
  const Particles p = sample(region, 200).particles;
  double bar = 0;
  for (Index i = 0; i < p.size(); ++i)
    if (std::abs(p.positions(i, 2)) < 0.9) bar += p.volumes[i];
  EXPECT_NEAR(bar / (std::numbers::pi * 0.06 * 0.06 * 1.8), 1, 0.4);
}

TEST(SampleParticles, SameWithOneThreadAndTwo) {
  const MeshRegion region = region_of(make_torus(1, 0.4, 48, 24));
  Points one;
  {
    const ThreadLimit limit(1);
    one = sample(region, 60).particles.positions;
  }
  const ThreadLimit limit(2);
  EXPECT_EQ(one, sample(region, 60).particles.positions);
}

TEST(SampleParticles, IndependentOfUnitsAndOffset) {
  const Mesh torus = make_torus(1, 0.4, 48, 24);
  const Particles plain = sample(region_of(torus), 100).particles;
  for (double scale : {1e-3, 1.0, 1e3})
    for (double offset : {0.0, 1e4}) {
      const Vec3 shift = Vec3(1, 2, -1) * offset * scale;
      const auto map = [&](const Vec3& x) -> Vec3 { return scale * x + shift; };
      const Particles p = sample(region_of(mapped(torus, map)), 100).particles;
      ASSERT_EQ(p.size(), plain.size());
      const Points back = (p.positions.rowwise() - shift.transpose()) / scale;
      EXPECT_LT((back - plain.positions).cwiseAbs().maxCoeff(), 1e-7) << scale << " " << offset;
      EXPECT_NEAR(p.spacing / scale, plain.spacing, 1e-7);
    }
}

TEST(SampleParticles, EveryPartOfAShapeIsFilled) {
  const Mesh ball = make_icosphere(1, 2);
  const auto small = [](const Vec3& x) -> Vec3 { return 0.4 * x + Vec3(1.5, 0, 0); };
  const MeshRegion region = region_of(joined(ball, mapped(ball, small)));
  const Particles p = sample(region, 60).particles;
  const int right = static_cast<int>((p.positions.col(0).array() > 1.05).count());
  EXPECT_GE(right, 1);
  EXPECT_LT(right, 20);
}

TEST(SampleParticles, HollowShapeStaysHollow) {
  const MeshRegion region = region_of(joined(make_icosphere(1, 3), turned(make_icosphere(0.8, 3))));
  expect_contract(region, sample(region, 100), 20000);
}

TEST(SampleParticles, TooSmallASpacingIsRefusedAtOnce) {
  ParticleSamplingOptions options;
  options.spacing = 1e-7;
  EXPECT_THROW(sample_particles(region_of(make_bar({1, 1, 1}, {1, 1, 1})), options), ShapeError);
}

class SampleRealMeshes : public testing::TestWithParam<const char*> {};

TEST_P(SampleRealMeshes, ContractHolds) {
  const std::filesystem::path path =
      std::filesystem::path(SUPPLE_SHARED_DATA) / "data" / GetParam();
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "skipped: no shared data";
  const Mesh mesh = read_mesh(path);
  const MeshRegion region(mesh.positions, triangulate(mesh).triangles);
  for (int count : {60, 200, 1000}) {
    SCOPED_TRACE(count);
    const ParticleSampling sampling = sample(region, count);
    EXPECT_EQ(sampling.particles.size(), count);
    expect_contract(region, sampling, 20000);
  }
}

INSTANTIATE_TEST_SUITE_P(Shared, SampleRealMeshes,
                         testing::Values("armadillo_26k.off", "stanford_bunny_3k.obj",
                                         "camel_10k.off"));

}  // namespace
}  // namespace supple
