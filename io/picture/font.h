#pragma once

#include <string_view>

#include "io/picture/picture.h"

namespace supple {

constexpr int glyph_width = 9;    ///< [px], the space to the next one included
constexpr int glyph_height = 16;  ///< [px], from the top of a capital to the foot of a "g"

/// True where the letter has ink in this pixel of its cell. Whatever is not printable ASCII looks
/// like "?".
bool glyph_pixel(char letter, int column, int row);

/// One line of text: its middle, its upper edge, and how wide each pixel of the font is drawn.
struct Label {
  std::string_view text;
  int center_x = 0, top = 0;  ///< [px]
  int max_width = 0;          ///< [px]
  int scale = 1;              ///< [px]
};

/// Draws the text; what does not fit into `max_width` is cut off and ends in "...".
void draw_label(const Label& label, Picture& picture);

}  // namespace supple
