#include "io/picture/picture.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "io/errors.h"
#include "tests/support/shapes.h"
#include "tests/support/silhouette.h"
#include "tests/support/temporary_folder.h"

namespace supple {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Silhouette whole_silhouette(const Picture& picture, const PictureOptions& options) {
  return silhouette(picture, empty_picture(options), 0, picture.width);
}

/// Pixels that are clearly more red than green and blue, and so on for the other channels.
int pixels_of_hue(const Picture& picture, int channel) {
  int count = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    const int other =
        std::max(picture.rgb[i + (channel + 1) % 3], picture.rgb[i + (channel + 2) % 3]);
    if (picture.rgb[i + channel] > other + 60) ++count;
  }
  return count;
}

TEST(Render, GivesEveryPixelOfTheSizeAskedFor) {
  const Mesh ball = make_icosphere(1, 2);
  for (const auto& [width, height] : {std::pair{64, 48}, {321, 203}, {1280, 720}}) {
    const Picture picture = render({{.mesh = &ball}}, without_shadow(width, height));
    EXPECT_EQ(picture.width, width);
    EXPECT_EQ(picture.height, height);
    EXPECT_EQ(picture.rgb.size(), 3u * width * height);
  }
}

TEST(Render, BackgroundIsNearWhiteAndLighterAbove) {
  const Picture picture = empty_picture(without_shadow());
  EXPECT_GT(*std::min_element(picture.rgb.begin(), picture.rgb.end()), 220);
  EXPECT_GT(picture.rgb.front(), picture.rgb.back());
}

TEST(Render, SphereIsADiscThatFillsThePictureButForItsMargin) {
  const PictureOptions options = without_shadow();
  const Mesh ball = make_icosphere(3, 5);
  const Silhouette seen = whole_silhouette(render({{.mesh = &ball}}, options), options);
  const double radius = 0.5 * 0.86 * options.height;  // 7 % stay free above and below
  EXPECT_NEAR(seen.area / (std::numbers::pi * radius * radius), 1, 0.02);
  EXPECT_NEAR(seen.width(), 2 * radius, 2);
  EXPECT_NEAR(seen.height(), 2 * radius, 2);
  EXPECT_NEAR(seen.left + seen.right + 1, options.width, 2);
  EXPECT_NEAR(seen.top + seen.bottom + 1, options.height, 2);
}

TEST(Render, ItemsStandSideBySideInOneScale) {
  const PictureOptions options = without_shadow();
  const Mesh large = make_icosphere(2, 4), small = make_icosphere(1, 4);
  const Picture empty = empty_picture(options);
  const Picture same = render({{.mesh = &large}, {.mesh = &large}}, options);
  const Silhouette left = silhouette(same, empty, 0, 320),
                   right = silhouette(same, empty, 320, 640);
  EXPECT_GT(left.area, 1000);
  EXPECT_EQ(left.area, right.area);
  EXPECT_EQ(left.left + 320, right.left);
  EXPECT_EQ(left.top, right.top);

  const Picture mixed = render({{.mesh = &large}, {.mesh = &small}}, options);
  EXPECT_EQ(silhouette(mixed, empty, 0, 320).area, left.area);
  EXPECT_NEAR(silhouette(mixed, empty, 320, 640).area, left.area / 4.0, 0.02 * left.area);
}

TEST(Render, IsTheSameTwice) {
  const Mesh torus = make_torus(1, 0.4, 90, 40);
  const std::vector<PictureItem> items = {{.mesh = &torus, .label = "Twice"}};
  EXPECT_EQ(render(items).rgb, render(items).rgb);
}

TEST(Render, DoesNotDependOnUnitsOrDistanceFromTheOrigin) {
  const PictureOptions options = without_shadow();
  const Mesh torus = make_torus(1, 0.4, 60, 30);
  const Silhouette reference = whole_silhouette(render({{.mesh = &torus}}, options), options);
  for (const double scale : {1e-9, 1e12}) {
    Mesh scaled = torus;
    scaled.positions *= scale;
    scaled.positions.rowwise() += Vec3(1e5, -2e5, 6e5).transpose() * scale;
    const Silhouette seen = whole_silhouette(render({{.mesh = &scaled}}, options), options);
    EXPECT_NEAR(seen.area, reference.area, 0.002 * reference.area) << scale;
  }
}

TEST(Render, NothingIsCutOffWhicheverWayItLooks) {
  PictureOptions options = without_shadow();
  const Mesh bar = make_bar(Vec3(5, 1, 0.3), {10, 2, 1});
  for (const Vec3& up : {Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 0, 0)})
    for (const double azimuth : {0.0, 75.0, 200.0})
      for (const double elevation : {-90.0, 20.0, 90.0}) {
        options.camera = {azimuth, elevation, up};
        const Silhouette seen = whole_silhouette(render({{.mesh = &bar}}, options), options);
        EXPECT_GT(seen.area, 500);
        EXPECT_GE(seen.left, 10);
        EXPECT_LT(seen.right, options.width - 10);
        EXPECT_GE(seen.top, 10);
        EXPECT_LT(seen.bottom, options.height - 10);
      }
}

TEST(Render, TheUpAxisPointsUpInThePicture) {
  PictureOptions options = without_shadow();
  const Mesh post = make_box(Vec3(1, 1, 8));
  options.camera.up = Vec3::UnitZ();
  const Silhouette standing = whole_silhouette(render({{.mesh = &post}}, options), options);
  EXPECT_GT(standing.height(), 4 * standing.width());
  options.camera = {.azimuth_deg = 90, .up = Vec3::UnitY()};
  const Silhouette lying = whole_silhouette(render({{.mesh = &post}}, options), options);
  EXPECT_GT(lying.width(), 3 * lying.height());
}

