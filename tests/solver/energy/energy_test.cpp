// One battery for every energy: adding an energy adds one line to `all_energies`.

#include "solver/energy/energy.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>

#include <gtest/gtest.h>

#include "solver/energy/energy_sum.h"
#include "solver/energy/handle.h"
#include "solver/energy/inversion_barrier.h"
#include "solver/energy/nearest_rotation.h"
#include "solver/energy/rigidity.h"
#include "solver/energy/volume.h"
#include "solver/field/supports.h"
#include "tests/support/lattice.h"

namespace supple {
namespace {

/// A small body and the samples that the energies under test live on. Pressed flat, or to a line,
/// along axes of no importance; where the rank fades the thickness is such that it does.
struct Body {
  explicit Body(const Vec3& flatness = Vec3::Ones())
      : particles(lattice_particles({1, 0.6, 0.5}, 0.2)),
        field(pressed(particles, flatness), Eigen::VectorXd::Constant(particles.size(), 0.4)),
        samples(sample_field(field, particles.positions, SampleContent::values_and_gradients)) {}

  Particles particles;
  MovingLeastSquares<3> field;
  Samples samples;

 private:
  static const Points& pressed(Particles& particles, const Vec3& flatness) {
    const Mat3 tilt = Eigen::AngleAxisd(0.7, Vec3(1, -2, 3).normalized()).toRotationMatrix();
    particles.positions *= flatness.asDiagonal() * tilt.transpose();
    return particles.positions;
  }
};

const Vec3 plane(1, 1, 0), line(1, 0, 0), fading(1, 1, 5e-3);
const Vec3 short_bodies[] = {plane, line, fading};

struct EnergyCase {
  const char* name;
  std::function<std::unique_ptr<Energy>(const Body&)> make;
  bool invariant_under_rotation;
};

const std::vector<EnergyCase>& all_energies() {
  static const std::vector<EnergyCase> cases{
      {"handles",
       [](const Body& body) { return std::make_unique<HandleEnergy>(body.samples.points); }, false},
      {"rigidity", [](const Body&) { return std::make_unique<RigidityEnergy>(); }, true},
      {"volume", [](const Body&) { return std::make_unique<VolumeEnergy>(); }, true},
      {"no_inversion", [](const Body&) { return std::make_unique<InversionBarrier>(); }, true},
      {"nearest_rotation",
       [](const Body& body) {
         return std::make_unique<NearestRotationEnergy>(body.samples.size());
       },
       false},
  };
  return cases;
}

Points random_displacements(Index count, double size, std::uint64_t seed) {
  Random random(seed);
  Points u(count, 3);
  for (Index i = 0; i < count; ++i) u.row(i) = random.in_cube(-size, size).transpose();
  return u;
}

class EveryEnergy : public testing::TestWithParam<EnergyCase> {
 protected:
  Body body;
  std::unique_ptr<Energy> energy = GetParam().make(body);
};

TEST_P(EveryEnergy, IsZeroAtRestWithZeroGradient) {
  EnergySum sum(body.particles.size());
  sum.add(*energy, body.samples, body.particles.volumes, 1);
  Points gradient;
  EXPECT_EQ(sum.evaluate(Points::Zero(body.particles.size(), 3), &gradient), 0);
  EXPECT_EQ(gradient.norm(), 0);
}

TEST_P(EveryEnergy, JacobianMatchesFiniteDifferences) {
  Random random(5);
  for (int trial = 0; trial < 100; ++trial) {
    LocalField at;
    at.sample = trial % body.samples.size();
    at.f = random.in_cube(-1, 1);
    for (int i = 0; i < 9; ++i) at.F(i / 3, i % 3) = random.uniform(-1.5, 1.5);
    LocalResidual exact, ahead, behind;
    energy->evaluate(at, exact);
    if (!exact.r.head(energy->rows()).allFinite()) continue;  // beyond a barrier
    const bool by_f = energy->argument() == Energy::Argument::position;
    const double step = 1e-6;
    for (int column = 0; column < (by_f ? 3 : 9); ++column) {
      LocalField moved = at;
      double& coordinate = by_f ? moved.f[column] : moved.F(column / 3, column % 3);
      const double here = coordinate;
      coordinate = here + step;
      energy->evaluate(moved, ahead);
      coordinate = here - step;
      energy->evaluate(moved, behind);
      for (int row = 0; row < energy->rows(); ++row)
        EXPECT_NEAR((ahead.r[row] - behind.r[row]) / (2 * step), exact.jacobian(row, column),
                    1e-8 * (1 + exact.jacobian.row(row).head(by_f ? 3 : 9).norm()));
    }
  }
}

TEST_P(EveryEnergy, ShortWayToItsSquareIsThatOfTheResidual) {
  Random random(6);
  for (int trial = 0; trial < 100; ++trial) {
    LocalField at;
    at.sample = trial % body.samples.size();
    at.f = random.in_cube(-1, 1);
    for (int i = 0; i < 9; ++i) at.F(i / 3, i % 3) = random.uniform(-1.5, 1.5);
    LocalDerivative by_residual, short_way;
    const double square = energy->Energy::add_square(at, 0.7, by_residual);
    if (!std::isfinite(square)) continue;  // beyond a barrier
    const double tolerance = 1e-13 * (1 + square);
    EXPECT_NEAR(energy->add_square(at, 0.7, short_way), square, tolerance);
    EXPECT_LT((short_way.by_f - by_residual.by_f).norm(), 10 * tolerance);
    EXPECT_LT((short_way.by_F - by_residual.by_F).norm(), 10 * tolerance);
  }
}

/// Compares the gradient with central differences over displacements of `size`.
void expect_true_gradient(const Energy& energy, const Body& body, double size) {
  EnergySum sum(body.particles.size());
  sum.add(energy, body.samples, body.particles.volumes, 3);
  Points u = random_displacements(body.particles.size(), size, 9), gradient;
  sum.evaluate(u, &gradient);
  const Points direction = random_displacements(body.particles.size(), 1, 10);
  const double step = 2e-5 * size;
  const double difference =
      (sum.evaluate(u + step * direction) - sum.evaluate(u - step * direction)) / (2 * step);
  EXPECT_NEAR(difference, gradient.cwiseProduct(direction).sum(), 1e-7 * gradient.norm());
}

TEST_P(EveryEnergy, GradientMatchesFiniteDifferences) {
  expect_true_gradient(*energy, body, 0.05);
  for (const Vec3& flatness : short_bodies) {
    const Body flat(flatness);
    ASSERT_FALSE(flat.samples.short_spans.empty());
    expect_true_gradient(*GetParam().make(flat), flat, flatness == fading ? 1e-3 : 0.05);
  }
}

TEST_P(EveryEnergy, DoesNotFeelTurnsOfFlatBodies) {
  if (!GetParam().invariant_under_rotation) GTEST_SKIP() << "ties the shape to space";
  for (const Vec3& flatness : short_bodies) {
    const Body flat(flatness);
    EnergySum sum(flat.particles.size());
    sum.add(*energy, flat.samples, flat.particles.volumes, 1);
    const Points& x = flat.particles.positions;
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 2, 3)}) {
      const Mat3 R = Eigen::AngleAxisd(0.5 * EIGEN_PI, axis.normalized()).toRotationMatrix();
      Points gradient;
      EXPECT_LT(sum.evaluate(x * R.transpose() - x, &gradient), 1e-12);
      EXPECT_LT(gradient.norm(), 1e-9);
    }
    // They do feel being stretched along what they span, if they feel anything near rest.
    if (energy->stiffness() == 0) continue;
    EXPECT_GT(sum.evaluate(0.1 * x), 1e-3);
  }
}

