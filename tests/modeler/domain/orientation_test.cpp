#include "modeler/domain/orientation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "solver/core/random.h"

namespace supple {
namespace {

using Vec2 = Eigen::Vector2d;

TEST(Orientation, IsPositiveBelowATriangleThatTurnsCounterClockwise) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  EXPECT_EQ(orientation(a, b, c, Vec3(0.2, 0.2, -1)), 1);
  EXPECT_EQ(orientation(a, b, c, Vec3(0.2, 0.2, 1)), -1);
  EXPECT_EQ(orientation(a, b, c, Vec3(5, -7, 0)), 0);
  EXPECT_EQ(orientation(Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)), 1);
}

TEST(Orientation, SeesTheLastBitOfACoordinate) {
  // Points on the plane x + y + z = 1.5 whose coordinates are exact; one of them then moves by
  // the least amount there is.
  const Vec3 a(0.5, 0.5, 0.5), b(1.25, 0.125, 0.125), c(0.125, 1.25, 0.125);
  const Vec3 on(0.25, 0.25, 1.0);
  ASSERT_EQ(orientation(a, b, c, on), 0);
  const double up = std::nextafter(1.0, 2.0), down = std::nextafter(1.0, 0.0);
  const int above = orientation(a, b, c, Vec3(0.25, 0.25, up));
  EXPECT_NE(above, 0);
  EXPECT_EQ(orientation(a, b, c, Vec3(0.25, 0.25, down)), -above);
  EXPECT_EQ(orientation(a, b, c, Vec3(0.25, 0.25, 2)), above);
}

TEST(Orientation, OfNearlyFlatPointsIsThatOfTheirIntegers) {
  // Coordinates are multiples of 2⁻⁴⁰ near 1, so the determinant is exact in 128-bit integers.
  Random random(3);
  int zeros = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const auto near_line = [&](double t) {
      const double step = std::ldexp(1.0, -40);
      const auto wobble = [&] { return step * std::floor(3 * random.uniform()); };
      return Vec3(1 + step * std::floor(t * 1e6) + wobble(),
                  1 + 2 * step * std::floor(t * 1e6) + wobble(), 1 + wobble());
    };
    const Vec3 a = near_line(random.uniform()), b = near_line(random.uniform()),
               c = near_line(random.uniform()), d = near_line(random.uniform());
    const auto integer = [&](const Vec3& x, int k) {
      return static_cast<__int128>(std::ldexp(x[k] - d[k], 40));
    };
    __int128 determinant = 0;
    for (int k = 0; k < 3; ++k) {
      const int n = (k + 1) % 3, l = (k + 2) % 3;
      determinant +=
          integer(a, k) * (integer(b, n) * integer(c, l) - integer(b, l) * integer(c, n));
    }
    const int expected = determinant > 0 ? 1 : determinant < 0 ? -1 : 0;
    zeros += expected == 0 ? 1 : 0;
    EXPECT_EQ(orientation(a, b, c, d), expected);
    EXPECT_EQ(orientation(b, a, c, d), -expected);
  }
  EXPECT_GT(zeros, 10);
}

TEST(Orientation, OfThreePointsOnALineIsZeroHoweverTheyAreRounded) {
  for (int i = 1; i < 200; ++i) {
    const double x = 0.1 * i;
    EXPECT_EQ(orientation(Vec2(0, 0), Vec2(x, x), Vec2(3 * x, 3 * x)), 0) << x;
    EXPECT_EQ(orientation(Vec2(0, 0), Vec2(x, x), Vec2(x, std::nextafter(x, 100))), 1) << x;
  }
}

}  // namespace
}  // namespace supple
