// Poses that leave all outside a region as it is.

#include <algorithm>
#include <cstring>

#include <gtest/gtest.h>

#include "io/errors.h"
#include "modeler/pose/pose.h"
#include "modeler/pose/region_blend.h"
#include "tests/support/all_of.h"
#include "tests/support/bar_scene.h"
#include "tests/support/point_clouds.h"
#include "tests/support/region_shapes.h"
#include "tests/support/shapes.h"
#include "tests/support/temporary_folder.h"

namespace supple {
namespace {

Mesh slim_bar() {
  return make_quad_bar({0.25, 0.25, 1}, {4, 4, 16});
}

const std::string upper_half = "  region: z>40%\n";
const std::string bend =
    "  handles: [{move: z>90%, by: [20%, 0, -5%], turn: {axis: [0, 1, 0], degrees: 45}}]\n";

/// How many vertices that are not `inside` at rest keep every bit, and how many there are.
template <class Inside>
std::pair<int, int> kept(const PoseResult& result, const Points& before, const Inside& inside) {
  int same = 0, all = 0;
  for (Index i = 0; i < before.rows(); ++i) {
    if (inside(result.rest.positions.row(i))) continue;
    ++all;
    const double *a = before.row(i).data(), *b = result.mesh.positions.row(i).data();
    same += std::memcmp(a, b, 3 * sizeof(double)) == 0;
  }
  return {same, all};
}

/// In percent, by the run's note.
double taken_away(const PoseResult& result) {
  const std::string begin = "the blend at the region's edge takes ";
  for (const std::string& note : result.report.notes)
    if (note.starts_with(begin)) return std::stod(note.substr(begin.size()));
  return -1;
}

TEST(Region, LeavesEveryBitOutside) {
  const auto above = [](const auto& x) { return x[2] > 0.4; };
  for (const std::string hard : {"", "  hard_handles: true\n"}) {
    const PoseResult result = pose(slim_bar(), scene_with(hard + upper_half + bend));
    EXPECT_TRUE(result.report.usable());
    const auto [same, all] = kept(result, result.rest.positions, above);
    EXPECT_GT(all, 100);
    EXPECT_EQ(same, all);
    EXPECT_LT(result.handle_max_error, 0.01);
    EXPECT_GT(result.min_det_F, 0.1);
    RecordProperty(hard.empty() ? "soft" : "hard", fmt::format("{} %", taken_away(result)));
    EXPECT_GT(taken_away(result), 0);
    EXPECT_LT(taken_away(result), 3);
  }
}

TEST(Region, OfAllChangesNothing) {
  const PoseResult all = pose(slim_bar(), scene_with("  region: z>-1\n" + bend));
  EXPECT_EQ(all.mesh.positions, pose(slim_bar(), scene_with(bend)).mesh.positions);
}

TEST(Region, LeavesEveryBitOfThePoseItStartsFrom) {
  const PoseResult from =
      pose(slim_bar(), scene_with("  handles: [fix: z<10%, {move: z>90%, by: [10%, 0, 0]}]\n"));
  PoseFiles files;
  files.from = from.mesh.positions;
  const PoseResult result =
      pose(slim_bar(), scene_with("  from: a.ply\n" + upper_half + bend), {}, files);
  const auto [same, all] =
      kept(result, from.mesh.positions, [](const auto& x) { return x[2] > 0.4; });
  EXPECT_EQ(same, all);
  EXPECT_LT(result.handle_max_error, 0.01);
}

TEST(Region, OfACloudAndByListedVertices) {
  const TemporaryFolder folder;
  Mesh cloud;
  cloud.positions = points_on(make_icosphere(1, 4), 2000).positions;
  std::string upper;
  for (Index i = 0; i < cloud.positions.rows(); ++i)
    if (cloud.positions(i, 2) > -0.3) upper += fmt::format("{}\n", i);
  folder.put("upper.txt", upper);
  Scene scene =
      scene_with("  region: vertices(upper.txt)\n  handles: [{move: z>80%, by: [0, 0, 15%]}]\n");
  scene.folder = folder.path();
  const PoseResult result = pose(cloud, scene);
  const auto [same, all] = kept(result, cloud.positions, [](const auto& x) { return x[2] > -0.3; });
  EXPECT_GT(all, 300);
  EXPECT_EQ(same, all);
  EXPECT_GT((result.mesh.positions - cloud.positions).col(2).maxCoeff(), 0.4);
}

TEST(Region, RefusesHandlesOutside) {
  const auto message = [](const std::string& pose_lines) {
    return message_of<UsageError>([&] { pose(slim_bar(), scene_with(pose_lines)); });
  };
  const std::string outside = message("  region: z>40%\n  handles: [fix: z<10%]\n");
  EXPECT_NE(outside.find("test:4:13: 'z<10%' lies outside pose.region 'z>40%'"), std::string::npos)
      << outside;
  EXPECT_NE(message("  region: z>400%\n").find("'z>400%' selects nothing of the shape"),
            std::string::npos);
}

/// The blend of a bar's region, 0.2 wide.
struct BarBlend {
  Mesh bar = slim_bar();
  Triangulation triangulation = triangulate(bar);
  SurfaceSamples surface = sample_surface(bar.positions, triangulation.triangles, 0.03);
  SelectionContext context{bar, triangulation, bounding_box(bar.positions), {}};
  Selection region;
  RegionBlend blend;

  explicit BarBlend(const std::string& text)
      : region(parse_selection(text, {"test"})), blend(region, 0.2, context, surface) {}
};

TEST(RegionBlend, IsSmoothAndItsSlopeIsItsDerivative) {
  for (const std::string text :
       {"z>0.4", "box(0,0,0.2,0.25,0.25,0.8)", "not box(0,0,0.3,0.25,0.25,0.8)",
        "sphere(0,0,0.5,0.4)", "z>0.4 and not sphere(0.2,0.2,0.8,0.1)",
        "z<0.3 or z>0.7 or x>0.2"}) {
    const BarBlend bar(text);
    const Vec3 from(0.13, 0.11, 0.003), along = Vec3(0.02, 0.03, 0.99).normalized();
    const auto share = [&](double t) { return bar.blend.at(from + t * along); };
    const double h = 1e-4;
    const auto second = [&](double t) {
      return (share(t + h).value - 2 * share(t).value + share(t - h).value) / (h * h);
    };
    double most_jump = 0;
    for (double t = 0.02; t < 0.95; t += 0.001) {
      const double derivative = (share(t + h).value - share(t - h).value) / (2 * h);
      EXPECT_NEAR(share(t).slope.dot(along), derivative, 1e-3) << text << " at " << t;
      most_jump = std::max(most_jump, std::abs(second(t + h) - second(t - h)));
      EXPECT_GE(share(t).value, 0);
      EXPECT_LE(share(t).value, 1);
    }
    // The third derivative is at most 60 / 0.2³ a factor; a jump would be about 6 / 0.2² = 150.
    EXPECT_LT(most_jump, 10) << text;
  }
}

TEST(RegionBlend, IsNothingOutsideAndAllDeepInside) {
  const BarBlend bar("z>0.4 and not z>0.9");
  EXPECT_EQ(bar.blend.at({0.1, 0.1, 0.4}).value, 0);
  EXPECT_EQ(bar.blend.at({0.1, 0.1, 0.95}).value, 0);
  EXPECT_EQ(bar.blend.at({0.1, 0.1, 0.65}).value, 1);
  EXPECT_NEAR(bar.blend.at({0.1, 0.1, 0.5}).value, 0.5, 1e-12);
}

}  // namespace
}  // namespace supple
