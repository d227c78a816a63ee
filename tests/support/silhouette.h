#pragma once

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "io/picture/picture.h"

namespace supple {

/// The pixels in which two pictures of one size differ, and the box around them [px].
struct Silhouette {
  int area = 0;
  int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;

  int width() const { return right - left + 1; }
  int height() const { return bottom - top + 1; }
};

/// The difference within the columns [from, to).
inline Silhouette silhouette(const Picture& picture, const Picture& background, int from, int to) {
  constexpr int noticeable = 6;  // of 255
  Silhouette result;
  for (int y = 0; y < picture.height; ++y)
    for (int x = from; x < to; ++x) {
      const std::size_t i = 3 * (static_cast<std::size_t>(y) * picture.width + x);
      int difference = 0;
      for (std::size_t c = i; c < i + 3; ++c)
        difference = std::max(difference, std::abs(picture.rgb[c] - background.rgb[c]));
      if (difference <= noticeable) continue;
      ++result.area;
      result.left = std::min(result.left, x);
      result.right = std::max(result.right, x);
      result.top = std::min(result.top, y);
      result.bottom = std::max(result.bottom, y);
    }
  return result;
}

/// Nothing but the background, beside which the other pictures can be held.
inline Picture empty_picture(PictureOptions options) {
  return render({}, options);
}

inline PictureOptions without_shadow(int width = 640, int height = 360) {
  PictureOptions options;
  options.width = width;
  options.height = height;
  options.ground_shadow = false;
  return options;
}

}  // namespace supple
