#include "solver/field/kernel.h"

#include <gtest/gtest.h>

#include "solver/core/random.h"
#include "tests/support/all_of.h"

namespace supple {
namespace {

class EveryKernel : public testing::TestWithParam<KernelKind> {};

TEST_P(EveryKernel, HasItsDerivatives) {
  Mat3 stretch;
  stretch << 1.2, 0.2, -0.1, 0.2, 0.8, 0.1, -0.1, 0.1, 1.1;
  Random random(1);
  constexpr double step = 1e-5, h = 0.7;
  for (const Mat3* shape : {static_cast<const Mat3*>(nullptr), &std::as_const(stretch)})
    for (int trial = 0; trial < 100; ++trial) {
      const Support<3> support{h, shape};
      const Vec3 offset = random.in_cube(-0.35, 0.35);
      const auto at = [&](const Vec3& x) { return kernel_weight<3, 2>(GetParam(), x, support); };
      const auto exact = at(offset);
      for (int k = 0; k < 3; ++k) {
        const auto ahead = at(offset + step * Vec3::Unit(k));
        const auto behind = at(offset - step * Vec3::Unit(k));
        EXPECT_NEAR((ahead.value() - behind.value()) / (2 * step), exact.first(k), 1e-7);
        if (GetParam() == KernelKind::box) continue;  // its second derivative jumps
        for (int l = k; l < 3; ++l)
          EXPECT_NEAR((ahead.first(l) - behind.first(l)) / (2 * step), exact.second(k, l), 1e-4);
      }
    }
}

TEST_P(EveryKernel, IsOneInTheMiddleAndEndsSmoothly) {
  const Support<3> support{2};
  const auto at = [&](double q) {
    return kernel_weight<3, 2>(GetParam(), Vec3(2 * q, 0, 0), support);
  };
  EXPECT_DOUBLE_EQ(at(0).value(), 1);
  EXPECT_EQ(at(0).first(0), 0);
  EXPECT_EQ(at(1).value(), 0);
  EXPECT_LT(at(1 - 1e-6).value(), 1e-10);
  EXPECT_LT(std::abs(at(1 - 1e-6).first(0)), 1e-4);
  for (double q = 0.01; q < 1; q += 0.01) {
    EXPECT_GT(at(q).value(), 0);
    EXPECT_LT(at(q).value(), at(q - 0.01).value());
  }
}

INSTANTIATE_TEST_SUITE_P(All, EveryKernel, testing::ValuesIn(all_of<KernelKind>()),
                         [](const auto& info) { return std::string(enum_name(info.param)); });

TEST(CubicSpline, IsTheUsualOne) {
  const auto at = [](double q) { return cubic_spline_kernel(q * q).value / 1.5; };
  EXPECT_DOUBLE_EQ(at(0), 2.0 / 3);
  EXPECT_DOUBLE_EQ(at(0.25), 2.0 / 3 - 4 * 0.0625 + 4 * 0.015625);
  EXPECT_DOUBLE_EQ(at(0.5), 1.0 / 6);
  EXPECT_DOUBLE_EQ(at(0.75), 4.0 / 3 * 0.015625);
}

}  // namespace
}  // namespace supple
