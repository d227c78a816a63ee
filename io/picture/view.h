#pragma once

#include <vector>

#include "io/picture/drawing.h"

namespace supple {

/// How space maps to the picture, the same for every item: an orthographic camera, so that
/// lengths can be compared from view to view.
struct View {
  Mat3 rotation;                ///< rows: to the right, up, towards the viewer
  Vec3 up;                      ///< unit vector
  Vec3 center = Vec3::Zero();   ///< [m], drawn in the middle of each column, above its label
  double pixels_per_meter = 1;  ///< [px/m]
  double depth = 1;             ///< [m] half the range of depths drawn
  double ground = 0;            ///< [m] the least up·x of all items
  int column_width = 0;         ///< [px]
  int height = 0;               ///< [px] of the whole picture
  int label_height = 0;         ///< [px] of its lower edge, where the labels stand
};

/// Rows to the right, up, towards the viewer. Without azimuth and elevation the camera looks along
/// −z where y is up and along +y where z is, with x to the right in both.
Mat3 camera_rotation(const Camera& camera);

/// Turns the camera as asked and chooses the scale that fits all drawings into their columns.
View fit_view(const std::vector<Drawing>& drawings, const PictureOptions& options,
              int label_height);

/// Where x [m] is drawn in its column, from the left and from the top [px].
Eigen::Vector2d pixel_of(const Vec3& x, const View& view);

/// A radius in pixels for points that have none of their own: one that suits their number and
/// spread.
double suitable_radius_px(const Drawing& drawing, const std::vector<DrawnVertex>& points,
                          const View& view);

/// Coordinates of a shape → OpenGL's clip coordinates of a column, by way of [m].
Eigen::Matrix4d clip_from(const View& view, const Eigen::Matrix4d& world_from_shape);

}  // namespace supple
