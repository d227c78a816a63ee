#include "solver/minimize/preconditioner.h"

#include <gtest/gtest.h>

#include "solver/energy/handle.h"
#include "solver/energy/rigidity.h"
#include "solver/field/supports.h"
#include "tests/support/lattice.h"

namespace supple {
namespace {

/// A body held everywhere, on both sides of the size up to which C is summed in a dense matrix.
class HeldBody : public testing::TestWithParam<double> {
 protected:
  Particles particles = lattice_particles({0.5, 0.5, 1}, GetParam());
  MovingLeastSquares<3> field{
      particles.positions,
      choose_supports(particles.positions, GetParam(), particles.positions).radii};
  Samples samples = sample_field(field, particles.positions, SampleContent::values_and_gradients);
  Eigen::VectorXd weights =
      Eigen::VectorXd::Constant(particles.size(), 1 / double(particles.size()));
  HandleEnergy handles{particles.positions};
  EnergySum energy{particles.size()};

  PaddedPoints random_points(std::uint64_t seed) const {
    Random random(seed);
    PaddedPoints points = PaddedPoints::Zero(particles.size(), 4);
    for (Index i = 0; i < points.rows(); ++i)
      points.row(i).head<3>() = random.in_cube(-1, 1).transpose();
    return points;
  }
};

TEST_P(HeldBody, GradientsGoTheTransposedWayOfDisplacements) {
  const RigidityEnergy rigidity;
  energy.add(handles, samples, weights, 100);
  energy.add(rigidity, samples, weights, 1);
  const Preconditioner preconditioner(energy);
  const PaddedPoints y = random_points(1), by_u = random_points(2);
  PaddedPoints u, by_y;
  preconditioner.to_displacements(y, u);
  preconditioner.to_gradient(by_u, by_y);
  const double there = u.cwiseProduct(by_u).sum(), back = y.cwiseProduct(by_y).sum();
  EXPECT_NEAR(there, back, 1e-12 * u.norm() * by_u.norm());
  EXPECT_EQ(u.col(3).norm() + by_y.col(3).norm(), 0);
}

/// Of the handles' energy alone C is the Hessian but for ε.
TEST_P(HeldBody, IsTheHessianOfTheHandles) {
  energy.add(handles, samples, weights, 1);
  const Preconditioner preconditioner(energy);
  const PaddedPoints u = random_points(3);
  PaddedPoints gradient, y, solved;
  energy.evaluate_padded(u, &gradient);
  preconditioner.to_gradient(gradient, y);
  preconditioner.to_displacements(y, solved);
  PaddedPoints image, expected;
  energy.evaluate_padded(solved, &image);
  energy.evaluate_padded(u, &expected);
  EXPECT_LT((image - expected).norm(), 1e-4 * expected.norm());
}

INSTANTIATE_TEST_SUITE_P(DenseAndSparseSums, HeldBody, testing::Values(0.125, 0.048),
                         [](const auto& info) {
                           return info.param > 0.1 ? std::string("few") : std::string("many");
                         });

}  // namespace
}  // namespace supple