TEST_P(EveryEnergy, PreconditionerLiesAboveItAtRest) {
  if (std::string(energy->name()) == "volume") GTEST_SKIP() << "stated for the mean alone";
  for (const Vec3& flatness : {Vec3(1, 1, 1), plane, line, fading}) {
    const Body flat(flatness);
    const auto same = GetParam().make(flat);
    EnergySum sum(flat.particles.size());
    sum.add(*same, flat.samples, flat.particles.volumes, 1);
    const double step = 1e-6;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const Points direction = random_displacements(flat.particles.size(), 1, seed);
      double bound = 0;  // δᵀ C δ/2
      for (Index k = 0; k < flat.samples.size(); ++k) {
        const double change =
            energy->argument() == Energy::Argument::position
                ? flat.samples.displacement(k, direction).squaredNorm()
                : (flat.samples.plain_gradient(k, direction) - Mat3::Identity()).squaredNorm();
        bound += 0.5 * same->stiffness() * flat.particles.volumes[k] * change;
      }
      EXPECT_LE(sum.evaluate(step * direction) / (step * step), 1.01 * bound);
    }
  }
}

TEST_P(EveryEnergy, DoesNotFeelRigidMotions) {
  EnergySum sum(body.particles.size());
  sum.add(*energy, body.samples, body.particles.volumes, 1);
  const Points& x = body.particles.positions;
  Points u = random_displacements(body.particles.size(), 0.05, 3);
  if (energy->stiffness() == 0) u -= 0.45 * x;  // a barrier is not felt near rest
  const Mat3 R = Eigen::AngleAxisd(2.5, Vec3(1, 2, 3).normalized()).matrix();
  const Points turned = ((x + u) * R.transpose()).rowwise() + Eigen::RowVector3d(5, -3, 1);
  const double before = sum.evaluate(u);
  EXPECT_GT(before, 1e-4);
  if (!GetParam().invariant_under_rotation) {
    // Targets and rotations that stand tie the shape to space.
    EXPECT_GT(sum.evaluate(turned - x), 10 * before);
    return;
  }
  EXPECT_NEAR(sum.evaluate(turned - x), before, 1e-10 * before);
}

