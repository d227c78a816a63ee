// Handles that act on both sides of a plane.

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "io/errors.h"
#include "modeler/pose/mirrored_handle.h"
#include "modeler/pose/pose.h"
#include "tests/support/all_of.h"
#include "tests/support/bar_scene.h"
#include "tests/support/point_clouds.h"
#include "tests/support/region_shapes.h"
#include "tests/support/shapes.h"
#include "tests/support/temporary_folder.h"

namespace supple {
namespace {

/// A bar along x, its middle at the origin.
Mesh lying_bar() {
  return mapped(make_quad_bar({1, 0.25, 0.25}, {16, 4, 4}),
                [](const Vec3& x) -> Vec3 { return x - Vec3(0.5, 0.125, 0.125); });
}

/// How far the pose is from its own image: the greatest distance of a vertex's image to the vertex
/// that lies at the image of its rest place.
double pose_asymmetry(const PoseResult& result, const MirrorPlane& plane) {
  double greatest = 0;
  for (Index i = 0; i < result.rest.positions.rows(); ++i) {
    const Vec3 image = plane.point(result.rest.positions.row(i).transpose());
    Index partner;
    (result.rest.positions.rowwise() - image.transpose()).rowwise().norm().minCoeff(&partner);
    const Vec3 moved_image = plane.point(result.mesh.positions.row(i).transpose());
    greatest =
        std::max(greatest, (result.mesh.positions.row(partner) - moved_image.transpose()).norm());
  }
  return greatest;
}

bool notes_have(const PoseResult& result, const std::string& words) {
  return std::any_of(
      result.report.notes.begin(), result.report.notes.end(),
      [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

const std::string across_x = "  mirror: {normal: [1, 0, 0]}\n";
const std::string wings =
    "  handles:\n    - fix: box(-0.13,-1,-1,0.13,1,1)\n"
    "    - {move: x>90%, by: [-5%, 0, 20%], turn: {axis: [0, 1, 0], degrees: -40}}\n";

TEST(Mirror, ThePoseOfASymmetricBarIsSymmetric) {
  for (const std::string more : {"", "  hard_handles: true\n", "  surface: particle_gradients\n"}) {
    const PoseResult result = pose(lying_bar(), scene_with(more + across_x + wings));
    EXPECT_TRUE(result.report.usable());
    EXPECT_LT(pose_asymmetry(result, {}), 1e-6);
    EXPECT_GT(result.mesh.positions.col(2).maxCoeff(), 0.25);
    EXPECT_LT(result.handle_max_error, 0.01);
    // The held middle is its own image; the wing is not.
    ASSERT_EQ(result.handles.size(), 3u);
    EXPECT_EQ(result.handles[2].selection, "x>90%, mirrored");
    EXPECT_TRUE(notes_have(result, "the pose is made so too"));
  }
}

TEST(Mirror, IsWhatHandlesOnBothSidesGive) {
  const PoseResult mirrored = pose(lying_bar(), scene_with(across_x + wings));
  const PoseResult both = pose(
      lying_bar(),
      scene_with(wings + "    - {move: x<10%, by: [5%, 0, 20%], turn: {axis: [0, 1, 0], degrees: "
                         "40}}\n"));
  EXPECT_LT((mirrored.mesh.positions - both.mesh.positions).cwiseAbs().maxCoeff(), 0.01);
}

TEST(Mirror, AnObliquePlaneTurnsAndScalesTheOtherWay) {
  const Mat3 R = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const Vec3 by(2, -1, 4);
  const Mesh bar = mapped(lying_bar(), [&](const Vec3& x) -> Vec3 { return R * x + by; });
  const MirrorPlane plane{R.col(0), by};
  const std::string scene = fmt::format(
      "  mirror: {{normal: [{:.17g}, {:.17g}, {:.17g}], at: [2, -1, 4]}}\n"
      "  handles:\n    - fix: sphere(2,-1,4,0.2)\n    - {{move: "
      "'sphere({:.17g},{:.17g},{:.17g},0.2)', "
      "by: [0.1, 0.05, 0.1], scale: [1.2, 1, 1], turn: {{axis: [1, 1, 0], degrees: 20}}}}\n",
      plane.normal[0], plane.normal[1], plane.normal[2], by[0] + 0.45 * R(0, 0),
      by[1] + 0.45 * R(1, 0), by[2] + 0.45 * R(2, 0));
  const PoseResult result = pose(bar, scene_with(scene));
  EXPECT_EQ(result.handles.size(), 3u);
  EXPECT_LT(pose_asymmetry(result, plane), 1e-6);
  EXPECT_LT(result.handle_max_error, 0.03);
}

TEST(Mirror, MirrorsPlacesOfVerticesAndNamedParts) {
  const TemporaryFolder folder;
  const Mesh bar = lying_bar();
  std::string right;
  for (Index i = 0; i < bar.positions.rows(); ++i)
    if (bar.positions(i, 0) > 0.4) right += fmt::format("{}\n", i);
  folder.put("right.txt", right);
  Scene scene = scene_with(across_x +
                           "  handles: [{fix: 'box(-0.13,-1,-1,0.13,1,1)'}, {move: "
                           "vertices(right.txt), to: targets.ply}]\n");
  scene.folder = folder.path();
  VertexPlaces places{std::vector<int>(static_cast<std::size_t>(bar.positions.rows())),
                      bar.positions.rowwise() + Eigen::RowVector3d(0.02, 0.01, 0.15)};
  std::iota(places.vertices.begin(), places.vertices.end(), 0);
  const PoseResult result = pose(bar, scene, {}, {{}, {{}, places}});
  EXPECT_EQ(result.handles.size(), 3u);
  EXPECT_EQ(result.handles[2].samples, result.handles[1].samples);
  EXPECT_LT(pose_asymmetry(result, {}), 1e-6);
  EXPECT_LT(result.handle_max_error, 0.01);
}

TEST(Mirror, SaysHowFarAShapeIsFromSymmetric) {
  Mesh bar = lying_bar();
  for (Index i = 0; i < bar.positions.rows(); ++i)
    if (bar.positions(i, 0) > 0.49) bar.positions(i, 0) += 0.1;
  const PoseResult result =
      pose(bar, scene_with("  mirror: {normal: [1, 0, 0], at: [0, 0, 0]}\n" + wings));
  EXPECT_TRUE(notes_have(result, "the shape is symmetric about pose.mirror to 8.7 %"));
  EXPECT_FALSE(notes_have(result, "made so too"));
  EXPECT_LT(result.mesh.positions.col(2).maxCoeff(), 0.6);
}

TEST(Mirror, OfACloudAndOfASizedShape) {
  Mesh cloud;
  const Points half = points_on(make_icosphere(1, 4), 2000).positions;
  cloud.positions.resize(2 * half.rows(), 3);
  cloud.positions << half, MirrorPlane{}.points(half);
  Scene scene = scene_with(across_x + "  handles: [fix: z<20%, {move: x>90%, by: [5%, 0, 5%]}]\n");
  scene.shape.size = Length{7, Length::Unit::file};
  const PoseResult result = pose(cloud, scene);
  EXPECT_LT(pose_asymmetry(result, {}), 7e-6);
  EXPECT_GT(result.mesh.positions.col(0).maxCoeff(),
            1.04 * result.rest.positions.col(0).maxCoeff());
}

TEST(Mirror, ComplainsWhereNothingLiesOnTheOtherSide) {
  const std::string message = message_of<UsageError>([] {
    pose(lying_bar(), scene_with("  mirror: {normal: [1, 0, 0], at: [2, 0, 0]}\n" + wings));
  });
  EXPECT_NE(message.find("test:5:7: 'box(-0.13,-1,-1,0.13,1,1)': nothing of the shape lies on the "
                         "other side of pose.mirror"),
            std::string::npos)
      << message;
}

}  // namespace
}  // namespace supple
