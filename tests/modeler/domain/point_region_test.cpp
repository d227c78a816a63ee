#include "modeler/domain/point_region.h"

#include <cmath>
#include <filesystem>
#include <numbers>

#include <gtest/gtest.h>

#include "io/mesh/mesh_files.h"
#include "modeler/domain/mesh_region.h"
#include "modeler/domain/shape_error.h"
#include "solver/core/parallel.h"
#include "tests/support/point_clouds.h"
#include "tests/support/region_shapes.h"

namespace supple {
namespace {

constexpr double pi = std::numbers::pi;

struct Torus {
  double major = 0.3, minor = 0.12;

  double distance(const Vec3& x) const {
    return std::hypot(std::hypot(x.x(), x.y()) - major, x.z()) - minor;
  }
  double volume() const { return 2 * pi * pi * major * minor * minor; }

  /// Points at random with the smooth torus's normals.
  PointCloud cloud(Index count) const {
    PointCloud cloud = points_on(make_torus(major, minor, 64, 32), count);
    for (Index i = 0; i < count; ++i) {
      const Vec3 x = cloud.positions.row(i);
      const Vec3 middle = major * Vec3(x.x(), x.y(), 0).normalized();
      const Vec3 normal = (x - middle).normalized();
      cloud.positions.row(i) = (middle + minor * normal).transpose();
      cloud.normals.row(i) = normal.transpose();
    }
    return cloud;
  }
};

std::string refusal(const Points& positions, const Points& normals = {}) {
  try {
    PointRegion region(positions, normals);
  } catch (const ShapeError& error) {
    return error.what();
  }
  return "";
}

bool has_note(const PointRegion& region, const std::string& words) {
  for (const std::string& note : region.reading().notes())
    if (note.find(words) != std::string::npos) return true;
  return false;
}

void expect_torus(const PointRegion& region) {
  const Torus torus;
  EXPECT_NEAR(region.volume() / torus.volume(), 1, 0.01);
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 x = random.in_cube(-0.5, 0.5);
    const double expected = torus.distance(x);
    EXPECT_NEAR(region.signed_distance(x), expected, 0.002);
    EXPECT_NEAR((region.closest_boundary_point(x) - x).norm(), std::abs(expected), 0.002);
    EXPECT_TRUE(std::abs(expected) < 0.002 || region.contains(x) == (expected < 0));
  }
}

TEST(PointRegion, TorusByPointsWithNormals) {
  const PointCloud cloud = Torus().cloud(4000);
  const PointRegion region(cloud.positions, cloud.normals);
  expect_torus(region);
  EXPECT_TRUE(region.reading().notes().empty());
  EXPECT_GT(region.reading().covered, 0.995);
  EXPECT_NEAR(region.reading().areas.sum() / (4 * pi * pi * 0.3 * 0.12), 1, 0.05);
}

TEST(PointRegion, TorusByPointsWithoutNormals) {
  const PointRegion region(Torus().cloud(4000).positions);
  expect_torus(region);
  EXPECT_TRUE(has_note(region, "orientation guessed"));
}

TEST(PointRegion, NormalsThatLookInwardsOrAreOddAreTurned) {
  PointCloud cloud = Torus().cloud(4000);
  cloud.normals *= -3;
  for (Index i = 0; i < 4000; i += 100) cloud.normals.row(i) *= -1;
  cloud.normals.row(7).setZero();
  const PointRegion region(cloud.positions, cloud.normals);
  expect_torus(region);
  EXPECT_TRUE(region.reading().turned);
  EXPECT_TRUE(has_note(region, "point inwards"));
  EXPECT_EQ(region.reading().odd_normals, 40);
  EXPECT_EQ(region.reading().without_normal, 1);
  EXPECT_EQ(region.reading().kept.size(), 3999);
}

TEST(PointRegion, GradientIsTheSlopeOfTheDistanceAndProjectionConverges) {
  const Torus torus;
  const PointCloud cloud = torus.cloud(4000);
  const PointRegion region(cloud.positions, cloud.normals);
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    Vec3 x = cloud.positions.row(7 * i).transpose() + 0.002 * random.in_cube(-1, 1);
    const Vec3 gradient = region.gradient(x);
    EXPECT_NEAR(gradient.norm(), 1, 0.05);
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 step = 1e-6 * Vec3::Unit(axis);
      const double slope =
          (region.signed_distance(x + step) - region.signed_distance(x - step)) / 2e-6;
      EXPECT_NEAR(gradient[axis], slope, 1e-5);
    }
    for (int step = 0; step < 4; ++step) {
      const Vec3 slope = region.gradient(x);
      x -= region.signed_distance(x) / slope.squaredNorm() * slope;
    }
    EXPECT_LT(std::abs(region.signed_distance(x)), 1e-10);
    EXPECT_LT(std::abs(torus.distance(x)), 5e-4);
  }
}

