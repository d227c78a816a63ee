#include "modeler/domain/inside_detours.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "modeler/domain/beneath_surface.h"
#include "modeler/domain/inside_cover.h"
#include "modeler/domain/sample_particles.h"
#include "tests/support/fingers.h"
#include "tests/support/region_shapes.h"

namespace supple {
namespace {

constexpr double h = 2;

/// A mesh filled with particles about 1 apart.
struct Filled {
  explicit Filled(const Mesh& mesh, double spacing = 1) : region(region_of(mesh)) {
    ParticleSamplingOptions options;
    options.spacing = spacing;
    ParticleSampling sampling = sample_particles(region, options);
    particles = std::move(sampling.particles);
    graph = std::make_shared<const InsideGraph>(region, sampling.samples);
  }

  /// Particles alone at `places`.
  std::shared_ptr<const Detours> detours_from(const std::vector<Vec3>& places) const {
    Points positions(static_cast<Index>(places.size()), 3);
    for (std::size_t i = 0; i < places.size(); ++i)
      positions.row(static_cast<Index>(i)) = places[i].transpose();
    return InsideDetours(graph, positions, 1)
        .within(Eigen::VectorXd::Constant(positions.rows(), h), h);
  }

  const MeshRegion region;
  Particles particles;
  std::shared_ptr<const InsideGraph> graph;
};

double detour(const Detours& detours, int particle, const Vec3& x) {
  std::vector<Detour> found;
  detours.at(x, Derivatives::second, found);
  for (const Detour& d : found)
    if (d.particle == particle) return d.length;
  return 0;
}

TEST(InsideDetours, AreNoneInConvexShapes) {
  for (const Mesh& mesh : {make_icosphere(2, 3), make_bar({4, 2, 1}, {8, 4, 2})}) {
    const Filled body(mesh);
    const Eigen::VectorXd supports = Eigen::VectorXd::Constant(body.particles.size(), 3);
    EXPECT_EQ(InsideDetours(body.graph, body.particles.positions, 1).within(supports, 3), nullptr);
  }
}

TEST(InsideDetours, AreTheLongerWayRoundANotch) {
  const Filled block(make_notched_block());
  const Vec3 from(-0.6, 1, 1);
  const auto detours = block.detours_from({from});
  ASSERT_NE(detours, nullptr);
  for (const double z : {0.4, 0.7, 1.0}) {
    const Vec3 x(0.6, 1, z);
    const double way = (Vec3(-0.1, 1, 0) - from).norm() + 0.2 + (Vec3(0.1, 1, 0) - x).norm();
    // It turns at seats, which are half a spacing apart.
    EXPECT_NEAR(detour(*detours, 0, x), way - (x - from).norm() + 0.25, 0.25) << z;
  }
  EXPECT_LE(detour(*detours, 0, {-0.6, 1.2, 0.3}), 0.01);
  EXPECT_EQ(detour(*detours, 0, {-1.5, 0.5, -1}), 0);
}

TEST(InsideDetours, ReachNoOtherComponent) {
  const Mesh box = make_bar({2, 2, 2}, {2, 2, 2});
  const Mesh beside = mapped(box, [](const Vec3& x) { return Vec3(x + Vec3(2.05, 0, 0)); });
  const Filled boxes(joined(box, beside));
  const auto detours = boxes.detours_from({{1.9, 1, 1}, {2.15, 1, 1}});
  ASSERT_NE(detours, nullptr);
  EXPECT_EQ(detour(*detours, 0, {1.5, 1.2, 0.8}), 0);
  EXPECT_GE(detour(*detours, 0, {2.2, 1.2, 0.8}), h);
  EXPECT_EQ(detour(*detours, 1, {2.4, 1.2, 0.8}), 0);
  EXPECT_GE(detour(*detours, 1, {1.8, 1.2, 0.8}), h);
}

TEST(InsideDetours, KnowTheSideOfVerticesWhereWallsTouch) {
  for (const double gap : {0.0, 0.2}) {
    const Mesh fingers = make_two_fingers(gap);
    const Triangles triangles = triangles_of(fingers);
    const Filled body(fingers);
    const auto detours = body.detours_from({{-1, 1, 5}, {1, 1, 5}});
    ASSERT_NE(detours, nullptr);
    const Points vertices = vertices_beneath(fingers.positions, triangles, 1e-9);
    int asked = 0;
    for (Index t = 0; t < triangles.rows(); ++t) {
      // A triangle with a corner off the wall tells which finger its corners belong to.
      Vec3 middle = Vec3::Zero();
      for (int k = 0; k < 3; ++k) middle += fingers.positions.row(triangles(t, k)).transpose() / 3;
      if (middle.z() < 4 || middle.z() > 6 || std::abs(middle.x()) < 0.15) continue;
      for (int k = 0; k < 3; ++k) {
        const Vec3 x = vertices.row(triangles(t, k));
        const int own = middle.x() < 0 ? 0 : 1;
        EXPECT_EQ(detour(*detours, own, x), 0) << x.transpose();
        if ((x - Vec3(own == 0 ? 1 : -1, 1, 5)).norm() < h) {  // else it is not reached at all
          EXPECT_GE(detour(*detours, 1 - own, x), h) << x.transpose();
        }
        ++asked;
      }
    }
    EXPECT_GT(asked, 50);
  }
}

TEST(InsideCover, GivesEachComponentAParticle) {
  const Mesh box = make_bar({4, 4, 4}, {2, 2, 2});
  const Mesh crumb =
      mapped(make_icosphere(0.1, 1), [](const Vec3& x) { return Vec3(x + Vec3(4.3, 2, 2)); });
  Filled body(joined(box, crumb));
  Particles particles = body.particles;
  const double volume = particles.volumes.sum();
  const int added = cover_inside(*body.graph, particles).added;
  EXPECT_EQ(particles.size(), body.particles.size() + added);
  const Eigen::VectorXd distances =
      (particles.positions.rowwise() - Eigen::RowVector3d(4.3, 2, 2)).rowwise().norm();
  Index nearest;
  EXPECT_LE(distances.minCoeff(&nearest), 0.1);
  EXPECT_NEAR(particles.volumes.sum(), volume, 1e-9 * volume);
  EXPECT_LT(particles.volumes[nearest], 0.05);
}

TEST(InsideCover, LeavesWhatIsReachedAlone) {
  Filled body(make_icosphere(2, 3));
  Particles particles = body.particles;
  EXPECT_EQ(cover_inside(*body.graph, particles).added, 0);
  EXPECT_TRUE(particles.volumes == body.particles.volumes);
}

TEST(InsideCover, ReachesAFingerBesideOneThatGotTheParticles) {
  Filled body(make_two_fingers(0.05));
  // All particles of one finger are taken away.
  Particles particles = body.particles;
  std::vector<Index> kept;
  for (Index i = 0; i < particles.size(); ++i)
    if (particles.positions(i, 0) < 0 || particles.positions(i, 2) < 0) kept.push_back(i);
  particles.positions = body.particles.positions(kept, Eigen::all);
  particles.volumes = body.particles.volumes(kept);
  EXPECT_GE(cover_inside(*body.graph, particles).added, 4);
  for (double z = 0.5; z < 8; z += 0.5) {
    double nearest = 100;
    for (Index i = 0; i < particles.size(); ++i)
      if (particles.positions(i, 0) > 0)
        nearest =
            std::min(nearest, (particles.positions.row(i) - Eigen::RowVector3d(1, 1, z)).norm());
    EXPECT_LT(nearest, 1.8) << z;
  }
}

}  // namespace
}  // namespace supple
