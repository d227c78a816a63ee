#include "solver/field/samples.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include "solver/core/parallel.h"
#include "solver/field/blocked_field.h"
#include "solver/field/spatial_order.h"
#include "solver/field/supports.h"
#include "tests/support/lattice.h"

namespace supple {
namespace {

struct Body {
  Particles particles = lattice_particles({1, 0.8, 0.6}, 0.15);
  MovingLeastSquares<3> field{
      particles.positions,
      choose_supports(particles.positions, particles.spacing, particles.positions).radii};
};

Points points_in_body(Index count) {
  Random random(2);
  Points points(count, 3);
  for (Index i = 0; i < count; ++i)
    points.row(i) << random.uniform(0, 1), random.uniform(0, 0.8), random.uniform(0, 0.6);
  return points;
}

/// Displacements of the affine map x ↦ A x + b.
Points affine(const Points& x, const Mat3& A, const Vec3& b) {
  return (x * A.transpose()).rowwise() + b.transpose() - x;
}

Points bend(const Points& x) {
  Points u(x.rows(), 3);
  for (Index i = 0; i < x.rows(); ++i) {
    const double angle = 0.8 * x(i, 0);
    u.row(i) << std::sin(angle) * (1 - x(i, 2)) - x(i, 0), 0.1 * x(i, 0) * x(i, 1),
        (1 - std::cos(angle)) * (1 - x(i, 2));
  }
  return u;
}

TEST(Samples, ReproduceAffineMapsAlsoOutsideAllSupports) {
  const Body body;
  Points points = points_in_body(300);
  points.row(7) << 9, -4, 3;  // far outside
  const Samples samples = sample_field(body.field, points, SampleContent::values_and_gradients);
  EXPECT_EQ(samples.uncovered, 1);
  EXPECT_EQ(samples.rank_lost, 0);
  Mat3 A;
  A << 1.1, 0.3, 0, -0.2, 0.9, 0.1, 0.05, 0, 1.3;
  const Points u = affine(body.particles.positions, A, {1, 2, 3});
  for (Index k = 0; k < points.rows(); ++k) {
    const Vec3 expected = A * points.row(k).transpose() + Vec3(1, 2, 3);
    EXPECT_LT((samples.position(k, u) - expected).norm(), 1e-11);
    EXPECT_LT((samples.deformation_gradient(k, u) - A).norm(), 1e-10);
  }
}

TEST(Samples, AreTheSameForEveryNumberOfThreads) {
  const Body body;
  const Points points = points_in_body(2000);
  const auto values = [&](int threads) {
    const ThreadLimit limit(threads);
    return sample_field(body.field, points, SampleContent::values).values;
  };
  EXPECT_EQ(values(1), values(3));
}

TEST(Samples, CountInvertedPoints) {
  const Body body;
  const Samples samples =
      sample_field(body.field, body.particles.positions, SampleContent::values_and_gradients);
  const Mat3 mirror = Vec3(-1, 1, 1).asDiagonal();
  const InversionCount count =
      count_inversions(samples, affine(body.particles.positions, mirror, Vec3::Zero()));
  EXPECT_EQ(count.inverted, body.particles.size());
  EXPECT_NEAR(count.min_det_F, -1, 1e-9);
}

/// A body pressed to a thickness that lets one direction fade, or nothing of it.
Body pressed_body(double flatness) {
  Body body;
  body.particles.positions.col(2) *= flatness;
  body.field = {body.particles.positions, body.field.supports()};
  return body;
}

TEST(Samples, CarryTheirSpansPartOfAffineMaps) {
  long fading = 0;
  for (const double flatness : {0.0, 4e-3, 6e-3, 8e-3, 1e-2}) {
    const Body body = pressed_body(flatness);
    Points points = points_in_body(200);
    points.col(2) *= 0.1;  // off the plane, too
    const Samples samples = sample_field(body.field, points, SampleContent::values_and_gradients);
    for (const Samples::ShortSpan& at : samples.short_spans) {
      Mat3 sum = Mat3::Zero();
      for (int entry = samples.row_begin(at.sample); entry < samples.row_end(at.sample); ++entry)
        sum += body.particles.positions.row(samples.particles[std::size_t(entry)]).transpose() *
               samples.gradients[std::size_t(entry)].transpose();
      EXPECT_LT((sum - (Mat3::Identity() - at.span.missing())).norm(), 1e-10);
      EXPECT_GT(at.span.axes.determinant(), 0.99);
      if (at.span.shares[2] > 0.01) ++fading;
    }
    EXPECT_EQ(samples.short_spans.size() == 200, flatness < 6e-3);
  }
  EXPECT_GT(fading, 100);
}

TEST(Samples, PassSmoothlyFromFullToShortSpans) {
  // F of one bend, at one point, while the body is pressed flat through the whole window.
  const Vec3 x(0.5, 0.4, 0);
  Mat3 last = Mat3::Zero();
  double most = 0, least_share = 1, greatest_share = 0;
  for (double flatness = 2e-2; flatness > 1e-3; flatness *= 0.995) {
    const Body body = pressed_body(flatness);
    const Samples samples =
        sample_field(body.field, Points(x.transpose()), SampleContent::values_and_gradients);
    const Mat3 F = samples.deformation_gradient(0, bend(body.particles.positions));
    if (!last.isZero()) most = std::max(most, (F - last).norm());
    last = F;
    const double share = samples.short_spans.empty() ? 1 : samples.short_spans[0].span.shares[2];
    least_share = std::min(least_share, share);
    greatest_share = std::max(greatest_share, share);
  }
  EXPECT_EQ(greatest_share, 1);
  EXPECT_LT(least_share, 1e-3);
  EXPECT_LT(most, 0.02);
}

TEST(Samples, LetAPlaneOfParticlesTurnWithoutInversion) {
  const Body body = pressed_body(0);
  const Samples samples =
      sample_field(body.field, body.particles.positions, SampleContent::values_and_gradients);
  const Mat3 R = Eigen::AngleAxisd(EIGEN_PI, Vec3::UnitX()).toRotationMatrix();
  const Points u = affine(body.particles.positions, 1.1 * R, Vec3::Zero());
  EXPECT_EQ(count_inversions(samples, u).inverted, 0);
  EXPECT_NEAR(count_inversions(samples, u).min_det_F, 1.21, 1e-10);
}

class BlockedFieldTest : public testing::Test {
 protected:
  Body body;
  Points points = points_in_body(1003);  // not a multiple of the lanes
  BlockedField blocked{body.field, points};
};

TEST_F(BlockedFieldTest, AgreesWithThePlainRows) {
  const Samples samples = sample_field(body.field, points, SampleContent::values_and_gradients);
  const Points u = bend(body.particles.positions);
  Points positions;
  std::vector<Mat3> gradients;
  blocked.displace({}, u.cast<float>(), positions);
  blocked.displace_gradients({}, u.cast<float>(), gradients);
  for (Index k = 0; k < points.rows(); ++k) {
    EXPECT_LT((positions.row(k).transpose() - samples.position(k, u)).norm(), 1e-6);
    EXPECT_LT((gradients[std::size_t(k)] - samples.deformation_gradient(k, u)).norm(), 1e-4);
  }
}

TEST_F(BlockedFieldTest, SinglePrecisionIsAsGoodAsItsNumbers) {
  const RigidMotion rigid{Eigen::AngleAxisd(2, Vec3(1, 2, 3).normalized()).toRotationMatrix(),
                          Vec3(1, 2, 3)};
  const ParticleValues<3> d = bend(body.particles.positions).cast<float>();
  Points exact;
  FloatPoints rounded;
  blocked.displace(rigid, d, exact);
  blocked.displace(rigid, d, rounded);
  EXPECT_LT((rounded.cast<double>() - exact).cwiseAbs().maxCoeff(), 1e-6);
}

/// Laid out in their own order or by place.
TEST_F(BlockedFieldTest, DoesNotDependOnTheOrderOfThePoints) {
  const std::vector<int> order = spatial_order(points);
  const BlockedField coherent(body.field, points(order, Eigen::all));
  const ParticleValues<3> d = bend(body.particles.positions).cast<float>();
  Points here, there;
  blocked.displace({}, d, here);
  coherent.displace({}, d, there);
  EXPECT_LT((here(order, Eigen::all) - there).cwiseAbs().maxCoeff(), 1e-7);
}

TEST_F(BlockedFieldTest, CompletesGradientsOfAPlaneOfParticles) {
  const Body flat = pressed_body(0);
  points.col(2) *= 0.1;
  const BlockedField vertices(flat.field, points);
  const Samples samples = sample_field(flat.field, points, SampleContent::values_and_gradients);
  const RigidMotion rigid{Eigen::AngleAxisd(2, Vec3(1, 2, 3).normalized()).toRotationMatrix(),
                          Vec3(1, 2, 3)};
  const Points small = 0.1 * bend(flat.particles.positions);
  Points u = small;
  for (Index j = 0; j < u.rows(); ++j)
    u.row(j) += rigid(flat.particles.positions.row(j).transpose()).transpose() -
                flat.particles.positions.row(j);
  std::vector<Mat3> gradients;
  vertices.displace_gradients(rigid, small.cast<float>(), gradients);
  for (Index k = 0; k < points.rows(); ++k)
    EXPECT_LT((gradients[std::size_t(k)] - samples.deformation_gradient(k, u)).norm(), 1e-4);
}

TEST_F(BlockedFieldTest, KeepsLargeRigidMotionsInDoublePrecision) {
  const RigidMotion rigid{Eigen::AngleAxisd(2, Vec3::UnitY()).toRotationMatrix(),
                          Vec3(1e6, -1e6, 1)};
  Points positions;
  blocked.displace(rigid, ParticleValues<3>::Zero(body.particles.size(), 3), positions);
  for (Index k = 0; k < points.rows(); ++k)
    EXPECT_LT((positions.row(k).transpose() - rigid(points.row(k).transpose())).norm(), 1e-9);
}

TEST_F(BlockedFieldTest, BlendsOneAffineMapIntoItself) {
  Mat3 A;
  A << 0.1, 0.3, 0, -0.2, -0.1, 0.1, 0.05, 0, 0.3;
  ParticleValues<12> maps(body.particles.size(), 12);
  for (Index j = 0; j < maps.rows(); ++j)
    maps.row(j) << 0.5f, -0.25f, 0.125f, A.row(0).cast<float>(), A.row(1).cast<float>(),
        A.row(2).cast<float>();
  MovingLeastSquares<3> weights(body.particles.positions, body.field.supports(),
                                {BasisOrder::constant});
  const BlockedField blend(weights, points);
  Points positions;
  std::vector<Mat3> gradients;
  blend.blend({}, maps, positions);
  blend.blend_gradients({}, maps, gradients);
  for (Index k = 0; k < points.rows(); ++k) {
    const Vec3 x = points.row(k).transpose();
    EXPECT_LT((positions.row(k).transpose() - (x + A * x + Vec3(0.5, -0.25, 0.125))).norm(), 1e-6);
    EXPECT_LT((gradients[std::size_t(k)] - (Mat3::Identity() + A)).norm(), 1e-6);
  }
}

TEST_F(BlockedFieldTest, PadsLittleAndIsTheSameForEveryNumberOfThreads) {
  Points dense = points_in_body(20000);
  dense.col(2).setConstant(0.6);  // a surface
  const BlockedField many(body.field, dense);
  EXPECT_LT(static_cast<double>(many.padded_entries()), 1.5 * static_cast<double>(many.entries()));
  const ParticleValues<3> u = bend(body.particles.positions).cast<float>();
  Points one, several;
  {
    const ThreadLimit limit(1);
    BlockedField(body.field, points).displace({}, u, one);
  }
  BlockedField(body.field, points).displace({}, u, several);
  EXPECT_EQ(one, several);
}

}  // namespace
}  // namespace supple
