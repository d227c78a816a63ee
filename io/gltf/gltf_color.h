#pragma once

#include <algorithm>
#include <cmath>

namespace supple {

/// sRGB's transfer function (IEC 61966-2-1): vertex colors of glTF are linear light, those of all
/// other formats are what screens take.
inline double linear_from_srgb(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// Its inverse; a multiple of 1/255 comes back from float32 as itself.
inline double srgb_from_linear(double value) {
  value = std::clamp(value, 0.0, 1.0);
  const double srgb = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
  const double byte = std::round(255 * srgb) / 255;
  return std::abs(srgb - byte) < 1e-6 ? byte : srgb;
}

}  // namespace supple