TEST(Render, MarkersShowInTheirColourAndOnlyWhereTheyCanBeSeen) {
  const PictureOptions options = without_shadow();
  const Mesh ball = make_icosphere(1, 4);
  const auto picture_with = [&](const Vec3& place) {
    PictureItem item{.mesh = &ball};
    item.markers.push_back({.positions = place.transpose(), .color = {0, 0, 1}});
    return render({item}, options);
  };
  const double a = options.camera.azimuth_deg * std::numbers::pi / 180;
  const Vec3 nearest(std::sin(a), 0, std::cos(a));
  EXPECT_GT(pixels_of_hue(picture_with(nearest), 2), 15);
  EXPECT_EQ(pixels_of_hue(picture_with(-nearest), 2), 0);
  EXPECT_EQ(pixels_of_hue(render({{.mesh = &ball}}, options), 2), 0);
}

TEST(Render, AMarkersRadiusIsALength) {
  const PictureOptions options = without_shadow();
  PictureItem item;
  item.markers.push_back({.positions = Points::Zero(1, 3), .radius = 0.5});
  item.markers.push_back({.positions = Vec3(5, 0, 0).transpose(), .radius = 0.1});
  const Picture picture = render({item}, options);
  const Picture empty = empty_picture(options);
  const int large = silhouette(picture, empty, 0, 320).area;
  const int small = silhouette(picture, empty, 320, 640).area;
  EXPECT_NEAR(std::sqrt(static_cast<double>(large) / small), 5, 0.5);
}

TEST(Render, ColoursComeFromTheItemThenFromTheMesh) {
  const PictureOptions options = without_shadow();
  Mesh ball = make_icosphere(1, 3);
  ball.colors.values = Eigen::RowVector4d(0, 0.7, 0, 1).replicate(ball.positions.rows(), 1);
  EXPECT_GT(pixels_of_hue(render({{.mesh = &ball}}, options), 1), 10000);
  PictureItem item{.mesh = &ball};
  item.vertex_colors.assign(ball.positions.rows(), Color{0.8f, 0, 0});
  EXPECT_GT(pixels_of_hue(render({item}, options), 0), 10000);
  EXPECT_EQ(pixels_of_hue(render({item}, options), 1), 0);
}

TEST(Render, PointCloudsAreBalls) {
  const PictureOptions options = without_shadow();
  Mesh cloud = make_icosphere(1, 4);
  cloud.face_vertices.clear();
  cloud.face_starts = {0};
  const Silhouette seen = whole_silhouette(render({{.mesh = &cloud}}, options), options);
  EXPECT_GT(seen.area, 10000);
  EXPECT_NEAR(seen.width(), seen.height(), 4);
}

TEST(Render, LeavesOutWhatIsNotFinite) {
  const PictureOptions options = without_shadow();
  Mesh mesh = make_icosphere(1, 4);
  const Silhouette whole = whole_silhouette(render({{.mesh = &mesh}}, options), options);
  mesh.positions(17, 1) = nan;
  mesh.positions(40, 0) = std::numeric_limits<double>::infinity();
  const Silhouette holed = whole_silhouette(render({{.mesh = &mesh}}, options), options);
  EXPECT_NEAR(holed.area, whole.area, 0.02 * whole.area);

  mesh.positions.setConstant(nan);
  const Mesh nothing;
  EXPECT_EQ(render({{.mesh = &mesh}, {.mesh = &nothing}}, options).rgb, empty_picture(options).rgb);
}

TEST(Render, ShapesWithoutExtentDrawWithoutError) {
  Mesh flat = make_mesh({{0, 0, 0}, {0, 1, 0}, {0, 2, 0}}, {{0, 1, 2}});
  Mesh point = make_mesh({{1, 2, 3}}, {});
  EXPECT_EQ(render({{.mesh = &flat}, {.mesh = &point}}).width, 1280);
}

TEST(Render, GroundShadowDarkensTheGroundBelow) {
  PictureOptions options = without_shadow();
  const Mesh box = make_box(Vec3(1, 1, 1));
  const Picture bare = render({{.mesh = &box}}, options);
  options.ground_shadow = true;
  const Picture shaded = render({{.mesh = &box}}, options);
  const Silhouette shadow = silhouette(shaded, bare, 0, options.width);
  EXPECT_GT(shadow.area, 500);
  EXPECT_GT(shadow.top, options.height / 2);
}

TEST(Render, LabelsStandBelowTheirViews) {
  const PictureOptions options = without_shadow();
  const Mesh ball = make_icosphere(1, 3);
  const Picture picture = render({{.mesh = &ball, .label = "before"}, {.mesh = &ball}}, options);
  const Picture empty = empty_picture(options);
  const auto lower_edge = [&](int from, int to) {
    return silhouette(picture, empty, from, to).bottom;
  };
  EXPECT_GT(lower_edge(0, 320), options.height - 40);
  EXPECT_LT(lower_edge(320, 640), options.height - 50);
}

TEST(Render, SaysWhatIsWrongWithTheOptions) {
  const auto message = [](auto change) {
    PictureOptions options;
    change(options);
    return message_of<UsageError>([&] { render({}, options); });
  };
  EXPECT_NE(message([](auto& o) { o.width = 0; }).find("16 to 8192"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.camera.up.setZero(); }).find("up"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.camera.zoom = nan; }).find("zoom"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.camera.elevation_deg = 91; }).find("-90 to 90"),
            std::string::npos);
}

}  // namespace
}  // namespace supple
