#include "solver/minimize/lbfgs.h"

#include <limits>

#include <gtest/gtest.h>

#include "solver/energy/handle.h"
#include "solver/energy/rigidity.h"
#include "solver/energy/volume.h"
#include "solver/field/supports.h"
#include "tests/support/lattice.h"

namespace supple {
namespace {

/// A bar of 128 particles whose ends are held and moved.
class LbfgsTest : public testing::Test {
 protected:
  LbfgsTest() {
    energy.add(handles, ends, Eigen::VectorXd::Constant(ends.size(), 1 / double(ends.size())), 1e4);
    energy.add(rigidity, samples, weights, 1);
    energy.add(volume, samples, weights, 1);
  }

  /// The lowest and the highest layer.
  static Points end_points(const Points& positions) {
    std::vector<int> rows;
    for (Index i = 0; i < positions.rows(); ++i)
      if (positions(i, 2) < 0.125 || positions(i, 2) > 0.875) rows.push_back(static_cast<int>(i));
    return positions(rows, Eigen::all);
  }

  void move_top(const Vec3& by) {
    Points targets = ends.points;
    for (Index k = 0; k < targets.rows(); ++k)
      if (targets(k, 2) > 0.5) targets.row(k) += by.transpose();
    handles.set_targets(targets);
  }

  PaddedPoints at_rest() const { return PaddedPoints::Zero(particles.size(), 4); }

  Particles particles = lattice_particles({0.5, 0.5, 1}, 0.125);
  MovingLeastSquares<3> field{
      particles.positions, choose_supports(particles.positions, 0.125, particles.positions).radii};
  Samples samples = sample_field(field, particles.positions, SampleContent::values_and_gradients);
  Samples ends = sample_field(field, end_points(particles.positions), SampleContent::values);
  Eigen::VectorXd weights =
      Eigen::VectorXd::Constant(particles.size(), 1 / double(particles.size()));
  HandleEnergy handles{ends.points};
  RigidityEnergy rigidity;
  VolumeEnergy volume;
  EnergySum energy{particles.size()};
};

TEST_F(LbfgsTest, NeverRisesFromOneIterationToTheNext) {
  move_top({0.4, 0.1, -0.2});
  const Preconditioner preconditioner(energy);
  double before = energy.evaluate_padded(at_rest());
  for (int iterations = 1; iterations < 30; ++iterations) {
    PaddedPoints u = at_rest();
    const Lbfgs::Result result = Lbfgs().minimize(
        energy, preconditioner, {.max_iterations = iterations, .tolerance = 1e-12}, nullptr, u);
    EXPECT_EQ(result.iterations, iterations);
    EXPECT_EQ(result.stop, Lbfgs::Stop::max_iterations);
    EXPECT_EQ(result.energy, energy.evaluate_padded(u));
    EXPECT_LE(result.energy, before);
    before = result.energy;
  }
}

TEST_F(LbfgsTest, ConvergesToAStationaryPoint) {
  move_top({0.3, 0, 0.1});
  const Preconditioner preconditioner(energy);
  PaddedPoints u = at_rest(), at_start, gradient;
  energy.evaluate_padded(u, &at_start);
  const Lbfgs::Result result =
      Lbfgs().minimize(energy, preconditioner, {.tolerance = 1e-15}, nullptr, u);
  EXPECT_EQ(result.stop, Lbfgs::Stop::converged);
  energy.evaluate_padded(u, &gradient);
  EXPECT_LT(gradient.norm(), 1e-5 * at_start.norm());
}

TEST_F(LbfgsTest, EndsAtOnceWhereNothingPulls) {
  const Preconditioner preconditioner(energy);
  PaddedPoints u = at_rest();
  const Lbfgs::Result result = Lbfgs().minimize(energy, preconditioner, {}, nullptr, u);
  EXPECT_EQ(result.iterations, 0);
  EXPECT_EQ(u.norm(), 0);
}

TEST_F(LbfgsTest, DoesNotCallAStartWithoutFiniteEnergyConverged) {
  move_top({std::numeric_limits<double>::quiet_NaN(), 0, 0});
  const Preconditioner preconditioner(energy);
  PaddedPoints u = at_rest();
  const Lbfgs::Result result = Lbfgs().minimize(energy, preconditioner, {}, nullptr, u);
  EXPECT_EQ(result.stop, Lbfgs::Stop::stuck);
  EXPECT_EQ(result.not_finite, 1);
  EXPECT_EQ(u, at_rest());
}

TEST_F(LbfgsTest, RemembersNothingOfTheSolveBefore) {
  const Preconditioner preconditioner(energy);
  Lbfgs used;
  PaddedPoints elsewhere = at_rest(), again = at_rest(), fresh = at_rest();
  move_top({-0.2, 0.3, 0});
  used.minimize(energy, preconditioner, {}, nullptr, elsewhere);
  move_top({0.3, 0, 0.1});
  used.minimize(energy, preconditioner, {}, nullptr, again);
  Lbfgs().minimize(energy, preconditioner, {}, nullptr, fresh);
  EXPECT_EQ(again, fresh);
}

TEST_F(LbfgsTest, StopsWhenItsTimeIsOverWithWhatItHas) {
  move_top({0.3, 0, 0.1});
  const Preconditioner preconditioner(energy);
  PaddedPoints u = at_rest();
  const Lbfgs::Result result =
      Lbfgs().minimize(energy, preconditioner, {.most_seconds = 0}, nullptr, u);
  EXPECT_EQ(result.stop, Lbfgs::Stop::out_of_time);
  EXPECT_LE(result.energy, energy.evaluate_padded(at_rest()));
  EXPECT_TRUE(u.allFinite());
}

}  // namespace
}  // namespace supple
