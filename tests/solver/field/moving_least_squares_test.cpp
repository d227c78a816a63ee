#include "solver/field/moving_least_squares.h"

#include <Eigen/LU>
#include <functional>

#include <gtest/gtest.h>

#include "solver/core/random.h"
#include "solver/field/jet.h"
#include "solver/field/kernel.h"
#include "tests/support/all_of.h"

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
    // The box kernel's second derivative jumps, the Gaussian's at the rim; a difference may
    // straddle the jump.
    if (options().kernel != KernelKind::box && options().kernel != KernelKind::gaussian) {
      EXPECT_LT(second, 1e-5);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Bases, MovingLeastSquares3,
                         testing::Combine(testing::Values(BasisOrder::constant, BasisOrder::linear,
                                                          BasisOrder::quadratic),
                                          testing::ValuesIn(all_of<KernelKind>())),
                         [](const auto& info) {
                           return std::string(enum_name(std::get<0>(info.param))) + "_" +
                                  std::string(enum_name(std::get<1>(info.param)));
                         });

TEST(SingularKernel, InterpolatesWithFiniteDerivatives) {
  const Cloud<3> cloud = jittered_lattice<3>(6, 2.3, 7);
  for (const BasisOrder order : {BasisOrder::constant, BasisOrder::linear, BasisOrder::quadratic}) {
    const MovingLeastSquares<3> field(cloud.positions, cloud.supports,
                                      {order, KernelKind::singular});
    ShapeFunctions<3> at_x;
    for (const int i : {86, 92, 121}) {  // inside the cube
      const Vec3 x = cloud.positions.row(i).transpose();
      field.evaluate(x, Derivatives::second, at_x);
      for (std::size_t j = 0; j < at_x.particles.size(); ++j)
        EXPECT_EQ(at_x.values[Index(j)], at_x.particles[j] == i ? 1 : 0);
      // At the particle itself, and as near as rounding lets one come.
      for (const double distance : {0.0, 1e-15, 1e-9, 1e-4}) {
        const Vec3 near = x + distance * Vec3(0.6, -0.48, 0.64);
        const auto [first, second] = difference_errors(field, near, 1e-6);
        EXPECT_LT(first, 1e-5) << distance;
        EXPECT_LT(second, 1e-3) << distance;
      }
    }
  }
}

TEST(SingularKernel, GivesParticlesAtOnePlaceToTheFirst) {
  Cloud<3> cloud = jittered_lattice<3>(6, 2.3, 7);
  cloud.positions.row(92) = cloud.positions.row(86);
  const MovingLeastSquares<3> field(cloud.positions, cloud.supports,
                                    {BasisOrder::linear, KernelKind::singular});
  ShapeFunctions<3> at_x;
  field.evaluate(cloud.positions.row(86).transpose(), Derivatives::second, at_x);
  EXPECT_EQ(at_x.values.sum(), 1);
  EXPECT_TRUE(at_x.gradients.allFinite());
  EXPECT_TRUE(at_x.seconds.allFinite());
}

TEST(FittedGradients, AreThoseOfEquation37) {
  const Cloud<3> cloud = jittered_lattice<3>(6, 2.3, 7);
  const MovingLeastSquares<3> field(
      cloud.positions, cloud.supports,
      {BasisOrder::linear, KernelKind::polynomial, GradientKind::least_squares});
  Random random(3);
  PointsOf<3> u(cloud.positions.rows(), 3);
  for (Index i = 0; i < u.rows(); ++i) u.row(i) = random.in_cube(-1, 1).transpose();
  ShapeFunctions<3> at_x;
  for (int sample = 0; sample < 20; ++sample) {
    const Vec3 x = random.in_cube(0.05, 0.95);
    field.evaluate(x, Derivatives::first, at_x);
    const Mat3 gradient = u(at_x.particles, Eigen::all).transpose() * at_x.gradients;
    const Vec3 at = u(at_x.particles, Eigen::all).transpose() * at_x.values;
    Mat3 A = Mat3::Zero(), right = Mat3::Zero();
    for (const int j : at_x.particles) {
      const Vec3 way = cloud.positions.row(j).transpose() - x;
      const double w =
          kernel_weight<3, 0>(KernelKind::polynomial, Vec3(-way), field.support(j)).value();
      A += w * way * way.transpose();
      right += w * (u.row(j).transpose() - at) * way.transpose();
    }
    EXPECT_LT((gradient - right * A.inverse()).norm(), 1e-11 * gradient.norm());
  }
}

