#include "modeler/domain/cut_cube.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace supple {

namespace {

using Tetrahedron = std::array<Vec3, 4>;

/// Sums volumes and first moments of bodies.
struct Moments {
  double volume = 0;
  Vec3 first = Vec3::Zero();

  void add(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const double part = std::abs((b - a).dot((c - a).cross(d - a))) / 6;
    volume += part;
    first += part / 4 * (a + b + c + d);
  }
};

/// Adds the part of a tetrahedron where the linear function with `values` at its corners is ≤ 0.
void add_below(Tetrahedron corners, std::array<double, 4> values, Moments& moments) {
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 3; j > i; --j)
      if (values[j] < values[j - 1]) {
        std::swap(values[j], values[j - 1]);
        std::swap(corners[j], corners[j - 1]);
      }
  const auto below = std::count_if(values.begin(), values.end(), [](double v) { return v <= 0; });
  const auto& [a, b, c, d] = corners;
  const auto zero = [&](std::size_t i, std::size_t j) -> Vec3 {
    return corners[i] + values[i] / (values[i] - values[j]) * (corners[j] - corners[i]);
  };
  if (below == 4) moments.add(a, b, c, d);
  if (below == 1) moments.add(a, zero(0, 1), zero(0, 2), zero(0, 3));
  if (below == 2) {
    const Vec3 ac = zero(0, 2), ad = zero(0, 3), bc = zero(1, 2), bd = zero(1, 3);
    moments.add(a, b, bc, bd);
    moments.add(a, ac, ad, bd);
    moments.add(a, ac, bc, bd);
  }
  if (below == 3) {
    const Vec3 ad = zero(0, 3), bd = zero(1, 3), cd = zero(2, 3);
    moments.add(a, b, c, cd);
    moments.add(a, b, bd, cd);
    moments.add(a, ad, bd, cd);
  }
}

}  // namespace

CutVolume cut_cube(const Vec3& normal, double offset, double half_width) {
  // Six tetrahedra about a diagonal: from one corner to the other along the three axes in turn.
  constexpr std::array<std::array<int, 3>, 6> ways = {
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  Moments moments;
  for (const auto& way : ways) {
    Tetrahedron corners;
    std::array<double, 4> values;
    Vec3 corner = Vec3::Constant(-half_width);
    for (std::size_t k = 0; k < 4; ++k) {
      if (k > 0) corner[way[k - 1]] = half_width;
      corners[k] = corner;
      values[k] = normal.dot(corner) - offset;
    }
    add_below(corners, values, moments);
  }
  if (!(moments.volume > 0)) return {};
  return {moments.volume, moments.first / moments.volume};
}

}  // namespace supple
