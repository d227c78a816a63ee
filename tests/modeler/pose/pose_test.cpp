#include "modeler/pose/pose.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io/mesh/mesh_files.h"
#include "io/scene/scene_reader.h"
#include "modeler/domain/shape_error.h"
#include "solver/core/parallel.h"
#include "tests/support/all_of.h"
#include "tests/support/bar_scene.h"
#include "tests/support/fingers.h"
#include "tests/support/point_clouds.h"
#include "tests/support/region_shapes.h"
#include "tests/support/shapes.h"
#include "tests/support/temporary_folder.h"

namespace supple {
namespace {

/// The box of Adams & Wicke's Fig. 13: base fixed, top moved sideways by a quarter of its height.
PoseResult pose_box(double volume_weight, MinimizerKind solver = MinimizerKind::lbfgs) {
  Scene scene = scene_with("  handles:\n    - fix: z<2%\n    - {move: z>98%, by: [0.5, 0, 0]}\n");
  scene.pose->weights.volume = volume_weight;
  scene.pose->solver = solver;
  return pose(make_quad_bar({1, 1, 2}, {8, 8, 16}), scene);
}

double volume_change(const PoseResult& result) {
  return result.volume_after / result.volume_before - 1;
}

TEST(Pose, RigidityAloneSwellsTheBoxAndTheVolumeTermKeepsIt) {
  const double alone = volume_change(pose_box(0));
  const double kept = volume_change(pose_box(1));
  const double kept_firmly = volume_change(pose_box(10));
  RecordProperty("volume_change_rigidity_only", fmt::format("{:+.4f}", alone));
  RecordProperty("volume_change_weight_1", fmt::format("{:+.4f}", kept));
  RecordProperty("volume_change_weight_10", fmt::format("{:+.4f}", kept_firmly));
  EXPECT_GT(alone, 0.02);
  EXPECT_LT(std::abs(kept), 0.02);
  EXPECT_LT(std::abs(kept_firmly), 0.01);
}

TEST(Pose, TheReferenceMinimiserFindsTheSamePose) {
  const PoseResult lbfgs = pose_box(1);
  const PoseResult reference = pose_box(1, MinimizerKind::trust_region);
  EXPECT_NEAR(lbfgs.report.total_energy(), reference.report.total_energy(),
              1e-3 * reference.report.total_energy());
  const double diagonal = bounding_box(lbfgs.rest.positions).diagonal();
  EXPECT_LT((lbfgs.mesh.positions - reference.mesh.positions).cwiseAbs().maxCoeff(),
            5e-3 * diagonal);
}

TEST(Pose, MeetsItsHandlesAndKeepsTheMesh) {
  const Mesh bar = make_quad_bar({0.25, 0.25, 1}, {4, 4, 16});
  const PoseResult result = pose(bar, scene_with("  handles:\n    - fix: z<10%\n"
                                                 "    - move: z>90%\n"
                                                 "      by: [20%, 0, -5%]\n"
                                                 "      turn: {axis: [0, 1, 0], degrees: 60}\n"));
  EXPECT_EQ(result.report.status, Status::ok);
  EXPECT_LT(result.handle_max_error, 0.01);
  ASSERT_EQ(result.handles.size(), 2u);
  EXPECT_GT(result.handles[1].samples, 50);
  EXPECT_GT(result.min_det_F, 0.1);
  EXPECT_LT(std::abs(volume_change(result)), 0.03);
  EXPECT_EQ(result.mesh.face_vertices, bar.face_vertices);
  EXPECT_EQ(result.mesh.positions.rows(), bar.positions.rows());
}

TEST(Pose, HardHandlesAreMetExactly) {
  const std::string handles =
      "  hard_handles: true\n  handles:\n    - fix: z<10%\n"
      "    - {move: z>90%, by: [5%, 0, -2%], turn: {axis: [0, 1, 0], degrees: 40}}\n";
  const Mesh bar = make_quad_bar({0.25, 0.25, 1}, {4, 4, 16});
  const PoseResult hard = pose(bar, scene_with(handles));
  EXPECT_EQ(hard.report.status, Status::ok);
  EXPECT_LT(hard.handle_max_error, 1e-9);
  EXPECT_GT(hard.min_det_F, 0.1);
  const PoseResult check = pose(bar, scene_with("  solver: nlopt\n" + handles, 60));
  EXPECT_LT(check.handle_max_error, 1e-7);
  EXPECT_NEAR(check.report.total_energy(), pose(bar, scene_with(handles, 60)).report.total_energy(),
              1e-3 * check.report.total_energy());
}

TEST(Pose, HardHandlesThatContradictEachOtherAreSaidSo) {
  const PoseResult result = pose(
      make_quad_bar({0.25, 0.25, 1}, {4, 4, 16}),
      scene_with("  hard_handles: true\n  handles:\n    - fix: z<10%\n"
                 "    - {move: z>90%, by: [5%, 0, 0]}\n    - {move: z>80%, by: [0, 5%, 0]}\n"));
  EXPECT_EQ(result.report.status, Status::degraded);
  const Reason* miss = result.report.find(ReasonCode::handle_miss);
  ASSERT_NE(miss, nullptr);
  EXPECT_NE(miss->detail.find("cannot meet all"), std::string::npos);
  EXPECT_LT(result.handle_max_error, 0.1);
  EXPECT_TRUE(result.mesh.positions.allFinite());
}

TEST(Pose, IsTheSameForEveryNumberOfThreads) {
  const auto positions = [](int threads) {
    const ThreadLimit limit(threads);
    return pose_box(1).mesh.positions;
  };
  EXPECT_EQ(positions(1), positions(2));
}

TEST(Pose, DoesNotDependOnUnitsOrPlace) {
  const std::string handles =
      "  handles:\n    - fix: z<10%\n    - {move: z>90%, by: [20%, 10%, 0]}\n";
  const Mesh bar = make_quad_bar({0.25, 0.25, 1}, {4, 4, 16});
  Mesh moved = bar;
  moved.positions = (bar.positions * 1000).rowwise() + Eigen::RowVector3d(5e4, -3e4, 1e4);
  const Points a = pose(bar, scene_with(handles)).mesh.positions;
  Points b = pose(moved, scene_with(handles)).mesh.positions;
  b = (b.rowwise() - Eigen::RowVector3d(5e4, -3e4, 1e4)) / 1000;
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(Pose, WeightsScalesAndTurnsBeyondHalfATurn) {
  const Mesh bar = make_quad_bar({0.25, 0.25, 1}, {4, 4, 16});
  // Two handles pull one end apart: it ends at their weighted mean.
  const PoseResult pulled =
      pose(bar, scene_with("  handles:\n    - {move: z>90%, by: [0.1, 0, 0], weight: 3}\n"
                           "    - {move: z>90%, by: [-0.1, 0, 0]}\n"));
  const Vec3 shift = (pulled.mesh.positions - bar.positions).colwise().mean().transpose();
  EXPECT_NEAR(shift[0], 0.05, 1e-6);

  const PoseResult scaled = pose(
      bar, scene_with("  handles:\n    - fix: z<10%\n    - {move: z>90%, scale: [1.5, 1.5, 1]}\n"));
  EXPECT_GT(bounding_box(scaled.mesh.positions).size()[0], 1.3 * 0.25);

  // 270° is not −90°: the middle of the bar turns by about 135°.
  const PoseResult twisted =
      pose(bar, scene_with("  handles:\n    - fix: z<5%\n"
                           "    - {move: z>95%, turn: {axis: [0, 0, 1], degrees: 270}}\n"));
  for (Index i = 0; i < bar.positions.rows(); ++i) {
    const Vec3 x = bar.positions.row(i).transpose();
    if (std::abs(x[2] - 0.5) > 1e-9 || x[0] != 0 || x[1] != 0) continue;
    const Vec3 y = twisted.mesh.positions.row(i).transpose();
    const double before = std::atan2(x[1] - 0.125, x[0] - 0.125);
    const double angle = std::atan2(y[1] - 0.125, y[0] - 0.125) - before;
    EXPECT_NEAR(std::cos(angle - 135 * EIGEN_PI / 180), 1, 0.05);
  }
}

TEST(Pose, HoldsATwistOfTwoTurnsOrSaysThatItIsLost) {
  const Mesh bar = make_quad_bar({1, 8, 1}, {4, 32, 4});
  const PoseResult result =
      pose(bar, scene_with("  handles:\n    - fix: y<5%\n"
                           "    - {move: y>95%, turn: {axis: [0, 1, 0], degrees: 720}}\n"));
  double rigidity = 0;
  for (const auto& [name, value] : result.report.energies)
    if (name == "rigidity") rigidity = value;
  const bool said_so = result.report.find(ReasonCode::turn_lost);
  // The straight bar has no energy, and one turn less 0.19.
  EXPECT_TRUE(said_so || rigidity > 0.3) << rigidity;
}

/// Two bars side by side, `gap` apart, in one mesh.
Mesh two_bars(double gap) {
  Mesh two = make_quad_bar({0.25, 0.25, 1}, {4, 4, 16});
  const Mesh one = two;
  const Index count = one.positions.rows();
  two.positions.conservativeResize(2 * count, 3);
  two.positions.bottomRows(count) = one.positions.rowwise() + Eigen::RowVector3d(gap, 0, 0);
  for (const int vertex : one.face_vertices)
    two.face_vertices.push_back(vertex + static_cast<int>(count));
  const int corners = one.face_starts.back();
  for (int face = 0; face < one.face_count(); ++face)
    two.face_starts.push_back(corners + one.face_starts[std::size_t(face) + 1]);
  return two;
}

TEST(Pose, APieceWithoutHandlesStaysAndIsNamed) {
  const Mesh two = two_bars(3);
  const PoseResult result = pose(two, scene_with("  handles:\n    - fix: z<5% and x<1\n"
                                                 "    - {move: z>95% and x<1, by: [0.1, 0, 0]}\n"));
  const Index count = two.positions.rows() / 2;
  EXPECT_LT((result.mesh.positions - two.positions).bottomRows(count).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_GT((result.mesh.positions - two.positions).topRows(count).cwiseAbs().maxCoeff(), 0.09);
  EXPECT_TRUE(std::any_of(result.report.notes.begin(), result.report.notes.end(),
                          [](const std::string& note) {
                            return note.find("pieces without handles") != std::string::npos;
                          }));
}

TEST(Pose, APartThatMovesByItselfIsRigidSoon) {
  const Mesh bar = make_bar({1, 1, 2}, {4, 4, 8});
  const Mesh pair =
      joined(bar, mapped(bar, [](const Vec3& x) -> Vec3 { return x + Vec3(3, 0, 0); }));
  const PoseResult result =
      pose(pair, scene_with("  handles:\n    - fix: x<1.5 and z<20%\n"
                            "    - {move: x>1.5 and z>80%, by: [0, 5%, 0]}\n"));
  EXPECT_EQ(result.report.status, Status::ok);
  EXPECT_LT(result.report.iterations, 1000);
  EXPECT_NEAR(result.min_det_F, 1, 1e-5);
  EXPECT_LT(result.handle_max_error, 1e-6);
}

TEST(Pose, AVertexThatNoFaceUsesChangesNothing) {
  const std::string handles =
      "  handles:\n    - fix: z<10%\n    - {move: z>90%, by: [20%, 10%, 0]}\n";
  const Mesh bar = make_quad_bar({0.25, 0.25, 1}, {4, 4, 16});
  Mesh stray = bar;
  stray.positions.conservativeResize(bar.positions.rows() + 1, 3);
  stray.positions.bottomRows(1) << 1000, 1000, 1000;
  const PoseResult clean = pose(bar, scene_with(handles)), with = pose(stray, scene_with(handles));
  EXPECT_LT((clean.mesh.positions - with.mesh.positions.topRows(bar.positions.rows()))
                .cwiseAbs()
                .maxCoeff(),
            1e-9);
  EXPECT_EQ(with.report.status, Status::ok);
  EXPECT_TRUE(with.mesh.positions.allFinite());
}

TEST(Pose, BothSurfaceAlternativesGiveNearlyTheSamePose) {
  Scene scene = scene_with("  handles:\n    - fix: z<10%\n    - {move: z>90%, by: [20%, 0, 0]}\n");
  const Mesh bar = make_quad_bar({0.25, 0.25, 1}, {4, 4, 16});
  const Points a = pose(bar, scene).mesh.positions;
  scene.pose->surface = SurfaceKind::particle_gradients;
  const Points b = pose(bar, scene).mesh.positions;
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 0.02);
  EXPECT_GT((a - b).cwiseAbs().maxCoeff(), 1e-6);
}

/// Poses a bar over a field of `shape` keys.
void expect_pose(const std::string& shape) {
  const Scene scene = read_scene_text(
      fmt::format("shape: {{mesh: m.obj, particles: 150, {}}}\n"
                  "pose: {{handles: [{{fix: 'z<10%'}}, {{move: 'z>90%', by: [10%, 0, 0]}}]}}",
                  shape),
      "test", "");
  const PoseResult result = pose(make_quad_bar({0.25, 0.25, 1}, {4, 4, 16}), scene);
  EXPECT_TRUE(result.report.usable()) << shape;
  EXPECT_LT(result.handle_max_error, 0.01) << shape;
}

TEST(Pose, EveryBasisAndKernelPoses) {
  for (const char* basis : {"linear", "quadratic"})
    for (const KernelKind kernel : all_of<KernelKind>())
      expect_pose(fmt::format("basis: {}, kernel: {}", basis, enum_name(kernel)));
}

TEST(Pose, EveryGradientAndSupportPoses) {
  for (const GradientKind gradient : all_of<GradientKind>())
    for (const SupportKind supports : all_of<SupportKind>())
      expect_pose(
          fmt::format("gradient: {}, supports: {}", enum_name(gradient), enum_name(supports)));
}

TEST(Pose, SaysWhatIsWrongWithAShape) {
  const Scene scene = scene_with("  handles:\n    - fix: z<10%\n");
  Mesh open = make_quad_bar({1, 1, 1}, {1, 1, 1});
  open.face_starts.resize(4);
  open.face_vertices.resize(12);
  EXPECT_THROW(pose(open, scene), ShapeError);
  Mesh cloud = open;
  cloud.face_starts = {0};
  cloud.face_vertices.clear();
  EXPECT_THROW(pose(cloud, scene), ShapeError);
}

TEST(Pose, StopsWhereTheProgressSaysSo) {
  const Scene scene = scene_with("  handles:\n    - fix: z<10%\n");
  int calls = 0;
  EXPECT_THROW(pose(make_quad_bar({1, 1, 1}, {4, 4, 4}), scene,
                    [&](const std::string&, double) { return ++calls < 3; }),
               Interrupted);
  EXPECT_EQ(calls, 3);
}

TEST(Pose, BendsRealMeshes) {
  const std::filesystem::path data = std::filesystem::path(SUPPLE_SHARED_DATA) / "data";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "skipped: no shared data";
  for (const char* name : {"armadillo_1k.off", "stanford_bunny_3k.obj", "spot_3k.obj"}) {
    const Scene scene =
        scene_with("  handles:\n    - fix: y<8%\n    - {move: y>85%, by: [15%, -5%, 0]}\n");
    const PoseResult result = pose(read_mesh(data / name), scene);
    EXPECT_TRUE(result.report.usable()) << name;
    EXPECT_LT(result.handle_max_error, 0.02) << name;
    EXPECT_LT(std::abs(volume_change(result)), 0.05) << name;
    EXPECT_TRUE(result.mesh.positions.allFinite()) << name;
  }
}

TEST(Pose, AnOutlierDoesNotTellHowLargeACloudIs) {
  Mesh ball;
  ball.positions = points_on(make_icosphere(1, 4), 3000).positions;
  ball.positions.conservativeResize(3001, 3);
  ball.positions.row(3000) << 2000, 0, 0;
  const PoseResult result =
      pose(ball, scene_with("  handles:\n    - fix: z<10%\n    - {move: z>90%, by: [5%, 0, 0]}\n"));
  EXPECT_EQ(result.report.status, Status::ok);
  EXPECT_NEAR(result.volume_before, 4.0 / 3 * EIGEN_PI, 0.1);
  EXPECT_TRUE(result.mesh.positions.allFinite());
}

TEST(Pose, AVertexOfNoFaceMayLieAnywhere) {
  // With a slit, so that ways inside are asked for.
  Mesh fingers = make_two_fingers(0.05);
  const Index vertices = fingers.positions.rows();
  fingers.positions.conservativeResize(vertices + 1, 3);
  fingers.positions.row(vertices) << 1e12, -1e12, 3e11;
  const PoseResult result = pose(
      fingers, scene_with("  handles:\n    - fix: z<10%\n    - {move: z>95%, by: [2%, 0, 0]}\n"));
  EXPECT_TRUE(result.report.usable());
  EXPECT_TRUE(result.mesh.positions.allFinite());
}

TEST(Pose, FillsGapsOfPointCloudsOnly) {
  const std::string message = message_of<UsageError>([] {
    pose(make_box({1, 1, 1}), scene_with("  fill_gaps: true\n"));
  });
  EXPECT_NE(message.find("test:3:3: pose.fill_gaps: the shape has faces"), std::string::npos)
      << message;
}

/// A bar bent back on itself, over less width than it has.
std::string sharp_bend(const std::string& more) {
  return more +
         "  handles:\n    - fix: y<10%\n    - {move: y>90%, turn: {axis: [0, 0, 1], degrees: -180, "
         "about: [0.6, 2.5, 0.5]}}\n";
}

TEST(Pose, ABarrierKeepsAFoldFromTurningInsideOut) {
  const Mesh bar = make_quad_bar({1, 5, 1}, {8, 40, 8});
  const PoseResult without = pose(bar, scene_with(sharp_bend("")));
  const PoseResult with = pose(bar, scene_with(sharp_bend("  no_inversion: true\n")));
  EXPECT_LT(without.min_det_F, 0);
  EXPECT_GT(with.min_det_F, 0);
  EXPECT_TRUE(with.report.usable());
}

TEST(Pose, ABarrierStandsWhereVerticesBetweenWouldTurn) {
  const Mesh bar = make_quad_bar({1, 5, 1}, {8, 40, 8});
  const std::string squeezed =
      "  handles:\n    - fix: y<10%\n    - {move: y>90%, by: [0, -30%, 0]}\n";
  EXPECT_LT(pose(bar, scene_with(squeezed)).min_det_F, 0);
  const PoseResult with = pose(bar, scene_with("  no_inversion: true\n" + squeezed));
  EXPECT_GT(with.min_det_F, 0);
  EXPECT_TRUE(with.report.usable());
}

TEST(Pose, HardHandlesGoInShorterStepsWhereABarrierBlocksTheWay) {
  const PoseResult result =
      pose(make_quad_bar({1, 5, 1}, {4, 20, 4}),
           scene_with("  hard_handles: true\n  no_inversion: true\n  handles:\n    - fix: y<10%\n"
                      "    - {move: y>90%, by: [60%, -20%, 0]}\n"));
  EXPECT_EQ(result.report.status, Status::ok);
  EXPECT_GT(result.min_det_F, 0);
  EXPECT_LT(result.handle_max_error, 1e-9);
}

TEST(Pose, ABarrierGoesUpBehindTheRepairOfWhereThePoseStarts) {
  const Mesh bar = make_quad_bar({1, 5, 1}, {4, 20, 4});
  Points folded = bar.positions;  // back on itself in the middle
  for (Index i = 0; i < folded.rows(); ++i) {
    const double y = folded(i, 1);
    folded(i, 1) = y < 2 ? y : y < 3 ? 4 - y : y - 2;
  }
  const PoseResult result =
      pose(bar,
           scene_with("  no_inversion: true\n  from: folded.obj\n  handles:\n    - fix: y<10%\n"
                      "    - {move: y>90%, by: [0, 2, 0]}\n"),
           {}, {folded, {}});
  EXPECT_TRUE(result.report.usable());
  EXPECT_GT(result.min_det_F, 0.5);
}

TEST(Pose, HandlesFarAwayAreWalkedToInSoManyStepsAtMost) {
  const PoseResult result =
      pose(make_box({1, 1, 1}),
           scene_with("  handles:\n    - fix: y<10%\n    - {move: y>90%, by: [1e12, 0, 0]}\n"
                      "  most_seconds: 0.1\n"));
  EXPECT_EQ(result.report.status, Status::degraded);
  EXPECT_NE(result.report.find(ReasonCode::out_of_time), nullptr);
  EXPECT_TRUE(result.mesh.positions.allFinite());
}

TEST(Pose, WhatNoInversionCannotKeepFails) {
  const Mesh bar = make_quad_bar({1, 5, 1}, {8, 40, 8});
  Scene scene = scene_with(sharp_bend("  no_inversion: true\n"));
  scene.pose->handles[1].turn->about->at(0).value = 1.4;
  const PoseResult result = pose(bar, scene);
  EXPECT_EQ(result.report.usable(), result.min_det_F > 0);
}

TEST(Pose, ABarrierThatIsNotNeededChangesNothing) {
  const std::string handles =
      "  handles:\n    - fix: z<10%\n    - {move: z>90%, by: [0.5, 0, 0]}\n";
  const Mesh bar = make_bar({1, 1, 4}, {8, 8, 32});
  const PoseResult without = pose(bar, scene_with(handles));
  const PoseResult with = pose(bar, scene_with("  no_inversion: true\n" + handles));
  EXPECT_EQ(with.mesh.positions, without.mesh.positions);
}

}  // namespace
}  // namespace supple
