#include "io/picture/view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace supple {
namespace {

constexpr double margin = 0.07;            // of a column's width and height, on every side
constexpr double deepest_shadow_room = 2;  // depths drawn, over those that items take

/// Boxes along the camera's axes and the least height of everything that is drawn.
class Extent {
 public:
  Extent(const Mat3& rotation, const Vec3& up) : rotation_(rotation), up_(up) {}

  /// A disc across the vertex's normal, a ball where it has none.
  void extend(const Drawing& drawing, const DrawnVertex& vertex) {
    const Vec3 x = world_position(drawing, vertex), y = rotation_ * x;
    const Vec3 n = Eigen::Map<const Eigen::Vector3f>(vertex.normal.data()).cast<double>();
    const double radius = drawing.size * static_cast<double>(vertex.radius);
    const auto reach = [&](const Vec3& axis) {
      return radius * std::sqrt(std::max(0.0, 1 - std::pow(axis.dot(n), 2)));
    };
    const Vec3 reaches(reach(rotation_.row(0)), reach(rotation_.row(1)), reach(rotation_.row(2)));
    seen.extend(y - reaches);
    seen.extend(y + reaches);
    ground = std::min(ground, up_.dot(x) - reach(up_));
  }

  Box seen;
  double ground = std::numeric_limits<double>::infinity();

 private:
  Mat3 rotation_;
  Vec3 up_;
};

Extent measure(const std::vector<Drawing>& drawings, const Mat3& rotation, const Vec3& up) {
  Extent extent(rotation, up);
  for (const Drawing& drawing : drawings) {
    const auto extend = [&](const std::vector<DrawnVertex>& vertices) {
      for (const DrawnVertex& vertex : vertices) extent.extend(drawing, vertex);
    };
    extend(drawing.vertices);
    extend(drawing.splats);
    extend(drawing.balls);
    for (const std::vector<DrawnVertex>& balls : drawing.markers) extend(balls);
    for (const DrawnLines& lines : drawing.lines) extend(lines.ends);
    for (const DrawnSheet& sheet : drawing.sheets) extend(sheet.vertices);
  }
  return extent;
}

}  // namespace

Mat3 camera_rotation(const Camera& camera) {
  const double a = camera.azimuth_deg * std::numbers::pi / 180;
  const double e = camera.elevation_deg * std::numbers::pi / 180;
  const Vec3 up = camera.up.normalized();
  const Vec3 side = std::abs(up.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 front = side.cross(up).normalized();
  const Vec3 right = up.cross(front);
  Mat3 rotation;
  rotation.row(0) = std::cos(a) * right - std::sin(a) * front;
  rotation.row(2) = std::cos(e) * (std::cos(a) * front + std::sin(a) * right) + std::sin(e) * up;
  rotation.row(1) = rotation.row(2).cross(rotation.row(0));
  return rotation;
}

View fit_view(const std::vector<Drawing>& drawings, const PictureOptions& options,
              int label_height) {
  View view;
  view.rotation = camera_rotation(options.camera);
  view.up = options.camera.up.normalized();
  const int columns = std::max<int>(1, static_cast<int>(drawings.size()));
  view.column_width = options.width / columns;
  view.height = options.height;
  view.label_height = label_height;
  const Extent extent = measure(drawings, view.rotation, view.up);
  if (extent.seen.empty()) return view;

  view.center = view.rotation.transpose() * extent.seen.center();
  view.ground = extent.ground;
  const Vec3 size = extent.seen.size();
  const double largest = size.maxCoeff() > 0 ? size.maxCoeff() : 1;
  const double wide = std::max(size.x(), 1e-3 * largest);
  const double tall = std::max(size.y(), 1e-3 * largest);
  view.pixels_per_meter = options.camera.zoom * (1 - 2 * margin) *
                          std::min(view.column_width / wide, (view.height - label_height) / tall);
  view.depth = deepest_shadow_room * std::max(size.norm(), largest);
  return view;
}

Eigen::Vector2d pixel_of(const Vec3& x, const View& view) {
  const Vec3 seen = view.pixels_per_meter * view.rotation * (x - view.center);
  return {0.5 * view.column_width + seen.x(), 0.5 * (view.height - view.label_height) - seen.y()};
}

double suitable_radius_px(const Drawing& drawing, const std::vector<DrawnVertex>& points,
                          const View& view) {
  Box seen;
  for (const DrawnVertex& vertex : points)
    seen.extend(view.rotation * world_position(drawing, vertex));
  const double largest = 0.008 * view.height;
  if (seen.diagonal() == 0) return largest;
  const double spacing =
      view.pixels_per_meter * seen.diagonal() / std::sqrt(static_cast<double>(points.size()));
  return std::clamp(0.25 * spacing, 0.2 * largest, largest);
}

Eigen::Matrix4d clip_from(const View& view, const Eigen::Matrix4d& world_from_shape) {
  const Vec3 scale(2 * view.pixels_per_meter / view.column_width,
                   2 * view.pixels_per_meter / view.height, -1 / view.depth);
  Eigen::Matrix4d clip = Eigen::Matrix4d::Identity();
  clip.topLeftCorner<3, 3>() = scale.asDiagonal() * view.rotation;
  clip.topRightCorner<3, 1>() = -clip.topLeftCorner<3, 3>() * view.center;
  clip(1, 3) += static_cast<double>(view.label_height) / view.height;
  return clip * world_from_shape;
}

}  // namespace supple
