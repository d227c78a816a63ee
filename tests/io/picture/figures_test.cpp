// What pictures draw beside surfaces and balls: lines, sheets, veils, cuts, notes, axes.

#include <gtest/gtest.h>

#include "io/picture/axes.h"
#include "io/picture/view.h"
#include "tests/support/shapes.h"
#include "tests/support/silhouette.h"

namespace supple {
namespace {

PictureOptions from_the_front() {
  PictureOptions options = without_shadow();
  options.camera.azimuth_deg = options.camera.elevation_deg = 0;
  return options;
}

std::array<int, 3> pixel(const Picture& picture, int x, int y) {
  const std::size_t i = 3 * (static_cast<std::size_t>(y) * picture.width + x);
  return {picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]};
}

std::array<int, 3> middle(const Picture& picture) {
  return pixel(picture, picture.width / 2, picture.height / 2);
}

int reds(const Picture& picture) {
  int count = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
    count += picture.rgb[i] > picture.rgb[i + 1] + 100 && picture.rgb[i] > picture.rgb[i + 2] + 100;
  return count;
}

Lines line(const Vec3& a, const Vec3& b, double width) {
  Lines lines{{}, {1, 0, 0}, width};
  lines.ends.resize(2, 3);
  lines.ends << a.transpose(), b.transpose();
  return lines;
}

TEST(RenderFigures, LinesHaveTheWidthAskedFor) {
  PictureItem item;
  item.lines = {line({-1, 0, 0}, {1, 0, 0}, 4)};
  const PictureOptions options = from_the_front();
  const double length = 0.86 * options.width;
  EXPECT_NEAR(reds(render({item}, options)), 4 * length, 0.05 * 4 * length);
  item.lines = {line({-1, 0, 0}, {1, 0, 0}, 8)};
  EXPECT_NEAR(reds(render({item}, options)), 8 * length, 0.05 * 8 * length);
}

TEST(RenderFigures, AVeilLetsWhatIsInsideThrough) {
  const Mesh ball = make_icosphere(1, 4);
  PictureItem item;
  item.mesh = &ball;
  item.markers = {{Points::Zero(1, 3), {1, 0, 0}, 0.2}};
  EXPECT_EQ(reds(render({item}, from_the_front())), 0) << "an opaque ball hides it";
  item.opacity = 0.2;
  EXPECT_GT(reds(render({item}, from_the_front())), 1000);
}

TEST(RenderFigures, AVeilIsLaidOverOnlyOnce) {
  // A ball within a ball: only the nearer side of the outer one tints the background.
  const Mesh outer = make_icosphere(1, 4);
  Mesh both = outer;
  const int count = static_cast<int>(outer.positions.rows());
  both.positions.conservativeResize(2 * count, 3);
  both.positions.bottomRows(count) = 0.5 * outer.positions;
  for (const int vertex : outer.face_vertices) both.face_vertices.push_back(vertex + count);
  for (int face = 0; face < outer.face_count(); ++face)
    both.face_starts.push_back(both.face_starts.back() + 3);
  const auto at = [&](const Mesh& mesh) {
    return middle(render({{.mesh = &mesh, .opacity = 0.3}}, from_the_front()));
  };
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(at(outer)[c], at(both)[c], 2);
}

TEST(RenderFigures, ACutLeavesOutItsHalf) {
  const Mesh ball = make_icosphere(1, 4);
  PictureOptions options = from_the_front();
  PictureItem item;
  item.mesh = &ball;
  item.cut = HalfSpace{{3, 0, 0}, 0};
  const Picture empty = empty_picture(options);
  const Silhouette left = silhouette(render({item}, options), empty, 0, options.width);
  item.cut.reset();
  const Silhouette whole = silhouette(render({item}, options), empty, 0, options.width);
  EXPECT_NEAR(2.0 * left.area / whole.area, 1, 0.03);
  EXPECT_LT(left.right, options.width / 2 + 3);
  EXPECT_EQ(left.left, whole.left);
}

TEST(RenderFigures, SheetsKeepTheirColours) {
  PictureItem item;
  Sheet sheet;
  sheet.positions.resize(4, 3);
  sheet.positions << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0;
  sheet.triangles.resize(2, 3);
  sheet.triangles << 0, 1, 2, 0, 2, 3;
  sheet.colors.assign(4, {0.2f, 0.4f, 0.8f});
  item.sheets = {sheet};
  const std::array<int, 3> seen = middle(render({item}, from_the_front()));
  EXPECT_NEAR(seen[0], 51, 2);
  EXPECT_NEAR(seen[1], 102, 2);
  EXPECT_NEAR(seen[2], 204, 2);
}

TEST(RenderFigures, NotesStandWhereTheyAreSaidTo) {
  const Mesh ball = make_icosphere(1, 3);
  const PictureOptions options = from_the_front();
  const Picture bare = render({{.mesh = &ball}}, options);
  PictureItem item;
  item.mesh = &ball;
  item.notes = {{{0.5, -0.5, 0}, "here"}};
  const Silhouette note = silhouette(render({item}, options), bare, 0, options.width);
  const double radius = 0.43 * options.height;
  EXPECT_NEAR(0.5 * (note.left + note.right), options.width / 2.0 + 0.5 * radius, 6);
  EXPECT_NEAR(0.5 * (note.top + note.bottom), options.height / 2.0 + 0.5 * radius, 6);
}

TEST(RenderFigures, AxesNameTheirPercents) {
  PictureItem item;
  Box box;
  box.extend({-1, 0, 0});
  box.extend({1, 4, 2});
  add_axes(box, Camera(), item);
  const auto note = [&](const std::string& text) {
    for (const Note& n : item.notes)
      if (n.text == text) return n.position;
    ADD_FAILURE() << "no note " << text;
    return Vec3(Vec3::Zero());
  };
  // Seen from the side, 80 % of the upright axis stands at 80 % of its way.
  const Mat3 rotation = camera_rotation(Camera());
  const auto height = [&](const Vec3& x) { return (rotation * x).y(); };
  note("x %"), note("z %");
  EXPECT_LT((rotation * note("y %")).x(), (rotation * box.center()).x());
  std::vector<double> heights;
  for (const Note& n : item.notes)
    if (std::abs((rotation * (n.position - note("y %"))).x()) < 0.3)
      heights.push_back(height(n.position));
  EXPECT_GE(heights.size(), 5u);
  EXPECT_EQ(item.lines.size(), 4u) << "three axes and the frame";
}

}  // namespace
}  // namespace supple
