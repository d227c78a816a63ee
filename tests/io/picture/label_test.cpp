#include <set>
#include <string>

#include <gtest/gtest.h>

#include "io/picture/font.h"

namespace supple {
namespace {

std::string glyph(char letter) {
  std::string pixels;
  for (int row = 0; row < glyph_height; ++row)
    for (int column = 0; column < glyph_width; ++column)
      pixels += glyph_pixel(letter, column, row) ? '#' : ' ';
  return pixels;
}

Picture white(int width, int height) {
  return {width, height, std::vector<std::uint8_t>(3 * width * height, 255)};
}

int ink_of(const Picture& picture) {
  int count = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) count += picture.rgb[i] < 128;
  return count;
}

Picture drawn(const Label& label) {
  Picture picture = white(200, 40);
  draw_label(label, picture);
  return picture;
}

TEST(Font, EveryLetterLooksDifferent) {
  std::set<std::string> glyphs;
  for (char letter = ' '; letter <= '~'; ++letter) glyphs.insert(glyph(letter));
  EXPECT_EQ(glyphs.size(), 95u);
}

TEST(Font, TheLIsAnUprightStrokeOnABase) {
  for (int row = 3; row <= 12; ++row) EXPECT_TRUE(glyph_pixel('L', 1, row)) << row;
  for (int column = 1; column <= 7; ++column) EXPECT_TRUE(glyph_pixel('L', column, 12)) << column;
  EXPECT_FALSE(glyph_pixel('L', 5, 6));
}

TEST(Label, DrawsTheInkOfItsLettersAtEveryScale) {
  const int ink = ink_of(drawn({.text = "Ab", .center_x = 100, .top = 2, .max_width = 200}));
  EXPECT_EQ(ink, std::ranges::count(glyph('A') + glyph('b'), '#'));
  const Label large{.text = "Ab", .center_x = 100, .top = 2, .max_width = 200, .scale = 2};
  EXPECT_EQ(ink_of(drawn(large)), 4 * ink);
}

TEST(Label, IsCutToItsWidth) {
  const Label label{.text = "abcdefghij", .center_x = 100, .max_width = 5 * glyph_width};
  EXPECT_EQ(drawn(label).rgb, drawn({.text = "ab...", .center_x = 100, .max_width = 200}).rgb);
}

TEST(Label, ALetterOutsideAsciiIsOneQuestionMark) {
  EXPECT_EQ(drawn({.text = "a\xC3\xA9z", .center_x = 100, .max_width = 200}).rgb,
            drawn({.text = "a?z", .center_x = 100, .max_width = 200}).rgb);
}

TEST(Label, StaysInsideThePicture) {
  Picture picture = white(20, 10);
  draw_label({.text = "wide and low", .center_x = 5, .top = -4, .max_width = 400}, picture);
  draw_label({.text = "wide and low", .center_x = 18, .top = 6, .max_width = 400}, picture);
  EXPECT_EQ(picture.rgb.size(), 600u);
  EXPECT_GT(ink_of(picture), 0);
}

}  // namespace
}  // namespace supple
