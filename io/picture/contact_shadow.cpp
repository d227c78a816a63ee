#include "io/picture/contact_shadow.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace supple {
namespace {

constexpr double blur_room = 0.15;  // of the larger side, around the surface
constexpr float fading = 4;         // of the shadow over a height as large as the larger side
constexpr int blur_radius = 5;      // [px]; three passes reach three times as far

/// Mean of the 2·blur_radius + 1 bytes around each of a line's, zero beyond its ends.
void blur_line(const std::uint8_t* from, std::uint8_t* to, int stride) {
  constexpr int width = 2 * blur_radius + 1;
  int sum = 0;
  for (int i = 0; i < blur_radius; ++i) sum += from[i * stride];
  for (int i = 0; i < shadow_map_side; ++i) {
    if (i + blur_radius < shadow_map_side) sum += from[(i + blur_radius) * stride];
    to[i * stride] = static_cast<std::uint8_t>((sum + width / 2) / width);
    if (i >= blur_radius) sum -= from[(i - blur_radius) * stride];
  }
}

/// Softens the map as a Gaussian would.
void blur_map(std::vector<std::uint8_t>& map) {
  std::vector<std::uint8_t> other(map.size());
  for (int pass = 0; pass < 3; ++pass) {
    for (int i = 0; i < shadow_map_side; ++i)
      blur_line(&map[i * shadow_map_side], &other[i * shadow_map_side], 1);
    for (int i = 0; i < shadow_map_side; ++i) blur_line(&other[i], &map[i], shadow_map_side);
  }
}

/// The least height above the ground in each cell of the map.
class HeightMap {
 public:
  HeightMap() : heights_(shadow_map_side * shadow_map_side, std::numeric_limits<float>::max()) {}

  /// Enters points of the triangle that lie no farther apart than a cell. Corners hold the place
  /// on the map [cells] and the height.
  void add(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c) {
    const Eigen::Vector3f ab = b - a, ac = c - a;
    const float extent =
        std::max({ab.head<2>().cwiseAbs().maxCoeff(), ac.head<2>().cwiseAbs().maxCoeff(),
                  (ac - ab).head<2>().cwiseAbs().maxCoeff()});
    const int parts = std::max(1, static_cast<int>(std::ceil(extent)));
    for (int i = 0; i <= parts; ++i)
      for (int j = 0; i + j <= parts; ++j)
        add((a + (static_cast<float>(i) * ab + static_cast<float>(j) * ac) / parts).eval());
  }

  float operator[](std::size_t cell) const { return heights_[cell]; }

 private:
  void add(const Eigen::Vector3f& point) {
    const int s = std::clamp(static_cast<int>(point[0]), 0, shadow_map_side - 1);
    const int t = std::clamp(static_cast<int>(point[1]), 0, shadow_map_side - 1);
    float& height = heights_[t * shadow_map_side + s];
    height = std::min(height, point[2]);
  }

  std::vector<float> heights_;
};

/// [m] → place on the map [cells] and height in units of the rectangle's larger side.
Eigen::Affine3d map_from_world(const GroundRect& rect, const Vec3& up) {
  Eigen::Affine3d map;
  map.matrix().row(3) << 0, 0, 0, 1;
  map.linear().row(0) = shadow_map_side * rect.across / rect.across.squaredNorm();
  map.linear().row(1) = shadow_map_side * rect.along / rect.along.squaredNorm();
  map.linear().row(2) = up / std::max(rect.across.norm(), rect.along.norm());
  map.translation() = -map.linear() * rect.corner;
  return map;
}

/// Enters the square in the splat's disc.
void add_splat(const Drawing& drawing, const DrawnVertex& splat,
               const Eigen::Affine3d& map_from_ground, HeightMap& heights) {
  const Vec3 center = world_position(drawing, splat);
  const Vec3 normal = Eigen::Map<const Eigen::Vector3f>(splat.normal.data()).cast<double>();
  const double radius = drawing.size * static_cast<double>(splat.radius);
  const Vec3 across = radius * normal.unitOrthogonal(), along = normal.cross(across);
  const auto place = [&](const Vec3& x) { return (map_from_ground * x).cast<float>().eval(); };
  const Eigen::Vector3f left = place(center - across), right = place(center + across);
  heights.add(left, right, place(center + along));
  heights.add(left, right, place(center - along));
}

}  // namespace

GroundRect ground_below(const Drawing& drawing, const View& view) {
  const Vec3 right = view.rotation.row(0), away = view.up.cross(right);
  Eigen::Vector2d lower = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d upper = -lower;
  for (const auto* vertices : {&drawing.vertices, &drawing.splats})
    for (const DrawnVertex& vertex : *vertices) {
      const Vec3 x = world_position(drawing, vertex);
      const Eigen::Vector2d place(right.dot(x), away.dot(x));
      lower = lower.cwiseMin(place);
      upper = upper.cwiseMax(place);
    }
  const double room = blur_room * (upper - lower).maxCoeff();
  lower.array() -= room;
  upper.array() += room;
  return {lower.x() * right + lower.y() * away + view.ground * view.up,
          (upper.x() - lower.x()) * right, (upper.y() - lower.y()) * away};
}

Eigen::Matrix4d world_from_ground(const GroundRect& rect) {
  Eigen::Matrix4d world = Eigen::Matrix4d::Identity();
  world.col(0).head<3>() = rect.across;
  world.col(1).head<3>() = rect.along;
  world.col(3).head<3>() = rect.corner;
  return world;
}

std::vector<std::uint8_t> contact_shadow(const Drawing& drawing, const GroundRect& rect,
                                         const View& view) {
  const Eigen::Affine3d map_from_ground = map_from_world(rect, view.up);
  std::vector<Eigen::Vector3f> places;
  places.reserve(drawing.vertices.size());
  for (const DrawnVertex& vertex : drawing.vertices)
    places.push_back((map_from_ground * world_position(drawing, vertex)).cast<float>());
  HeightMap heights;
  for (std::size_t i = 0; i < drawing.indices.size(); i += 3)
    heights.add(places[drawing.indices[i]], places[drawing.indices[i + 1]],
                places[drawing.indices[i + 2]]);

  for (const DrawnVertex& splat : drawing.splats)
    add_splat(drawing, splat, map_from_ground, heights);

  std::vector<std::uint8_t> map(shadow_map_side * shadow_map_side);
  for (std::size_t cell = 0; cell < map.size(); ++cell)
    map[cell] = static_cast<std::uint8_t>(255 * std::exp(-fading * std::max(0.0f, heights[cell])));
  blur_map(map);
  return map;
}

}  // namespace supple
