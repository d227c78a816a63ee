#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "io/picture/picture.h"
#include "tests/support/shapes.h"
#include "tests/support/silhouette.h"

namespace supple {
namespace {

/// Looks along −z.
PictureOptions looking_along_z() {
  PictureOptions options = without_shadow();
  options.camera.azimuth_deg = options.camera.elevation_deg = 0;
  return options;
}

Mesh cloud_of(const Mesh& mesh) {
  Mesh cloud;
  cloud.positions = mesh.positions;
  return cloud;
}

/// Points of a ball with their normals.
Mesh ball_cloud(int splits) {
  Mesh cloud = cloud_of(make_icosphere(1, splits));
  cloud.normals.values = cloud.positions;
  return cloud;
}

Mesh one_point(const Vec3& normal, double radius) {
  Mesh cloud;
  cloud.positions = Points::Zero(1, 3);
  cloud.normals.values = normal.transpose();
  cloud.radii = Eigen::VectorXd::Constant(1, radius);
  return cloud;
}

Silhouette seen(const Mesh& mesh, const PictureOptions& options) {
  return silhouette(render({{.mesh = &mesh}}, options), empty_picture(options), 0, options.width);
}

TEST(RenderSplats, ABallOfPointsLooksLikeABall) {
  const PictureOptions options = without_shadow();
  const Mesh ball = make_icosphere(1, 5), cloud = ball_cloud(4);
  const Picture surface = render({{.mesh = &ball}}, options);
  Mesh sized = cloud;
  sized.radii = Eigen::VectorXd::Constant(cloud.positions.rows(), 0.06);
  const Picture empty = empty_picture(options);
  const Silhouette whole = silhouette(surface, empty, 0, options.width);
  for (const Mesh& points : {cloud, sized}) {
    const Picture splats = render({{.mesh = &points}}, options);
    const Silhouette drawn = silhouette(splats, empty, 0, options.width);
    EXPECT_NEAR(drawn.area / static_cast<double>(whole.area), 1, 0.03);
    // Inside its rim, nowhere but slightly other than the surface: no hole, no seam.
    const double cx = 0.5 * (whole.left + whole.right), cy = 0.5 * (whole.top + whole.bottom);
    int largest = 0;
    for (int y = whole.top; y <= whole.bottom; ++y)
      for (int x = whole.left; x <= whole.right; ++x) {
        if (std::hypot(x - cx, y - cy) > 0.42 * whole.width()) continue;
        for (int c = 0; c < 3; ++c) {
          const std::size_t i = 3 * (static_cast<std::size_t>(y) * options.width + x) + c;
          largest = std::max(largest, std::abs(splats.rgb[i] - surface.rgb[i]));
        }
      }
    EXPECT_LT(largest, 12);
  }
}

TEST(RenderSplats, AreDiscsAcrossTheirNormals) {
  PictureOptions options = looking_along_z();
  const double radius = 0.5 * 0.86 * options.height;  // the disc's edge touches the margin
  const double disc = std::numbers::pi * radius * radius;
  options.camera.zoom = 40 / radius;
  const double scale = options.camera.zoom * options.camera.zoom;
  for (const double degrees : {0.0, 60.0, 120.0, 180.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    const Silhouette drawn = seen(one_point({std::sin(angle), 0, std::cos(angle)}, 1), options);
    EXPECT_NEAR(drawn.area / (scale * disc * std::abs(std::cos(angle))), 1, 0.03) << degrees;
    EXPECT_NEAR(drawn.height(), 80, 1.5) << degrees;
    EXPECT_NEAR(drawn.width(), 80 * std::abs(std::cos(angle)), 1.5) << degrees;
  }
}

TEST(RenderSplats, PointsWithoutNormalsAreBallsOfTheirRadius) {
  PictureOptions options = looking_along_z();
  options.camera.zoom = 0.2;
  Mesh cloud = one_point({0, 0, 0}, 1);
  const Silhouette zero_normal = seen(cloud, options);
  cloud.normals = {};
  const Silhouette drawn = seen(cloud, options);
  EXPECT_NEAR(drawn.width(), 0.2 * 0.86 * options.height, 1.5);
  EXPECT_NEAR(drawn.area / (std::numbers::pi / 4 * drawn.width() * drawn.width()), 1, 0.05);
  EXPECT_EQ(zero_normal.area, drawn.area);
}

/// Two sheets of points, one behind the other, with gaps between the points of neither.
TEST(RenderSplats, HideWhatLiesBehindThem) {
  const PictureOptions options = looking_along_z();
  Mesh cloud;
  const int side = 40;
  cloud.positions.resize(2 * side * side, 3);
  for (int i = 0; i < 2 * side * side; ++i)
    cloud.positions.row(i) << i % side, i / side % side, i < side * side ? 0 : -4;
  cloud.normals.values = Points::Zero(cloud.positions.rows(), 3);
  cloud.normals.values.col(2).setOnes();
  cloud.colors.values.setZero(cloud.positions.rows(), 4);
  cloud.colors.values.col(3).setOnes();
  cloud.colors.values.col(0).head(side * side).setOnes();
  cloud.colors.values.col(2).tail(side * side).setOnes();
  const Picture picture = render({{.mesh = &cloud}}, options);
  int red = 0, blue = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    red += picture.rgb[i] > picture.rgb[i + 2] + 40;
    blue += picture.rgb[i + 2] > picture.rgb[i] + 40;
  }
  EXPECT_GT(red, 10000);
  EXPECT_EQ(blue, 0);
}

TEST(RenderSplats, StandInTheirColumnsAndHideMarkers) {
  const PictureOptions options = without_shadow();
  const Mesh cloud = ball_cloud(4);
  const Picture empty = empty_picture(options);
  PictureItem marked{.mesh = &cloud};
  marked.markers.push_back({.positions = Points::Zero(1, 3), .color = {0, 0, 1}, .radius = 0.1});
  const Picture picture = render({{.mesh = &cloud}, marked}, options);
  const Silhouette left = silhouette(picture, empty, 0, 320),
                   right = silhouette(picture, empty, 320, 640);
  EXPECT_GT(left.area, 1000);
  EXPECT_EQ(left.area, right.area);
  EXPECT_EQ(left.left + 320, right.left);
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
    ASSERT_LT(picture.rgb[i + 2], picture.rgb[i] + 60);
}

TEST(RenderSplats, AreTheSameTwiceAndAtEveryScale) {
  const PictureOptions options = without_shadow();
  const Mesh cloud = ball_cloud(3);
  EXPECT_EQ(render({{.mesh = &cloud}}, options).rgb, render({{.mesh = &cloud}}, options).rgb);
  Mesh far = cloud;
  far.positions = (1e-3 * far.positions).rowwise() + Eigen::RowVector3d(6e2, -3e2, 1e2);
  EXPECT_NEAR(seen(far, options).area / static_cast<double>(seen(cloud, options).area), 1, 0.005);
}

TEST(RenderSplats, LeaveOutWhatIsNotFinite) {
  const PictureOptions options = without_shadow();
  Mesh cloud = ball_cloud(3);
  const Silhouette whole = seen(cloud, options);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  cloud.positions.row(5).setConstant(nan);
  cloud.normals.values.row(6).setConstant(nan);
  EXPECT_NEAR(seen(cloud, options).area / static_cast<double>(whole.area), 1, 0.02);
}

}  // namespace
}  // namespace supple
