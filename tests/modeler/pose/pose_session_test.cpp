#include "modeler/pose/pose_session.h"

#include <numbers>

#include <gtest/gtest.h>

#include "io/errors.h"
#include "modeler/pose/pose.h"
#include "solver/core/random.h"
#include "tests/support/bar_scene.h"
#include "tests/support/shapes.h"

namespace supple {
namespace {

constexpr const char* held_and_led = "  handles:\n    - fix: z<10%\n    - {move: z>90%}\n";
const Vec3 top(0.5, 0.5, 4);  ///< of the bar

Mesh bar() {
  return make_bar({1, 1, 4}, {8, 8, 32});
}
double diagonal() {
  return bounding_box(bar().positions).diagonal();
}

HandlePath path_of(const Vec3& by, double degrees) {
  HandlePath path;
  path.center = path.about = top;
  path.axis = Vec3::UnitY();
  path.by = by;
  path.radians = degrees * std::numbers::pi / 180;
  return path;
}

double difference(const FloatPoints& a, const Points& b) {
  return (a.cast<double>() - b).rowwise().norm().maxCoeff() / diagonal();
}

TEST(PoseSession, IsAtRestWhereItBegins) {
  PoseSession session(bar(), scene_with(held_and_led));
  FloatPoints positions;
  session.deform(positions);
  EXPECT_LT(difference(positions, bar().positions), 1e-7);
}

TEST(PoseSession, ADragInSmallStepsEndsWherePoseEnds) {
  PoseSession session(bar(), scene_with(held_and_led));
  Lbfgs::Result last;
  for (int step = 1; step <= 20; ++step) {
    session.lead(1, path_of(0.05 * step * Vec3(1, 0, -0.3), 1.5 * step));
    last = session.drag();
    EXPECT_EQ(last.stop, Lbfgs::Stop::converged);
  }
  const PoseResult at_once = pose(bar(), scene_with("  handles:\n    - fix: z<10%\n    - {move: "
                                                    "z>90%, by: [1, 0, -0.3], turn: {axis: [0, 1, "
                                                    "0], degrees: 30, about: [0.5, 0.5, 4]}}\n"));
  EXPECT_NEAR(last.energy, at_once.report.total_energy(), 1e-3 * at_once.report.total_energy());
  FloatPoints positions;
  session.deform(positions);
  EXPECT_LT(difference(positions, at_once.mesh.positions), 2e-3);
  session.release();
  session.deform(positions);
  EXPECT_LT(difference(positions, at_once.mesh.positions), 2e-4);
}

TEST(PoseSession, ReleaseIsNoWorseThanAPoseFromRestWhateverWasBefore) {
  PoseSession session(bar(), scene_with(held_and_led));
  Random random(8);
  for (int jump = 0; jump < 30; ++jump) {
    session.lead(1, path_of(random.in_cube(-3, 3), random.uniform(-170, 170)));
    session.drag({.max_iterations = 3});
  }
  session.lead(1, path_of({1, 0, -0.5}, 40));
  const Report released = session.release();
  PoseSession fresh(bar(), scene_with(held_and_led));
  fresh.lead(1, path_of({1, 0, -0.5}, 40));
  EXPECT_EQ(released.status, Status::ok);
  EXPECT_LE(released.total_energy(), fresh.release().total_energy() * (1 + 1e-9));
}

TEST(PoseSession, HardHandlesAreMetWhereverTheDragBegan) {
  PoseSession session(bar(), scene_with("  hard_handles: true\n  handles:\n    - fix: z<10%\n    - "
                                        "{move: z>90%}\n"));
  session.lead(1, {});  // stays
  session.drag();
  const HandlePath path = path_of({0.2, 0, 0.1}, 20);
  session.lead(1, path);
  session.drag();
  FloatPoints positions;
  session.deform(positions);
  const Mesh rest = bar();
  double miss = 0;
  for (Index i = 0; i < rest.positions.rows(); ++i)
    if (const Vec3 x = rest.positions.row(i).transpose(); x.z() > 3.6 + 1e-9)
      miss = std::max(miss, (positions.row(i).cast<double>().transpose() - path(x, 1)).norm());
  EXPECT_LT(miss / diagonal(), 1e-6);
}

TEST(PoseSession, AReleaseKeepsWhatTheSceneForbids) {
  const std::string handles =
      "  no_inversion: true\n  handles:\n    - fix: z<10%\n    - {move: z>90%, by: [0, 0, -30%]}\n";
  const PoseResult at_once = pose(bar(), scene_with(handles));
  PoseSession session(bar(), scene_with(handles));
  for (int step = 1; step <= 10; ++step) {
    HandlePath path = path_of(0.03 * step * diagonal() * Vec3(0, 0, -1), 0);
    session.lead(1, path);
    session.drag();
  }
  const Report report = session.release();
  ASSERT_GT(at_once.min_det_F, 0);
  EXPECT_TRUE(report.usable());
  EXPECT_EQ(report.find(ReasonCode::inverted), nullptr);
}

TEST(PoseSession, LedByAStiffMotionItsSurfaceIsMovedSo) {
  PoseSession session(bar(), scene_with("  handles:\n    - {move: z<10%}\n    - {move: z>90%}\n"));
  const HandlePath path = path_of({10, 0, 5}, 35);
  session.lead(0, path);
  session.lead(1, path);
  EXPECT_EQ(session.release().status, Status::ok);
  FloatPoints positions, normals;
  session.deform(positions, normals);
  Points expected = bar().positions;
  for (Index i = 0; i < expected.rows(); ++i)
    expected.row(i) = path(expected.row(i).transpose(), 1).transpose();
  EXPECT_LT(difference(positions, expected), 1e-6);
  EXPECT_NEAR(normals.rowwise().norm().minCoeff(), 1, 1e-5);
}

TEST(PoseSession, SaysWhatItDoesNotKnow) {
  EXPECT_THROW(PoseSession(bar(), scene_with("  weights: {volume: 1}\n")), UsageError);
  EXPECT_THROW(PoseSession(bar(), scene_with(std::string(held_and_led) + "  region: z>5%\n")),
               UsageError);
}

}  // namespace
}  // namespace supple
