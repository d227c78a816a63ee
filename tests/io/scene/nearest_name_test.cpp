#include "io/scene/nearest_name.h"

#include <array>

#include <gtest/gtest.h>

namespace supple {
namespace {

constexpr std::array<std::string_view, 5> names{"mesh", "particles", "spacing", "size", "basis"};

TEST(NearestName, FindsMisspeltNames) {
  EXPECT_EQ(nearest_name("partcles", names), "particles");
  EXPECT_EQ(nearest_name("Particles", names), "particles");
  EXPECT_EQ(nearest_name("sizes", names), "size");
  EXPECT_EQ(nearest_name("bases", names), "basis");
}

TEST(NearestName, TakesTheFirstOfEquals) {
  constexpr std::array<std::string_view, 2> words{"and", "any"};
  EXPECT_EQ(nearest_name("an", words), "and");
}

TEST(NearestName, IsEmptyWhereNothingIsNear) {
  EXPECT_EQ(nearest_name("gravitation", names), "");
  EXPECT_EQ(nearest_name("", names), "");
  constexpr std::array<std::string_view, 1> axis{"x"};
  EXPECT_EQ(nearest_name("5", axis), "");
  EXPECT_EQ(nearest_name("X", axis), "x");
  EXPECT_EQ(nearest_name(std::string(1 << 20, 's'), names), "");
  EXPECT_EQ(nearest_name("mesh", {}), "");
}

}  // namespace
}  // namespace supple