TEST(PointRegion, DistanceHasNoJumps) {
  const PointCloud cloud = Torus().cloud(2000);
  const PointRegion region(cloud.positions, cloud.normals);
  Random random(6);
  for (int way = 0; way < 40; ++way) {
    const Vec3 a = random.in_cube(-0.5, 0.5), b = random.in_cube(-0.5, 0.5);
    const int steps = 400;
    double last = region.signed_distance(a);
    for (int k = 1; k <= steps; ++k) {
      const double next = region.signed_distance(a + (b - a) * k / steps);
      EXPECT_LT(std::abs(next - last), 2 * (b - a).norm() / steps);
      last = next;
    }
  }
}

TEST(PointRegion, WaysAcrossTheHoleLeaveTheRegion) {
  const PointCloud cloud = Torus().cloud(4000);
  const PointRegion region(cloud.positions, cloud.normals);
  EXPECT_FALSE(connects(region, {0.3, 0, 0}, {-0.3, 0, 0}));
  EXPECT_TRUE(connects(region, {0.3, 0, 0}, {0.3 * std::cos(0.8), 0.3 * std::sin(0.8), 0}));
}

TEST(PointRegion, DoesNotDependOnTheNumberOfThreads) {
  const Points points = Torus().cloud(3000).positions;
  const auto build = [&](int threads) {
    const ThreadLimit limit(threads);
    return PointRegion(points).boundary().positions;
  };
  EXPECT_EQ(build(1), build(0));
}

TEST(PointRegion, CopiesAndOutliersAreLeftOut) {
  const Points clean = Torus().cloud(4000).positions;
  Points points = with_outliers(clean, 200);
  const Index first = points.rows();
  points.conservativeResize(first + 50, 3);
  points.bottomRows(50) = clean.topRows(50);
  const PointRegion region(points);
  EXPECT_NEAR(region.volume() / Torus().volume(), 1, 0.05);  // some outliers lie near the surface
  EXPECT_EQ(region.reading().duplicates, 50);
  EXPECT_GT(region.reading().outliers, 120);  // the others lie at the surface
  EXPECT_LE(region.reading().outliers, 200);
}

TEST(PointRegion, ThinPlateIsNotMendedAway) {
  const Mesh plate = of_unit_size(make_bar({1, 1, 0.02}, {1, 1, 1}));
  const PointCloud cloud = points_on(plate, 8000);
  const PointRegion region(cloud.positions, cloud.normals);
  const double volume = enclosed_volume(plate.positions, triangles_of(plate));
  EXPECT_NEAR(region.volume() / volume, 1, 0.05);
}

TEST(PointRegion, TooFewPointsAreRefusedWithWords) {
  const Points points = Torus().cloud(100).positions;
  for (Index count : {0, 1, 2, 3, 19})
    EXPECT_NE(refusal(points.topRows(count)).find("too few points"), std::string::npos) << count;
  EXPECT_NE(refusal(Points::Zero(1000, 3)).find("too few points: 1 at different places"),
            std::string::npos);
}

