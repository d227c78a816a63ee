#include "solver/field/moving_least_squares.h"

#include <gtest/gtest.h>

#include "solver/core/random.h"
#include "solver/field/jet.h"

namespace supple {
namespace {

/// Jittered lattice in the unit cube: every point inside is well covered.
template <int Dim>
struct Cloud {
  PointsOf<Dim> positions;
  Eigen::VectorXd supports;
};

template <int Dim>
Cloud<Dim> jittered_lattice(int per_axis, double support_over_spacing, std::uint64_t seed) {
  Random random(seed);
  int count = 1;
  for (int k = 0; k < Dim; ++k) count *= per_axis;
  const double s = 1.0 / (per_axis - 1);
  Cloud<Dim> cloud;
  cloud.positions.resize(count, Dim);
  cloud.supports.resize(count);
  for (int i = 0; i < count; ++i) {
    int rest = i;
    for (int k = 0; k < Dim; ++k) {
      cloud.positions(i, k) = s * (rest % per_axis + random.uniform(-0.2, 0.2));
      rest /= per_axis;
    }
    cloud.supports[i] = s * support_over_spacing * random.uniform(0.95, 1.05);
  }
  return cloud;
}

double monomial_sum(const ShapeFunctions<3>& at_x, const PointsOf<3>& positions,
                    const std::function<double(const Vec3&)>& f) {
  double sum = 0;
  for (std::size_t j = 0; j < at_x.particles.size(); ++j)
    sum += at_x.values[static_cast<Index>(j)] * f(positions.row(at_x.particles[j]).transpose());
  return sum;
}

class MovingLeastSquares3 : public testing::TestWithParam<std::tuple<BasisOrder, KernelKind>> {
 protected:
  MovingLeastSquaresOptions options() const {
    return {std::get<0>(GetParam()), std::get<1>(GetParam())};
  }
  Cloud<3> cloud = jittered_lattice<3>(6, 2.3, 7);
};

TEST_P(MovingLeastSquares3, ReproducesItsPolynomialsWithAllDerivatives) {
  const MovingLeastSquares<3> field(cloud.positions, cloud.supports, options());
  Random random(3);
  const Vec3 b(0.3, -1.1, 0.7);
  Mat3 A;
  A << 0.4, -0.2, 0.1, -0.2, 0.9, 0.3, 0.1, 0.3, -0.5;
  const int order = static_cast<int>(options().order);
  const auto f = [&](const Vec3& x) {
    return 2.0 + (order >= 1 ? b.dot(x) : 0) + (order >= 2 ? x.dot(A * x) : 0);
  };
  ShapeFunctions<3> at_x;
  for (int sample = 0; sample < 50; ++sample) {
    const Vec3 x = random.in_cube(0.05, 0.95);
    field.evaluate(x, Derivatives::second, at_x);
    ASSERT_EQ(at_x.rank, MovingLeastSquares<3>::basis_size(options().order));
    EXPECT_NEAR(at_x.values.sum(), 1, 1e-13);
    EXPECT_NEAR(monomial_sum(at_x, cloud.positions, f), f(x), 1e-12);
    Vec3 gradient = Vec3::Zero();
    Eigen::Matrix<double, 6, 1> second = Eigen::Matrix<double, 6, 1>::Zero();
    for (std::size_t j = 0; j < at_x.particles.size(); ++j) {
      const double value = f(cloud.positions.row(at_x.particles[j]).transpose());
      gradient += value * at_x.gradients.row(static_cast<Index>(j)).transpose();
      second += value * at_x.seconds.row(static_cast<Index>(j)).transpose();
    }
    const Mat3 H = (order >= 2 ? 2.0 : 0.0) * A;
    const Vec3 expected = (order >= 1 ? 1.0 : 0.0) * b + H * x;
    EXPECT_LT((gradient - expected).norm(), 1e-10);
    Eigen::Matrix<double, 6, 1> hessian;
    hessian << H(0, 0), H(0, 1), H(0, 2), H(1, 1), H(1, 2), H(2, 2);
    EXPECT_LT((second - hessian).norm(), 1e-8);
  }
}

/// Largest difference between the derivatives and central differences of step `step`.
std::pair<double, double> difference_errors(const MovingLeastSquares<3>& field, const Vec3& x,
                                            double step) {
  ShapeFunctions<3> at_x, moved;
  field.evaluate(x, Derivatives::second, at_x);
  const auto dense = [&](const Vec3& y) {
    field.evaluate(y, Derivatives::first, moved);
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(field.positions().rows(), 4);
    for (std::size_t j = 0; j < moved.particles.size(); ++j) {
      const Index row = static_cast<Index>(j);
      all.row(moved.particles[j]) << moved.values[row], moved.gradients.row(row);
    }
    return all;
  };
  double first_error = 0, second_error = 0;
  for (int k = 0; k < 3; ++k) {
    const Eigen::MatrixXd difference =
        (dense(x + step * Vec3::Unit(k)) - dense(x - step * Vec3::Unit(k))) / (2 * step);
    for (std::size_t j = 0; j < at_x.particles.size(); ++j) {
      const Index row = static_cast<Index>(j);
      const int i = at_x.particles[j];
      first_error = std::max(first_error, std::abs(difference(i, 0) - at_x.gradients(row, k)));
      for (int l = 0; l < 3; ++l) {
        const int place = Jet<3, 2>::pair(std::min(k, l), std::max(k, l));
        second_error =
            std::max(second_error, std::abs(difference(i, 1 + l) - at_x.seconds(row, place)));
      }
    }
  }
  return {first_error, second_error};
}

TEST_P(MovingLeastSquares3, DerivativesMatchFiniteDifferences) {
  const MovingLeastSquares<3> field(cloud.positions, cloud.supports, options());
  Random random(11);
  for (int sample = 0; sample < 10; ++sample) {
    const auto [first, second] = difference_errors(field, random.in_cube(0.1, 0.9), 1e-6);
    EXPECT_LT(first, 1e-6);
    // The box kernel's second derivative jumps; a difference may straddle the jump.
    if (options().kernel != KernelKind::box) {
      EXPECT_LT(second, 1e-5);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Bases, MovingLeastSquares3,
                         testing::Combine(testing::Values(BasisOrder::constant, BasisOrder::linear,
                                                          BasisOrder::quadratic),
                                          testing::Values(KernelKind::polynomial,
                                                          KernelKind::wendland, KernelKind::box)),
                         [](const auto& info) {
                           return std::string(enum_name(std::get<0>(info.param))) + "_" +
                                  std::string(enum_name(std::get<1>(info.param)));
                         });

TEST(MovingLeastSquares, DerivativesHoldWhereTheRankFades) {
  // A slab whose thickness puts one singular value inside the fading window.
  for (const BasisOrder order : {BasisOrder::linear, BasisOrder::quadratic}) {
    Cloud<3> cloud = jittered_lattice<3>(6, 2.3, 5);
    for (Index i = 0; i < cloud.positions.rows(); ++i) cloud.positions(i, 2) *= 4e-3;
    const MovingLeastSquares<3> field(cloud.positions, cloud.supports, {order});
    ShapeFunctions<3> at_x;
    field.evaluate({0.5, 0.5, 0.002}, Derivatives::none, at_x);
    EXPECT_NEAR(at_x.values.sum(), 1, 1e-13);
    const auto [first, second] = difference_errors(field, {0.47, 0.52, 0.002}, 1e-7);
    ShapeFunctions<3> exact;
    field.evaluate({0.47, 0.52, 0.002}, Derivatives::second, exact);
    EXPECT_LT(first, 1e-5 * exact.gradients.cwiseAbs().maxCoeff());
    EXPECT_LT(second, 1e-5 * exact.seconds.cwiseAbs().maxCoeff());
  }
}

TEST(MovingLeastSquares, ReproducesQuadraticsInOneAndTwoDimensions) {
  const Cloud<1> line = jittered_lattice<1>(12, 3.5, 2);
  const MovingLeastSquares<1> in_time(line.positions, line.supports, {BasisOrder::quadratic});
  ShapeFunctions<1> at_t;
  in_time.evaluate(VectorOf<1>(0.37), Derivatives::second, at_t);
  double acceleration = 0;
  for (std::size_t j = 0; j < at_t.particles.size(); ++j) {
    const double t = line.positions(at_t.particles[j], 0);
    acceleration += at_t.seconds(static_cast<Index>(j), 0) * 0.5 * 9.81 * t * t;
  }
  EXPECT_NEAR(acceleration, 9.81, 1e-8);

  const Cloud<2> plane = jittered_lattice<2>(8, 3.0, 2);
  const MovingLeastSquares<2> in_plane(plane.positions, plane.supports, {BasisOrder::quadratic});
  ShapeFunctions<2> at_x;
  in_plane.evaluate({0.41, 0.6}, Derivatives::none, at_x);
  double product = 0;
  for (std::size_t j = 0; j < at_x.particles.size(); ++j)
    product += at_x.values[static_cast<Index>(j)] * plane.positions(at_x.particles[j], 0) *
               plane.positions(at_x.particles[j], 1);
  EXPECT_NEAR(product, 0.41 * 0.6, 1e-12);
}

TEST(MovingLeastSquares, SaysWhereNothingReaches) {
  const Cloud<3> cloud = jittered_lattice<3>(4, 2.0, 1);
  const MovingLeastSquares<3> field(cloud.positions, cloud.supports);
  ShapeFunctions<3> at_x;
  field.evaluate({9, 9, 9}, Derivatives::first, at_x);
  EXPECT_FALSE(at_x.covered());
  EXPECT_EQ(at_x.rank, 0);
}

}  // namespace
}  // namespace supple