TEST(FittedGradients, DifferFromTheDerivativeWhereTheFieldBends) {
  const Cloud<3> cloud = jittered_lattice<3>(6, 2.3, 7);
  const auto gradient_of = [&](GradientKind kind, const Vec3& x, const auto& f) {
    const MovingLeastSquares<3> field(cloud.positions, cloud.supports,
                                      {BasisOrder::linear, KernelKind::polynomial, kind});
    ShapeFunctions<3> at_x;
    field.evaluate(x, Derivatives::first, at_x);
    Vec3 gradient = Vec3::Zero();
    for (std::size_t j = 0; j < at_x.particles.size(); ++j)
      gradient += f(Vec3(cloud.positions.row(at_x.particles[j]).transpose())) *
                  at_x.gradients.row(Index(j)).transpose();
    return gradient;
  };
  const auto affine = [](const Vec3& x) { return 2 + 3 * x.x() - x.y(); };
  const auto bent = [](const Vec3& x) { return x.x() * x.x() - x.y() * x.z(); };
  Random random(3);
  double error = 0, difference = 0;
  for (int sample = 0; sample < 50; ++sample) {
    const Vec3 x = random.in_cube(0.2, 0.8);
    EXPECT_LT((gradient_of(GradientKind::least_squares, x, affine) - Vec3(3, -1, 0)).norm(), 1e-12);
    const Vec3 fitted = gradient_of(GradientKind::least_squares, x, bent);
    error = std::max(error, (fitted - Vec3(2 * x.x(), -x.z(), -x.y())).norm());
    difference = std::max(difference, (fitted - gradient_of(GradientKind::full, x, bent)).norm());
  }
  // The linear fit sees the bend averaged over supports 0.46 wide: here it is the better gradient.
  EXPECT_LT(error, 0.1);
  EXPECT_GT(difference, 0.01);
}

TEST(MovingLeastSquares, StretchedSupportsReachTheirEllipsoids) {
  Cloud<3> cloud = jittered_lattice<3>(7, 2.6, 7);
  Random random(4);
  std::vector<Mat3> stretches;
  for (Index i = 0; i < cloud.positions.rows(); ++i) {
    const Vec3 axis = random.in_cube(-1, 1).normalized();
    const double ratio = std::exp(random.uniform(0, std::log(3.0)));
    stretches.push_back(std::cbrt(ratio) *
                        (Mat3::Identity() + (1 / ratio - 1) * axis * axis.transpose()));
    ASSERT_NEAR(stretches.back().determinant(), 1, 1e-12);
  }
  for (const KernelKind kernel : all_of<KernelKind>()) {
    const MovingLeastSquares<3> field(cloud.positions, cloud.supports, {BasisOrder::linear, kernel},
                                      nullptr, stretches);
    ShapeFunctions<3> at_x;
    for (int sample = 0; sample < 20; ++sample) {
      const Vec3 x = random.in_cube(0.1, 0.9);
      field.evaluate(x, Derivatives::first, at_x);
      std::vector<int> reached;
      for (int i = 0; i < static_cast<int>(cloud.positions.rows()); ++i) {
        const Vec3 d = stretches[std::size_t(i)] * (x - cloud.positions.row(i).transpose());
        if ((kernel == KernelKind::box ? d.lpNorm<Eigen::Infinity>() : d.norm()) <
            cloud.supports[i])
          reached.push_back(i);
      }
      EXPECT_EQ(at_x.particles, reached);
      const Vec3 reproduced = cloud.positions(at_x.particles, Eigen::all).transpose() * at_x.values;
      EXPECT_LT((reproduced - x).norm(), 1e-13);
      if (sample < 3) {
        EXPECT_LT(difference_errors(field, x, 1e-6).first, 1e-6) << enum_name(kernel);
      }
    }
  }
}

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