TEST(PointRegion, FlatCloudsAreRefusedWithWords) {
  Random random(8);
  Points plane(500, 3);
  for (Index i = 0; i < 500; ++i) plane.row(i) << random.uniform(), random.uniform(), 0.5;
  EXPECT_NE(refusal(plane).find("flat: they lie in one plane"), std::string::npos)
      << refusal(plane);
  plane.col(1).setZero();
  EXPECT_NE(refusal(plane).find("flat: they lie in one line"), std::string::npos) << refusal(plane);
}

TEST(PointRegion, NormalsOfAFewPointsAreNotTrusted) {
  const PointCloud cloud = Torus().cloud(4000);
  Points normals = Points::Zero(4000, 3);
  normals.topRows(400) = cloud.normals.topRows(400);
  const PointRegion region(cloud.positions, normals);
  EXPECT_TRUE(region.reading().normals_estimated);
  EXPECT_EQ(region.reading().kept.size(), 4000u);
  EXPECT_TRUE(has_note(region, "most points have no normals"));
  EXPECT_NEAR(region.volume() / Torus().volume(), 1, 0.02);
}

TEST(PointRegion, OpenSurfacesAreRefusedWithAdvice) {
  Random random(9);
  Points hills(4000, 3), bowl(4000, 3);
  for (Index i = 0; i < 4000; ++i) {
    const double x = random.uniform(-0.4, 0.4), y = random.uniform(-0.4, 0.4);
    hills.row(i) << x, y, 0.05 * std::sin(12 * x) * std::cos(9 * y);
    Vec3 n = random.in_cube(-1, 1).normalized();
    n.z() = -std::abs(n.z());
    bowl.row(i) = 0.4 * n.transpose();
  }
  for (const Points& open : {hills, bowl}) {
    const std::string words = refusal(open);
    EXPECT_NE(words.find("open surface"), std::string::npos) << words;
    EXPECT_NE(words.find("from all sides"), std::string::npos) << words;
  }
}

/// A scan of the shared data and points on it.
class ScannedShape : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const std::filesystem::path path =
        std::filesystem::path(SUPPLE_SHARED_DATA) / "data" / GetParam();
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "skipped: no shared data";
    mesh_ = of_unit_size(as_fans(read_mesh(path)));
    cloud_ = points_on(mesh_, 30000);
  }

  void expect_close(const PointRegion& region) const {
    const MeshRegion mesh(mesh_.positions, triangles_of(mesh_));
    EXPECT_NEAR(region.volume() / mesh.volume(), 1, 0.02);
    const PointCloud probes = points_on(mesh_, 2000, 77);
    double sum = 0;
    for (Index i = 0; i < probes.positions.rows(); ++i)
      sum += std::abs(region.signed_distance(probes.positions.row(i)));
    EXPECT_LT(sum / 2000, 0.001);
    Random random(4);
    int wrong = 0;
    for (int i = 0; i < 1000; ++i) {
      const Vec3 x = random.in_cube(-0.4, 0.4);
      if (std::abs(region.signed_distance(x) - mesh.signed_distance(x)) > 0.005) ++wrong;
    }
    EXPECT_LE(wrong, 20);  // of 1000: points at random leave some gaps of several spacings
  }

  Mesh mesh_;
  PointCloud cloud_;
};

TEST_P(ScannedShape, IsFoundFromPointsWithNormals) {
  expect_close(PointRegion(cloud_.positions, cloud_.normals));
}

TEST_P(ScannedShape, IsFoundFromPointsWithoutNormals) {
  expect_close(PointRegion(cloud_.positions));
}

INSTANTIATE_TEST_SUITE_P(PointRegion, ScannedShape,
                         testing::Values("stanford_bunny_3k.obj", "gargoyle_10k.off",
                                         "moai_10k.ply"));

}  // namespace
}  // namespace supple
