// Every way to place particles with every quadrature keeps what a pose promises.

#include <Eigen/Geometry>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io/scene/scene_reader.h"
#include "modeler/pose/pose.h"
#include "modeler/pose/solid.h"
#include "solver/energy/energy_sum.h"
#include "solver/energy/rigidity.h"
#include "solver/field/samples.h"
#include "tests/support/fingers.h"
#include "tests/support/shapes.h"

namespace supple {
namespace {

struct Choice {
  PlacementKind placement;
  QuadratureKind quadrature;
};

class Placement : public testing::TestWithParam<Choice> {
 protected:
  static Scene scene_with(const std::string& handles, int particles = 200) {
    Scene scene = read_scene_text(
        fmt::format("shape: {{mesh: bar.obj, particles: {}}}\npose:\n  handles:\n{}", particles,
                    handles),
        "test", "");
    scene.shape.placement = GetParam().placement;
    scene.shape.quadrature = GetParam().quadrature;
    return scene;
  }
};

Mesh slim_bar() {
  return make_quad_bar({0.25, 0.25, 1}, {4, 4, 16});
}

double volume_change(const PoseResult& result) {
  return result.volume_after / result.volume_before - 1;
}

double diagonal_of(const Mesh& mesh) {
  return bounding_box(mesh.positions).diagonal();
}

TEST_P(Placement, RigidMotionsStayRigid) {
  std::string handles;
  for (const char* end : {"z<10%", "z>90%"})
    handles += fmt::format(
        "    - {{move: {}, by: [3, 1, -2], turn: {{axis: [1, 2, 3], degrees: 90, "
        "about: [0, 0, 0]}}}}\n",
        end);
  const Mesh bar = slim_bar();
  const Mat3 R = Eigen::AngleAxisd(EIGEN_PI / 2, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Points wanted = (bar.positions * R.transpose()).rowwise() + Eigen::RowVector3d(3, 1, -2);
  const PoseResult result = pose(bar, scene_with(handles));
  EXPECT_LT((result.mesh.positions - wanted).rowwise().norm().maxCoeff(), 1e-6 * diagonal_of(bar));
}

/// The box of Adams & Wicke's Fig. 13.
TEST_P(Placement, TheVolumeTermKeepsTheShearedBox) {
  const PoseResult result =
      pose(make_quad_bar({1, 1, 2}, {8, 8, 16}),
           scene_with("    - fix: z<2%\n    - {move: z>98%, by: [0.5, 0, 0]}\n"));
  EXPECT_EQ(result.report.status, Status::ok);
  EXPECT_LT(std::abs(volume_change(result)), 0.02);
  EXPECT_LT(result.handle_max_error, 0.01);
}

TEST_P(Placement, ABentBarStaysUsable) {
  const PoseResult result =
      pose(slim_bar(), scene_with("    - fix: z<10%\n    - {move: z>90%, by: [20%, 0, -5%], turn: "
                                  "{axis: [0, 1, 0], degrees: 60}}\n"));
  EXPECT_EQ(result.report.status, Status::ok);
  EXPECT_LT(std::abs(volume_change(result)), 0.03);
  EXPECT_LT(result.handle_max_error, 0.01);
  EXPECT_GT(result.min_det_F, 0.1);
}

TEST_P(Placement, ASurfaceStretchedAffinelyStretchesTheInsideSo) {
  const PoseResult result =
      pose(slim_bar(), scene_with("    - {move: z>-1, scale: [1, 1, 1.2]}\n"));
  Points wanted = result.particles.positions;
  wanted.col(2) = 0.5 + 1.2 * (wanted.col(2).array() - 0.5);
  const Points found = result.particles.positions + result.displacements;
  const double miss = (found - wanted).rowwise().norm().maxCoeff() / diagonal_of(result.rest);
  // Sums at particles pull at them even under constant stress: see below.
  EXPECT_LT(miss, GetParam().quadrature == QuadratureKind::cells ? 0.005 : 0.012);
}

INSTANTIATE_TEST_SUITE_P(All, Placement,
                         testing::Values(Choice{PlacementKind::even, QuadratureKind::automatic},
                                         Choice{PlacementKind::even, QuadratureKind::particles},
                                         Choice{PlacementKind::even, QuadratureKind::cells},
                                         Choice{PlacementKind::octree, QuadratureKind::automatic},
                                         Choice{PlacementKind::octree, QuadratureKind::particles},
                                         Choice{PlacementKind::octree, QuadratureKind::cells}),
                         [](const auto& info) {
                           return fmt::format("{}_{}", enum_name(info.param.placement),
                                              enum_name(info.param.quadrature));
                         });

Solid solid_of(const Mesh& mesh, PlacementKind placement, int particles) {
  ShapeSpec spec;
  spec.particles = particles;
  spec.placement = placement;
  Solid solid(mesh, spec);
  solid.choose_particle_supports(spec);
  return solid;
}

Samples samples_of(const Solid& solid, const Points& points) {
  const MovingLeastSquares<3> field(solid.particles().positions, solid.particles().supports);
  return sample_field(field, points, SampleContent::values_and_gradients);
}

TEST(SupportScale, MultipliesTheAutomaticSupports) {
  for (const double scale : {0.8, 1.5}) {
    ShapeSpec spec;
    spec.particles = 100;
    spec.support_scale = scale;
    Solid solid(slim_bar(), spec);
    solid.choose_particle_supports(spec);
    const Eigen::VectorXd usual =
        solid_of(slim_bar(), PlacementKind::even, 100).particles().supports;
    EXPECT_LT((solid.particles().supports - scale * usual).norm(), 1e-12 * usual.norm());
  }
}

TEST(SupportScale, WiderSupportsReachByTheWayInsideToo) {
  const Mesh fingers = make_two_fingers(0.14);
  const PoseResult result =
      pose(fingers, read_scene_text("shape: {mesh: fingers.obj, spacing: 0.7, support_scale: 1.4}\n"
                                    "pose:\n"
                                    "  weights: {handles: 1e6}\n"
                                    "  handles:\n"
                                    "    - fix: z<2.6\n"
                                    "    - {move: z>7.6 and x<0, by: [-30%, 0, 0]}\n",
                                    "test", {}));
  double way = 0;
  for (Index i = 0; i < fingers.positions.rows(); ++i)
    if (fingers.positions(i, 0) > 0 && fingers.positions(i, 2) > 0)
      way = std::max(way, (result.mesh.positions.row(i) - fingers.positions.row(i)).norm());
  const double pull = 0.3 * bounding_box(fingers.positions).diagonal();
  EXPECT_LT(way, 0.01 * pull) << "the other finger stays";
}

TEST(CellQuadratureOfSolids, ListsTheParticlesFirstWithoutVolume) {
  for (const PlacementKind placement : {PlacementKind::even, PlacementKind::octree}) {
    const Solid solid = solid_of(slim_bar(), placement, 100);
    const Quadrature quadrature = solid.quadrature(QuadratureKind::cells);
    const Index n = solid.particles().size();
    EXPECT_EQ(Points(quadrature.points.topRows(n)), solid.particles().positions);
    EXPECT_TRUE(quadrature.volumes.head(n).isZero(0));
    EXPECT_GT(quadrature.volumes.tail(quadrature.volumes.size() - n).minCoeff(), 0);
    EXPECT_NEAR(quadrature.volumes.sum(), solid.region().volume(), 1e-12);
    EXPECT_LT(quadrature.points.rows(), 16 * n);
  }
}

/// Energy per volume of a bar bent to a quarter of a circle.
double bending_energy(const Solid& solid, const Quadrature& quadrature) {
  const Samples samples = samples_of(solid, quadrature.points);
  const Eigen::VectorXd shares = quadrature.volumes / quadrature.volumes.sum();
  const RigidityEnergy rigidity;
  EnergySum sum(solid.particles().size());
  sum.add(rigidity, samples, shares, 1);
  Points u = solid.particles().positions;
  for (Index i = 0; i < u.rows(); ++i) {
    const Vec3 x = u.row(i);
    const double angle = 1.5 * x[2], radius = 1 / 1.5 - x[0];
    u.row(i) =
        Eigen::RowVector3d(1 / 1.5 - radius * std::cos(angle), x[1], radius * std::sin(angle)) -
        x.transpose();
  }
  return sum.evaluate(u);
}

TEST(CellQuadratureOfSolids, SumsTheEnergyOfABentBar) {
  for (const PlacementKind placement : {PlacementKind::even, PlacementKind::octree}) {
    const Solid solid = solid_of(slim_bar(), placement, 200);
    OctreeOptions fine;
    fine.width = 0.4 * solid.particles().spacing;
    const double exact =
        bending_energy(solid, cell_quadrature(solid.region(), {solid.region(), fine}));
    const double found = bending_energy(solid, solid.quadrature(QuadratureKind::cells));
    const double automatic = bending_energy(solid, solid.quadrature(QuadratureKind::automatic));
    std::printf("%s: energy off by %+.2f %% in cells, %+.2f %% by auto\n",
                std::string(enum_name(placement)).c_str(), 100 * (found / exact - 1),
                100 * (automatic / exact - 1));
    EXPECT_NEAR(found / exact, 1, 0.03);
  }
}

/// ∫ ∇φ_i dV = 0 where φ_i vanishes at the boundary: without it a constant stress would pull at
/// particles inside. Mean of |Σ V_k ∇φ_i| / Σ V_k |∇φ_i| over such particles.
double patch_residual(const Solid& solid, QuadratureKind kind) {
  const Quadrature quadrature = solid.quadrature(kind);
  const Samples samples = samples_of(solid, quadrature.points);
  const auto count = static_cast<std::size_t>(solid.particles().size());
  std::vector<Vec3> sums(count, Vec3::Zero());
  std::vector<double> sizes(count, 0);
  for (Index k = 0; k < samples.size(); ++k)
    for (int at = samples.row_begin(k); at < samples.row_end(k); ++at) {
      const auto i = static_cast<std::size_t>(samples.particles[static_cast<std::size_t>(at)]);
      const Vec3 part = quadrature.volumes[k] * samples.gradients[static_cast<std::size_t>(at)];
      sums[i] += part;
      sizes[i] += part.norm();
    }
  double sum = 0;
  int inside = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 x = solid.particles().positions.row(static_cast<Index>(i));
    if (-solid.region().signed_distance(x) < solid.particles().supports[static_cast<Index>(i)])
      continue;
    sum += sums[i].norm() / sizes[i];
    ++inside;
  }
  EXPECT_GT(inside, 0);
  return sum / inside;
}

TEST(CellQuadratureOfSolids, HardlyPullsAtParticlesInsideUnderConstantStress) {
  const Solid solid = solid_of(make_bar({1, 1, 1}, {4, 4, 4}), PlacementKind::even, 400);
  const double cells = patch_residual(solid, QuadratureKind::cells);
  const double automatic = patch_residual(solid, QuadratureKind::automatic);
  std::printf("patch residual: %.4f in cells, %.4f by auto\n", cells, automatic);
  EXPECT_LT(cells, 0.015);
  EXPECT_LT(cells, 0.4 * automatic);
}

}  // namespace
}  // namespace supple
