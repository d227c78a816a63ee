// Poses that start from another pose of the same vertices.

#include "modeler/pose/starting_pose.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "io/errors.h"
#include "modeler/pose/pose.h"
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

PoseResult pose_from(const Mesh& shape, const std::string& handles, const Points& from) {
  PoseFiles files;
  files.from = from;
  return pose(shape, scene_with("  from: posed.ply\n" + handles), {}, files);
}

/// The greatest difference over the diagonal.
double difference(const PoseResult& a, const PoseResult& b) {
  return (a.mesh.positions - b.mesh.positions).rowwise().norm().maxCoeff() /
         bounding_box(a.rest.positions).diagonal();
}

const std::string fixed = "  handles:\n    - fix: z<10%\n    - ";
const std::string once =
    fixed + "{move: z>90%, by: [0.3, 0, -0.1], turn: {axis: [0, 1, 0], degrees: 40}}\n";
const std::string first =
    fixed + "{move: z>90%, by: [0.1, 0, -0.02], turn: {axis: [0, 1, 0], degrees: 15}}\n";
const std::string second =
    fixed + "{move: z>90%, by: [0.2, 0, -0.08], turn: {axis: [0, 1, 0], degrees: 25}}\n";
const std::string held = fixed + "{fix: z>90%}\n";

TEST(StartingPose, TwoStepsEndWhereOneDoes) {
  const std::string hard = "  hard_handles: true\n  tolerance: 1e-9\n";
  const PoseResult one = pose(slim_bar(), scene_with(hard + once));
  const PoseResult half = pose(slim_bar(), scene_with(hard + first));
  const PoseResult two = pose_from(slim_bar(), hard + second, half.mesh.positions);
  EXPECT_EQ(two.report.status, Status::ok);
  RecordProperty("hard", fmt::format("{:.2g}", difference(one, two)));
  EXPECT_LT(difference(one, two), 1e-4);
  EXPECT_GT(difference(one, half), 0.1);
}

TEST(StartingPose, SoftHandlesInTwoStepsDifferByLittleMoreThanTheyMiss) {
  const PoseResult one = pose(slim_bar(), scene_with(once));
  const PoseResult two =
      pose_from(slim_bar(), second, pose(slim_bar(), scene_with(first)).mesh.positions);
  RecordProperty("soft", fmt::format("{:.2g}, handles miss {:.2g}", difference(one, two),
                                     one.handle_max_error));
  EXPECT_LT(difference(one, two), 2 * one.handle_max_error);
}

TEST(StartingPose, StaysWhereHandlesHoldIt) {
  const std::string hard = "  hard_handles: true\n  tolerance: 1e-9\n";
  const PoseResult from = pose(slim_bar(), scene_with(hard + once));
  const PoseResult held_there = pose_from(slim_bar(), hard + held, from.mesh.positions);
  EXPECT_LT(difference(from, held_there), 1e-5);
  EXPECT_LT(held_there.handle_max_error, 1e-6);
  const PoseResult let_go = pose_from(slim_bar(), "  handles: [fix: z<10%]\n", from.mesh.positions);
  EXPECT_LT((let_go.mesh.positions - let_go.rest.positions).cwiseAbs().maxCoeff(), 0.01);
}

TEST(StartingPose, WithoutHandlesIsMetAndSaidHowWell) {
  const PoseResult from = pose(slim_bar(), scene_with(once));
  const PoseResult same = pose_from(slim_bar(), "", from.mesh.positions);
  RecordProperty("fit", fmt::format("{:.2g}", difference(from, same)));
  EXPECT_LT(difference(from, same), 1e-7);
  EXPECT_EQ(same.report.status, Status::ok);
  EXPECT_TRUE(std::any_of(same.report.notes.begin(), same.report.notes.end(), [](const auto& note) {
    return note.starts_with("pose.from is met to");
  }));
}

TEST(StartingPose, OfAFarTurnedShapeIsRigid) {
  const Mesh bar = slim_bar();
  const Mat3 R = Eigen::AngleAxisd(2.5, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const Points turned = (bar.positions * R.transpose()).rowwise() + Eigen::RowVector3d(70, -20, 3);
  const PoseResult result = pose_from(bar, "", turned);
  EXPECT_LT((result.mesh.positions - turned).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_NEAR(result.min_det_F, 1, 1e-6);
}

TEST(StartingPose, ThatTheParticlesCannotTakeDegrades) {
  const Mesh bar = slim_bar();
  Points crumpled = bar.positions;
  for (Index i = 0; i < crumpled.rows(); ++i) crumpled(i, 0) += i % 2 == 0 ? 0.05 : -0.05;
  const PoseResult result = pose_from(bar, "", crumpled);
  const Reason* miss = result.report.find(ReasonCode::from_miss);
  ASSERT_NE(miss, nullptr);
  EXPECT_GT(miss->value, 0.02);
  EXPECT_EQ(result.report.status, Status::degraded);
}

TEST(StartingPose, OfACloudAndOfASizedShape) {
  Mesh cloud;
  cloud.positions = points_on(make_icosphere(1, 4), 2000).positions;
  Scene scene = scene_with("  from: posed.ply\n  handles: [fix: z<10%]\n");
  scene.shape.size = Length{6, Length::Unit::file};
  PoseFiles files;
  files.from = cloud.positions.rowwise() + Eigen::RowVector3d(1, 0, 0);
  const Box box = bounding_box(cloud.positions);
  files.from = (*files.from).rowwise() - box.center().transpose();
  files.from = *files.from * (6 / box.diagonal());
  const PoseResult result = pose(cloud, scene, {}, files);
  EXPECT_LT((result.mesh.positions - *files.from).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(StartingPose, RefusesOtherVerticesAndNumbersThatAreNone) {
  const Mesh bar = slim_bar();
  const std::string count =
      message_of<UsageError>([&] { pose_from(bar, "", bar.positions.topRows(7)); });
  EXPECT_NE(count.find("test:3:9: pose.from: posed.ply has 7 vertices, the shape 290"),
            std::string::npos)
      << count;
  Points broken = bar.positions;
  broken(3, 1) = std::nan("");
  const std::string nan = message_of<UsageError>([&] { pose_from(bar, "", broken); });
  EXPECT_NE(nan.find("not finite"), std::string::npos) << nan;
}

}  // namespace
}  // namespace supple
