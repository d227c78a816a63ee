#include "modeler/pose/stiffness.h"

#include <gtest/gtest.h>

#include "io/errors.h"
#include "modeler/pose/pose.h"
#include "tests/support/all_of.h"
#include "tests/support/bar_scene.h"
#include "tests/support/region_shapes.h"
#include "tests/support/shapes.h"
#include "tests/support/temporary_folder.h"

namespace supple {
namespace {

Mesh slim_bar() {
  return make_quad_bar({0.25, 0.25, 1}, {4, 4, 16});
}

const std::string bend =
    "  handles:\n    - fix: z<10%\n"
    "    - {move: z>90%, by: [25%, 0, -10%], turn: {axis: [0, 1, 0], degrees: 60}}\n";

/// The direction of the bar's axis from height z to height z + 1/8, in degrees from z towards x.
double direction(const PoseResult& result, double z) {
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero();
  for (Index i = 0; i < result.rest.positions.rows(); ++i) {
    const double height = result.rest.positions(i, 2);
    if (std::abs(height - z) < 1e-9) lower += result.mesh.positions.row(i).transpose() / 16;
    if (std::abs(height - z - 0.125) < 1e-9) upper += result.mesh.positions.row(i).transpose() / 16;
  }
  const Vec3 along = upper - lower;
  return std::atan2(along[0], along[2]) * 180 / EIGEN_PI;
}

double bend_in_the_middle(const PoseResult& result) {
  return direction(result, 0.5625) - direction(result, 0.3125);
}

TEST(Stiffness, ABarBendsLessWhereItIsStiff) {
  const double even = bend_in_the_middle(pose(slim_bar(), scene_with(bend)));
  const double stiff = bend_in_the_middle(
      pose(slim_bar(), scene_with(bend + "  stiffness: [{select: z:35%..65%, times: 50}]\n")));
  const double soft = bend_in_the_middle(
      pose(slim_bar(), scene_with(bend + "  stiffness: [{select: z:35%..65%, times: 0.2}]\n")));
  RecordProperty("degrees",
                 fmt::format("{:.1f} even, {:.1f} stiff, {:.1f} soft", even, stiff, soft));
  EXPECT_GT(even, 10);
  EXPECT_LT(stiff, 0.5 * even);
  EXPECT_GT(soft, 1.2 * even);
}

TEST(Stiffness, OfOneTimesChangesNoBit) {
  const Points even = pose(slim_bar(), scene_with(bend)).mesh.positions;
  const Points once =
      pose(slim_bar(), scene_with(bend + "  stiffness: [{select: z<50%, times: 1}]\n"))
          .mesh.positions;
  EXPECT_EQ(even, once);
}

TEST(Stiffness, OfAllIsAsWeakerHandles) {
  const Points all =
      pose(slim_bar(), scene_with(bend + "  stiffness: [{select: z>-1, times: 4}]\n"))
          .mesh.positions;
  const Points weaker =
      pose(slim_bar(), scene_with(bend + "  weights: {handles: 2500}\n")).mesh.positions;
  EXPECT_LT((all - weaker).cwiseAbs().maxCoeff(), 1e-4);
}

/// Factors at points on the bar's axis at these heights.
Eigen::VectorXd factors_at(const std::vector<double>& heights, const std::string& parts,
                           const std::filesystem::path& folder = {}) {
  const Mesh bar = slim_bar();
  const Triangulation triangulation = triangulate(bar);
  const SelectionContext context{bar, triangulation, bounding_box(bar.positions), folder};
  Points points(static_cast<Index>(heights.size()), 3);
  for (std::size_t i = 0; i < heights.size(); ++i)
    points.row(static_cast<Index>(i)) << 0.125, 0.125, heights[i];
  const Scene scene = scene_with("  stiffness: " + parts + "\n");
  return stiffness_factors(scene.pose->stiffness, context,
                           sample_surface(bar.positions, triangulation.triangles, 0.05), points);
}

TEST(Stiffness, SpeaksOfInsidePointsAndMultiplies) {
  const Eigen::VectorXd factors = factors_at(
      {0.1, 0.4, 0.6, 0.9}, "[{select: z<50%, times: 2}, {select: z:30%..70%, times: 3}]");
  EXPECT_EQ(factors, Eigen::Vector4d(2, 6, 3, 1));
  EXPECT_EQ(
      factors_at({0.2, 0.8},
                 "[{select: {sphere: {center: [0.125, 0.125, 0.2], radius: 0.05}}, times: 7}]"),
      Eigen::Vector2d(7, 1));
}

TEST(Stiffness, OfListedVerticesIsThatOfTheSurfaceNearby) {
  const TemporaryFolder folder;
  const Mesh bar = slim_bar();
  std::string upper;
  for (Index i = 0; i < bar.positions.rows(); ++i)
    if (bar.positions(i, 2) > 0.5) upper += fmt::format("{}\n", i);
  folder.put("upper.txt", upper);
  EXPECT_EQ(
      factors_at({0.2, 0.4, 0.7, 0.9}, "[{select: vertices(upper.txt), times: 5}]", folder.path()),
      Eigen::Vector4d(1, 1, 5, 5));
}

TEST(Stiffness, ComplainsOfAPartWithNothingInIt) {
  const std::string message =
      message_of<UsageError>([] { factors_at({0.2}, "[{select: z>200%, times: 5}]"); });
  EXPECT_NE(message.find("test:3:24: 'z>200%' selects nothing of the points"), std::string::npos)
      << message;
}

}  // namespace
}  // namespace supple
