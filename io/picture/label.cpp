#include <algorithm>
#include <string>

#include "io/picture/font.h"

namespace supple {
namespace {

constexpr std::array<std::uint8_t, 3> ink = {70, 72, 78};

/// `text` with a "?" for each letter outside ASCII, shortened to at most `count` letters.
std::string shown_text(std::string_view text, int count) {
  std::string shown;
  for (const char c : text) {
    const bool continues_letter = (static_cast<unsigned char>(c) & 0xC0) == 0x80;
    if (!continues_letter) shown += c;
  }
  if (static_cast<int>(shown.size()) <= count) return shown;
  return shown.substr(0, std::max(count - 3, 0)) + "...";
}

void fill_square(Picture& picture, int left, int top, int side) {
  for (int y = std::max(top, 0); y < std::min(top + side, picture.height); ++y)
    for (int x = std::max(left, 0); x < std::min(left + side, picture.width); ++x)
      std::copy(ink.begin(), ink.end(), picture.rgb.begin() + 3 * (y * picture.width + x));
}

}  // namespace

void draw_label(const Label& label, Picture& picture) {
  const int advance = glyph_width * label.scale;
  const std::string text = shown_text(label.text, label.max_width / advance);
  int left = label.center_x - advance * static_cast<int>(text.size()) / 2;
  for (const char letter : text) {
    for (int row = 0; row < glyph_height; ++row)
      for (int column = 0; column < glyph_width; ++column)
        if (glyph_pixel(letter, column, row))
          fill_square(picture, left + column * label.scale, label.top + row * label.scale,
                      label.scale);
    left += advance;
  }
}

}  // namespace supple