TEST_P(EveryEnergy, StiffnessBoundsTheCurvatureAtRest) {
  // |J δ|² ≤ (stiffness / 2) |δ|² for the Jacobian at rest.
  LocalField rest;
  rest.f = body.samples.points.row(0).transpose();
  LocalResidual local;
  energy->evaluate(rest, local);
  const int columns = energy->argument() == Energy::Argument::position ? 3 : 9;
  const Eigen::MatrixXd J = local.jacobian.topLeftCorner(energy->rows(), columns);
  const double greatest = (J.transpose() * J).eval().selfadjointView<Eigen::Lower>().operatorNorm();
  if (std::string(energy->name()) == "volume") {
    // The cofactor direction is rank one: on average over directions it costs what is stated.
    EXPECT_LE((J.transpose() * J).trace() / 9, energy->stiffness() / 2 + 1e-12);
    return;
  }
  EXPECT_LE(greatest, energy->stiffness() / 2 + 1e-12);
}

INSTANTIATE_TEST_SUITE_P(All, EveryEnergy, testing::ValuesIn(all_energies()),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(EnergySum, SharesSamplesAndSplitsValues) {
  const Body body;
  const RigidityEnergy rigidity;
  const VolumeEnergy volume;
  EnergySum both(body.particles.size());
  both.add(rigidity, body.samples, body.particles.volumes, 2);
  both.add(volume, body.samples, body.particles.volumes, 5);
  ASSERT_EQ(both.groups().size(), 1u);
  const Points u = random_displacements(body.particles.size(), 0.05, 21);
  const auto values = both.values(u);
  ASSERT_EQ(values.size(), 2u);
  EXPECT_NEAR(values[0].second + values[1].second, both.evaluate(u), 1e-12);
}

TEST(InversionBarrier, GrowsWithoutBoundAndSmoothly) {
  const InversionBarrier barrier;
  const auto value = [&](double J) {
    LocalField at;
    at.F = Vec3(J, 1, 1).asDiagonal();
    LocalDerivative derivative;
    return barrier.add_square(at, 1, derivative);
  };
  const double edge = InversionBarrier::felt_below;
  EXPECT_EQ(value(edge), 0);
  EXPECT_GT(value(1e-4), 1e5);
  EXPECT_EQ(value(0), std::numeric_limits<double>::infinity());
  EXPECT_EQ(value(-1), std::numeric_limits<double>::infinity());
  // The square of a cubic: value and derivatives up to the fifth begin at zero.
  for (const double below : {1e-2, 1e-3})
    EXPECT_LT(value(edge - below), 2 * std::pow(below / edge, 6));
}

TEST(RigidityEnergy, KnowsAUniformStretch) {
  LocalField at;
  at.F = 1.1 * Mat3::Identity();
  LocalResidual local;
  RigidityEnergy().evaluate(at, local);
  EXPECT_NEAR(local.r.head(RigidityEnergy().rows()).squaredNorm(), 3 * (1.21 - 1) * (1.21 - 1),
              1e-14);
  VolumeEnergy().evaluate(at, local);
  EXPECT_NEAR(local.r[0], 1.331 - 1, 1e-14);
}

}  // namespace
}  // namespace supple
