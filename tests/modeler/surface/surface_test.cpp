#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include "modeler/surface/deform_mesh.h"
#include "modeler/surface/surface_embedding.h"
#include "solver/field/supports.h"
#include "tests/support/lattice.h"
#include "tests/support/shapes.h"

namespace supple {
namespace {

const Vec3 size(1, 0.8, 0.6);

/// A box and the field of particles inside it.
struct Body {
  Mesh mesh = make_quad_bar(size, {10, 8, 6});
  Particles particles = lattice_particles(size, 0.12);
  MovingLeastSquares<3> field{
      particles.positions,
      choose_supports(particles.positions, particles.spacing, mesh.positions).radii};
  Samples at_particles =
      sample_field(field, particles.positions, SampleContent::values_and_gradients);

  SurfaceEmbedding embed(SurfaceKind kind) const {
    return {field, at_particles, mesh.positions, kind};
  }
};

Points mapped(const Points& x, const Mat3& A, const Vec3& b) {
  return (x * A.transpose()).rowwise() + b.transpose();
}

class BothAlternatives : public testing::TestWithParam<SurfaceKind> {
 protected:
  Body body;
  SurfaceEmbedding embedding = body.embed(GetParam());

  DeformedSurface deform(const Points& u) const {
    return embedding.deform(u, body.particles.volumes);
  }
};

TEST_P(BothAlternatives, LeaveAShapeAtRestToTheLastBit) {
  const DeformedSurface rest = deform(Points::Zero(body.particles.size(), 3));
  EXPECT_EQ(rest.positions, body.mesh.positions);
  for (const Mat3& F : rest.gradients) EXPECT_EQ(F, Mat3::Identity());
}

TEST_P(BothAlternatives, FollowRigidMotionsFarAway) {
  const Mat3 R = Eigen::AngleAxisd(3, Vec3(1, 2, 2).normalized()).toRotationMatrix();
  const Vec3 t(1000, -500, 3);
  const Points& x = body.particles.positions;
  const DeformedSurface moved = deform(mapped(x, R, t) - x);
  EXPECT_LT((moved.positions - mapped(body.mesh.positions, R, t)).cwiseAbs().maxCoeff(), 1e-8);
  for (const Mat3& F : moved.gradients) EXPECT_LT((F - R).norm(), 1e-8);
}

TEST_P(BothAlternatives, ReproduceAffineMaps) {
  Mat3 A;
  A << 1.2, 0.3, 0, -0.1, 0.9, 0.2, 0.1, 0, 1.1;
  const Points& x = body.particles.positions;
  const DeformedSurface moved = deform(mapped(x, A, {1, 2, 3}) - x);
  EXPECT_LT((moved.positions - mapped(body.mesh.positions, A, {1, 2, 3})).cwiseAbs().maxCoeff(),
            2e-6);
  for (const Mat3& F : moved.gradients) EXPECT_LT((F - A).norm(), 2e-5);
}

INSTANTIATE_TEST_SUITE_P(Surface, BothAlternatives,
                         testing::Values(SurfaceKind::field, SurfaceKind::particle_gradients),
                         [](const auto& info) { return std::string(enum_name(info.param)); });

TEST(SurfaceEmbedding, AlternativesAgreeOnASmoothBend) {
  const Body body;
  Points u(body.particles.size(), 3);
  for (Index i = 0; i < u.rows(); ++i) {
    const Vec3 x = body.particles.positions.row(i).transpose();
    u.row(i) << 0, 0, 0.2 * x[0] * x[0];
  }
  const Points a = body.embed(SurfaceKind::field).deform(u, body.particles.volumes).positions;
  const Points b =
      body.embed(SurfaceKind::particle_gradients).deform(u, body.particles.volumes).positions;
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 0.01);
  EXPECT_GT((a - b).cwiseAbs().maxCoeff(), 1e-6);  // they are two alternatives
}

TEST(CarryNormal, StaysPerpendicularToCarriedTangents) {
  Mat3 F;
  F << 1.2, 0.3, 0, -0.1, 0.9, 0.2, 0.1, 0, 1.1;
  const Vec3 t1 = Vec3(1, 2, 0.5).normalized();
  const Vec3 t2 = t1.cross(Vec3(0.3, -1, 2)).normalized();
  const Vec3 n = t1.cross(t2).normalized();
  const Vec3 carried = carry_normal(F, n);
  EXPECT_NEAR(carried.norm(), 1, 1e-12);
  EXPECT_NEAR(carried.dot(F * t1), 0, 1e-12);
  EXPECT_NEAR(carried.dot(F * t2), 0, 1e-12);
  EXPECT_GT(carried.dot((F * t1).cross(F * t2)), 0);
}

TEST(CarryRadius, GrowsWithTheRootOfTheDiscsArea) {
  const Mat3 stretch = Vec3(4, 9, 16).asDiagonal();
  EXPECT_NEAR(carry_radius(stretch, Vec3::UnitX(), 0.5), 0.5 * 12, 1e-12);
  EXPECT_NEAR(carry_radius(stretch, 7 * Vec3::UnitZ(), 0.5), 0.5 * 6, 1e-12);
  EXPECT_NEAR(carry_radius(stretch, Vec3::Zero(), 0.5), 0.5 * std::cbrt(576), 1e-12);
  const Mat3 turn = Eigen::AngleAxisd(2, Vec3(1, 2, 2).normalized()).toRotationMatrix();
  EXPECT_NEAR(carry_radius(turn * 3, Vec3(1, -1, 2).normalized(), 1), 3, 1e-12);
  // The area of the parallelogram that two carried tangents span.
  Mat3 F;
  F << 1.2, 0.3, 0, -0.1, 0.9, 0.2, 0.1, 0, 1.1;
  const Vec3 t1 = Vec3(1, 2, 0.5).normalized(), t2 = t1.cross(Vec3(0.3, -1, 2)).normalized();
  EXPECT_NEAR(carry_radius(F, t1.cross(t2), 1), std::sqrt((F * t1).cross(F * t2).norm()), 1e-12);
}

TEST(DeformMesh, CarriesTheRadiiOfPoints) {
  Mesh cloud;
  cloud.positions = Points::Zero(2, 3);
  cloud.radii = Eigen::Vector2d(1, 0.5);
  DeformedSurface surface;
  surface.positions = cloud.positions;
  surface.gradients.assign(2, Vec3(1, 4, 16).asDiagonal());
  EXPECT_LT((deform_mesh(cloud, surface).radii - Eigen::Vector2d(4, 2)).norm(), 1e-12);
  cloud.normals.values.resize(2, 3);
  cloud.normals.values << 0, 0, 1, 1, 0, 0;
  EXPECT_LT((deform_mesh(cloud, surface).radii - Eigen::Vector2d(2, 4)).norm(), 1e-12);
}

/// A box whose faces have one normal each, shared by all their corners.
Mesh box_with_face_normals() {
  Mesh mesh = make_quad_bar(size, {4, 4, 4});
  mesh.normals.values.resize(6, 3);
  mesh.normals.values << 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1;
  for (int face = 0; face < mesh.face_count(); ++face) {
    const int* corner = &mesh.face_vertices[std::size_t(mesh.face_starts[std::size_t(face)])];
    const Vec3 a = mesh.positions.row(corner[0]), b = mesh.positions.row(corner[1]);
    const Vec3 normal = (b - a).cross(Vec3(mesh.positions.row(corner[2])) - b).normalized();
    Index row = 0;
    (mesh.normals.values * normal).maxCoeff(&row);
    mesh.normals.corners.insert(mesh.normals.corners.end(), 4, static_cast<int>(row));
  }
  return mesh;
}

TEST(DeformMesh, KeepsSharedNormalsAtRestAndSplitsThemInABend) {
  const Mesh mesh = box_with_face_normals();
  DeformedSurface surface;
  surface.positions = mesh.positions;
  surface.gradients.assign(std::size_t(mesh.positions.rows()), Mat3::Identity());
  const Mesh rest = deform_mesh(mesh, surface);
  EXPECT_EQ(rest.normals.values, mesh.normals.values);
  EXPECT_EQ(rest.normals.corners, mesh.normals.corners);

  for (Index i = 0; i < mesh.positions.rows(); ++i)
    surface.gradients[std::size_t(i)] =
        Eigen::AngleAxisd(mesh.positions(i, 2), Vec3::UnitX()).toRotationMatrix();
  const Mesh bent = deform_mesh(mesh, surface);
  ASSERT_EQ(bent.normals.corners.size(), mesh.normals.corners.size());
  for (std::size_t corner = 0; corner < bent.normals.corners.size(); ++corner) {
    const Vec3 before = mesh.normals.values.row(mesh.normals.corners[corner]);
    const Vec3 after = bent.normals.values.row(bent.normals.corners[corner]);
    const Mat3& R = surface.gradients[std::size_t(mesh.face_vertices[corner])];
    EXPECT_LT((after - R * before).norm(), 1e-6);
  }
}

}  // namespace
}  // namespace supple
