// Handles that lead each vertex to a place of its own.

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

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

VertexPlaces all_to(const Points& places) {
  VertexPlaces all{std::vector<int>(static_cast<std::size_t>(places.rows())), places};
  std::iota(all.vertices.begin(), all.vertices.end(), 0);
  return all;
}

Points turned(const Points& points, double degrees, const Vec3& by) {
  const Mat3 R =
      Eigen::AngleAxisd(degrees * EIGEN_PI / 180, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  return (points * R.transpose()).rowwise() + by.transpose();
}

TEST(VertexTargets, OfARigidMotionComeOutRigid) {
  for (const double degrees : {40.0, 179.0}) {
    const Mesh bar = slim_bar();
    const Points places = turned(bar.positions, degrees, {3, -1, 2});
    const PoseResult result = pose(bar, scene_with("  handles: [{move: z>50%, to: targets.ply}]\n"),
                                   {}, {{}, {all_to(places)}});
    EXPECT_EQ(result.report.status, Status::ok);
    EXPECT_LT((result.mesh.positions - places).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST(VertexTargets, AreTheSameAsTheMotionTheyCameFrom) {
  const Mesh bar = slim_bar();
  const std::string hard =
      "  hard_handles: true\n  tolerance: 1e-9\n  handles:\n    - fix: z<10%\n    - ";
  Points places = bar.positions;
  for (Index i = 0; i < places.rows(); ++i) {
    const Vec3 about(0.125, 0.125, 0.5), x = bar.positions.row(i).transpose();
    places.row(i) = (about + Eigen::AngleAxisd(1, Vec3::UnitX()) * (x - about)).transpose();
  }
  const PoseResult moved = pose(
      bar, scene_with(hard +
                      "{move: z>93.7%, turn: {axis: [1, 0, 0], degrees: 57.29577951308232, about: "
                      "[0.125, 0.125, 0.5]}}\n"));
  const PoseResult led = pose(bar, scene_with(hard + "{move: z>93.7%, to: targets.ply}\n"), {},
                              {{}, {{}, all_to(places)}});
  EXPECT_EQ(led.report.status, Status::ok);
  EXPECT_LT(led.handle_max_error, 1e-6);
  EXPECT_LT((moved.mesh.positions - led.mesh.positions).cwiseAbs().maxCoeff(), 5e-3);
}

TEST(VertexTargets, OfFewVerticesAreMet) {
  const Mesh bar = slim_bar();
  const VertexPlaces corners{{0, 289}, (Points(2, 3) << -0.05, 0, 0, 0.3, 0.25, 1.05).finished()};
  const PoseResult result =
      pose(bar, scene_with("  handles: [{to: nose.txt}]\n"), {}, {{}, {corners}});
  ASSERT_EQ(result.handles.size(), 1u);
  EXPECT_EQ(result.handles[0].samples, 2);
  EXPECT_EQ(result.handles[0].selection, "nose.txt");
  EXPECT_LT(result.handle_max_error, 0.01);
  for (const int row : {0, 1})
    EXPECT_LT(
        (result.mesh.positions.row(corners.vertices[std::size_t(row)]) - corners.places.row(row))
            .norm(),
        0.011);
}

TEST(VertexTargets, LeadCloudsToo) {
  Mesh cloud;
  cloud.positions = points_on(make_icosphere(1, 4), 2000).positions;
  const Points places = turned(cloud.positions, 70, {0, 2, 0});
  const PoseResult result = pose(cloud, scene_with("  handles: [{move: z>0, to: targets.ply}]\n"),
                                 {}, {{}, {all_to(places)}});
  EXPECT_LT((result.mesh.positions - places).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(VertexTargets, ComplainOfVerticesThatCannotLead) {
  Mesh bar = slim_bar();
  bar.positions.conservativeResize(291, 3);
  bar.positions.row(290) << 0.1, 0.1, 0.1;
  const auto message = [&](const std::string& handle, int vertex) {
    return message_of<UsageError>([&] {
      pose(bar, scene_with("  handles: [" + handle + "]\n"), {},
           {{}, {VertexPlaces{{vertex}, Points::Zero(1, 3)}}});
    });
  };
  EXPECT_NE(
      message("{to: a.txt}", 290).find("test:3:18: a.txt: vertex 290 does not lie on the surface"),
      std::string::npos)
      << message("{to: a.txt}", 290);
  EXPECT_NE(message("{move: z>90%, to: a.txt}", 0).find("a.txt lists no vertex of z>90%"),
            std::string::npos);
}

}  // namespace
}  // namespace supple
