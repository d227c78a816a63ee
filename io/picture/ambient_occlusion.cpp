#include "io/picture/ambient_occlusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "solver/core/parallel.h"

namespace supple {
namespace {

constexpr int directions = 4, steps = 6;  // each direction is looked along both ways
constexpr double strength = 0.8;

struct Offset {
  int x, y;
  float inverse_distance;
};
using Offsets = std::array<std::array<Offset, steps>, directions>;

/// Steps that widen with the distance, out to `reach` pixels.
Offsets make_offsets(double reach) {
  Offsets offsets;
  for (int d = 0; d < directions; ++d) {
    const double angle = std::numbers::pi * (d + 0.5) / directions;
    for (int s = 0; s < steps; ++s) {
      const double distance = std::max<double>(s + 1, reach * std::pow((s + 1.0) / steps, 2));
      const int x = static_cast<int>(std::lround(distance * std::cos(angle)));
      const int y = static_cast<int>(std::lround(distance * std::sin(angle)));
      offsets[d][s] = {x, y, static_cast<float>(1 / std::max(1.0, std::hypot(x, y)))};
    }
  }
  return offsets;
}

class Horizons {
 public:
  Horizons(const std::vector<float>& depth, int width, double reach)
      : depth_(depth),
        width_(width),
        height_(static_cast<int>(depth.size()) / width),
        offsets_(make_offsets(reach)),
        reach_(static_cast<float>(reach)) {}

  float depth(int x, int y) const { return depth_[static_cast<std::size_t>(y) * width_ + x]; }

  /// Share of the sky seen, 1 where nothing stands higher.
  float openness(int x, int y) const {
    float open = 0;
    for (const auto& along : offsets_) {
      const float hidden = 0.5f * (horizon(x, y, along, 1) + horizon(x, y, along, -1));
      open += 1 - std::max(0.0f, hidden);
    }
    return open / directions;
  }

 private:
  /// Sine of the horizon's height above the picture's plane; what rises by more than the reach is
  /// another part in front, and counts the less the farther it is.
  float horizon(int x, int y, const std::array<Offset, steps>& along, int sign) const {
    const float here = depth(x, y);
    float slope = -1e3f;
    for (const Offset& offset : along) {
      const int sx = x + sign * offset.x, sy = y + sign * offset.y;
      if (sx < 0 || sx >= width_ || sy < 0 || sy >= height_) break;
      float rise = depth(sx, sy) - here;
      if (rise > reach_) rise = std::max(0.0f, 2 * reach_ - rise);
      slope = std::max(slope, rise * offset.inverse_distance);
    }
    return slope / std::sqrt(1 + slope * slope);
  }

  const std::vector<float>& depth_;
  int width_, height_;
  Offsets offsets_;
  float reach_;
};

}  // namespace

void shade_hollows(const std::vector<float>& depth, Picture& picture) {
  const Horizons horizons(depth, picture.width, picture.height / 22.0);
  parallel_chunks(picture.height, 16, [&](Index begin, Index end) {
    for (int y = static_cast<int>(begin); y < end; ++y)
      for (int x = 0; x < picture.width; ++x) {
        if (std::isinf(horizons.depth(x, y))) continue;
        const double light = 1 - strength * (1 - horizons.openness(x, y));
        const std::size_t first = 3 * (static_cast<std::size_t>(y) * picture.width + x);
        for (std::size_t i = first; i < first + 3; ++i)
          picture.rgb[i] = static_cast<std::uint8_t>(std::lround(light * picture.rgb[i]));
      }
  });
}

}  // namespace supple
