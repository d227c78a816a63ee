#include "io/scene/selection.h"

#include <gtest/gtest.h>

#include "io/errors.h"
#include "tests/support/selection_trees.h"

namespace supple {
namespace {

const Place place{"scene.yaml", 8, 13};

std::string tree_of(const std::string& text) {
  return test::show(parse_selection(text, place));
}

std::string message_of(const std::string& text) {
  try {
    parse_selection(text, place);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Selection, HoldsWhatAHandBuiltTreeHolds) {
  const Selection s = parse_selection("y>=-5% and not box(0,0,0,1,2,3)", place);
  ASSERT_EQ(s.kind, Selection::Kind::all);
  EXPECT_EQ(s.text, "y>=-5% and not box(0,0,0,1,2,3)");
  EXPECT_EQ(to_string(s.place), "scene.yaml:8:13");
  ASSERT_EQ(s.parts.size(), 2u);
  EXPECT_EQ(s.parts[0].kind, Selection::Kind::compare);
  EXPECT_EQ(s.parts[0].text, "y>=-5%");
  EXPECT_EQ(parse_selection(" x<1 or y<1 ", place).text, "x<1 or y<1");
  EXPECT_EQ(s.parts[0].axis, 1);
  EXPECT_EQ(s.parts[0].order, Selection::Order::greater_equal);
  EXPECT_EQ(s.parts[0].bound.value, -5);
  EXPECT_EQ(s.parts[0].bound.unit, Length::Unit::percent);
  ASSERT_EQ(s.parts[1].kind, Selection::Kind::negation);
  ASSERT_EQ(s.parts[1].parts.size(), 1u);
  EXPECT_EQ(s.parts[1].parts[0].kind, Selection::Kind::box);
  EXPECT_EQ(s.parts[1].parts[0].upper[2].value, 3);
}

TEST(Selection, ReadsEveryForm) {
  const std::pair<std::string, std::string> forms[] = {
      {"y<10%", "(y < 10%)"},
      {"x>0.2", "(x > 0.2)"},
      {"  z <= -1e-3 ", "(z <= -0.001)"},
      {"z>=15%", "(z >= 15%)"},
      {"y:..10%", "(y < 10%)"},
      {"y:85%..", "(y > 85%)"},
      {"y : 10% .. 30%", "(and (y > 10%) (y < 30%))"},
      {"x:1..3", "(and (x > 1) (x < 3))"},
      {"x:-1.5...5", "(and (x > -1.5) (x < 0.5))"},
      {"box(0,0,0,1,1,1)", "(box 0 0 0 | 1 1 1)"},
      {"box( -10%, 0 ,-10%, 10%,5%,1e1% )", "(box -10% 0 -10% | 10% 5% 10%)"},
      {"sphere(1,2,3,0.5)", "(sphere 1 2 3 | 0.5)"},
      {"sphere(0,10%,0,5%)", "(sphere 0 10% 0 | 5%)"},
      {"nearest(0.1,0.2,0.3)", "(nearest 0.1 0.2 0.3)"},
      {"vertices(../a b(1).txt)", "(vertices '../a b(1).txt')"},
      {"group( left arm )", "(group 'left arm')"},
      {"(((y<1)))", "(y < 1)"},
      {"not x<1", "(not (x < 1))"},
      {"not not x<1", "(not (not (x < 1)))"},
  };
  for (const auto& [text, tree] : forms) EXPECT_EQ(tree_of(text), tree) << text;
}

TEST(Selection, BindsNotBeforeAndBeforeOr) {
  EXPECT_EQ(tree_of("x<1 or y<2 and z<3"), "(or (x < 1) (and (y < 2) (z < 3)))");
  EXPECT_EQ(tree_of("not x<1 and y<2"), "(and (not (x < 1)) (y < 2))");
  EXPECT_EQ(tree_of("(x<1 or y<2)and(z<3)"), "(and (or (x < 1) (y < 2)) (z < 3))");
  EXPECT_EQ(tree_of("x<1 and y<2 and z<3"), "(and (x < 1) (y < 2) (z < 3))");
  EXPECT_EQ(tree_of("not(x<1 or y<2)"), "(not (or (x < 1) (y < 2)))");
}

struct Mistake {
  std::string text;
  int column;
  std::string words;
};

TEST(Selection, TellsTheColumnAndTheMend) {
  const Mistake mistakes[] = {
      {"", 1, "a selection is missing here; allowed: x, y, z, box"},
      {"y", 1, "incomplete: quote it"},
      {"y ", 1, "incomplete: quote it"},
      {"x<1 and y", 9, "incomplete: quote it"},
      {"(y)", 2, "incomplete: quote it"},
      {"y<", 3, "incomplete: a length is missing after '<'"},
      {"y<<10%", 3, "a length is missing after '<'"},
      {"y=3", 2, "expected <, <=, >, >="},
      {"y<abc", 3, "'abc' is not a length"},
      {"y<nan", 3, "'nan' is not a length"},
      {"y<1e400", 3, "'1e400' is not a length"},
      {"y<1 2", 5, "'2' is left over; allowed: and, or, the end"},
      {"y<1)", 4, "')' is left over"},
      {"y<1 AND x<2", 5, "'AND x<2' is left over"},
      {"Y<1", 1,
       "unknown 'Y'; allowed: x, y, z, box, sphere, nearest, vertices, group, not; did "
       "you mean 'y'?"},
      {"spere(0,0,0,1)", 1, "did you mean 'sphere'?"},
      {"verts(a)", 1, "did you mean 'vertices'?"},
      {"NOT x<1", 1, "did you mean 'not'?"},
      {"and x<1", 1, "a selection is missing here"},
      {"x<1 and", 8, "a selection is missing here"},
      {"x<1 or or y<1", 8, "a selection is missing here"},
      {"(x<1", 5, "a ')' is missing"},
      {"y:10%", 6, "'..' is missing"},
      {"y:..", 5, "a length is missing after '..'"},
      {"y:", 3, "a length is missing after ':'"},
      {"y:30%..10%", 1, "the range is empty"},
      {"box 1", 5, "a '(' is missing; allowed: box(x0,y0,z0,x1,y1,z1)"},
      {"box(0,0,0,1,1)", 15, "5 lengths, must be 6: box(x0,y0,z0,x1,y1,z1)"},
      {"box(0,0,0,1,1,1", 16, "a ',' or ')' is missing"},
      {"box(0,,0,1,1,1)", 7, "a length is missing after ','"},
      {"sphere()", 8, "a length is missing after '('"},
      {"nearest(1,2)", 13, "2 lengths, must be 3"},
      {"group(arm", 10, "a ')' is missing"},
      {"vertices a", 10, "a '(' is missing"},
  };
  for (const auto& [text, column, words] : mistakes) {
    const std::string expected =
        "scene.yaml:8:13: in the selection '" + text + "', column " + std::to_string(column) + ": ";
    const std::string message = message_of(text);
    EXPECT_EQ(message.substr(0, expected.size()), expected);
    EXPECT_NE(message.find(words), std::string::npos) << message;
  }
}

TEST(Selection, RefusesWhatSelectsNothingSensible) {
  const std::pair<std::string, std::string> mistakes[] = {
      {"box(1,0,0,0,1,1)", "along x the lower corner 1 is above the upper corner 0"},
      {"box(0,0,0,10%,10%,10%)", "both in percent (0% is the centre) or none"},
      {"box(10%,1,0,20%,2,0)", "1 stands beside a percent"},
      {"sphere(0,0,0,0)", "the radius = 0, must be > 0"},
      {"sphere(0,0,0,-5%)", "the radius = -5%, must be > 0"},
      {"nearest(5%,1,0)", "1 stands beside a percent"},
      {"group()", "a name is missing"},
      {"vertices( )", "a name is missing"},
  };
  for (const auto& [text, words] : mistakes)
    EXPECT_NE(message_of(text).find(words), std::string::npos) << message_of(text);
}

TEST(Selection, RefusesBombs) {
  const auto repeated = [](const std::string& part, int times) {
    std::string text;
    for (int i = 0; i < times; ++i) text += part;
    return text;
  };
  for (const std::string part : {"(", "not ", "not("}) {
    const std::string shallow = repeated(part, 1000);
    EXPECT_NE(message_of(shallow).find("nested deeper than 64"), std::string::npos) << part;
  }
  const std::string long_text = repeated("x<1 or ", 1 << 16) + "x<1";
  EXPECT_NE(message_of(long_text).find("more than 65536 bytes"), std::string::npos);
  EXPECT_EQ(parse_selection(repeated("x<1 or ", 5000) + "x<1", place).parts.size(), 5001u);
}

}  // namespace
}  // namespace supple
