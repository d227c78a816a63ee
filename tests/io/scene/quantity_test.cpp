#include "io/scene/quantity.h"

#include <gtest/gtest.h>

#include "io/errors.h"

namespace supple {
namespace {

const Place command_line{"command line"};

std::string message_of(const std::string& text) {
  try {
    parse_length_vector(text, command_line, "--by");
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(Quantity, ReadsLengths) {
  const auto expect = [](const std::string& text, double value, Length::Unit unit) {
    const Length length = parse_length(text, command_line);
    EXPECT_EQ(length.value, value) << text;
    EXPECT_EQ(length.unit, unit) << text;
  };
  expect("0.3", 0.3, Length::Unit::file);
  expect("-5%", -5, Length::Unit::percent);
  expect("1e-3", 1e-3, Length::Unit::file);
  expect("+2.5E1%", 25, Length::Unit::percent);
  expect(".5", 0.5, Length::Unit::file);
  expect(" 7 ", 7, Length::Unit::file);
}

TEST(Quantity, RefusesWhatIsNoLength) {
  for (const std::string text :
       {"",      " ",    "%",     "abc", "nan", "-nan%", "inf", "-infinity",
        "1e400", "0.3m", "0.3 m", "5 %", "5%%", "%5",    "0,5", "1_000",
        "0x10",  "+-1",  "--1",   "1e",  ".",   ".nan",  "３"})
    EXPECT_THROW(parse_length(text, command_line), UsageError) << text;
}

TEST(Quantity, ReadsVectors) {
  const LengthVector v = parse_length_vector("0.3, 0,-5", command_line);
  EXPECT_EQ(v[0].value, 0.3);
  EXPECT_EQ(v[1].value, 0);
  EXPECT_EQ(v[2].value, -5);
  EXPECT_FALSE(has_percent(v));
  EXPECT_TRUE(has_percent(parse_length_vector("0,0,5%", command_line)));
}

TEST(Quantity, NamesTheOptionAndTheMistake) {
  EXPECT_EQ(message_of("1,2").rfind("command line: --by: '1,2' is not a vector", 0), 0u);
  EXPECT_EQ(message_of("1,2,3,4").rfind("command line: --by: '1,2,3,4' is not a vector", 0), 0u);
  EXPECT_EQ(message_of("1,,3").rfind("command line: --by: '' is not a length", 0), 0u);
  EXPECT_EQ(message_of("10%,0.5,0").rfind("command line: --by: 0.5 stands beside a percent", 0),
            0u);
  EXPECT_EQ(message_of("10%,0,0.0"), "");
}

TEST(Quantity, ResolvesVectorsByTheDiagonal) {
  const Vec3 v = resolve_vector(parse_length_vector("10%,0,-50%", command_line), 4);
  EXPECT_TRUE(v.isApprox(Vec3(0.4, 0, -2), 1e-15));
  EXPECT_EQ(resolve({0.3, Length::Unit::file}, 4), 0.3);
}

TEST(Quantity, ResolvesPointsFromTheBoxCentreOnlyWithPercents) {
  Box box;
  box.extend(Vec3(1, 1, 1));
  box.extend(Vec3(3, 4, 7));  // diagonal 7, centre (2, 2.5, 4)
  const Vec3 percents = resolve_point(parse_length_vector("10%,0,0%", command_line), box);
  EXPECT_TRUE(percents.isApprox(Vec3(2.7, 2.5, 4), 1e-15));
  const Vec3 plain = resolve_point(parse_length_vector("0.5,0,0", command_line), box);
  EXPECT_EQ(plain, Vec3(0.5, 0, 0));
}

TEST(Quantity, PrintsPlacesAndLengths) {
  EXPECT_EQ(to_string(Place{"scene.yaml", 3, 7}), "scene.yaml:3:7");
  EXPECT_EQ(to_string(command_line), "command line");
  EXPECT_EQ(to_string(Length{-2.5, Length::Unit::percent}), "-2.5%");
  EXPECT_EQ(to_string(Length{0.3, Length::Unit::file}), "0.3");
}

}  // namespace
}  // namespace supple
