#include <cmath>

#include <gtest/gtest.h>

#include "io/chart/log_axis.h"
#include "io/chart/log_log_chart.h"
#include "io/chart/stacked_bars.h"

namespace supple {
namespace {

constexpr Frame frame{100, 80, 500, 380};

std::array<int, 3> pixel(const Picture& picture, int x, int y) {
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * picture.width + x);
  return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

long inked(const Picture& picture) {
  long count = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
    count += picture.rgb[i] + picture.rgb[i + 1] + picture.rgb[i + 2] < 3 * 255;
  return count;
}

template <class Shape>
std::vector<Shape> shapes_of(const Sketch& sketch) {
  std::vector<Shape> shapes;
  for (const SketchShape& shape : sketch.shapes)
    if (const Shape* each = std::get_if<Shape>(&shape)) shapes.push_back(*each);
  return shapes;
}

TEST(LogAxis, EqualRatiosAreEqualDistances) {
  const LogAxis axis(1e-3, 10, 400, 0);
  EXPECT_EQ(axis.at(1e-3), 400);
  EXPECT_EQ(axis.at(10), 0);
  EXPECT_NEAR(axis.at(1e-3) - axis.at(1e-2), axis.at(1) - axis.at(10), 1e-9);
  EXPECT_EQ(axis.at(0), 400) << "what has no logarithm lies at the start";
}

TEST(LogAxis, TicksAreRoundAndWithin) {
  for (const double greatest : {0.03, 1.0, 1e6}) {
    const LogAxis axis(0.011, greatest, 0, 100);
    const std::vector<double> ticks = axis.ticks();
    EXPECT_FALSE(ticks.empty());
    for (const double tick : ticks) {
      EXPECT_GE(tick, axis.least());
      EXPECT_LE(tick, axis.greatest());
    }
  }
  EXPECT_EQ(tick_text(0.02), "0.02");
  EXPECT_EQ(tick_text(500), "500");
  EXPECT_EQ(tick_text(1e-7), "1e-7");
  EXPECT_EQ(tick_text(2e5), "2e5");
}

TEST(Rasterize, FillsAnAreaAndNothingElse) {
  Sketch sketch{40, 30};
  sketch.add(SketchArea{Frame{10, 10, 20, 20}.corners(), {1, 0, 0}});
  const Picture picture = rasterize(sketch);
  EXPECT_EQ(inked(picture), 100);
  EXPECT_EQ(pixel(picture, 15, 15), (std::array<int, 3>{255, 0, 0}));
  EXPECT_EQ(pixel(picture, 25, 15), (std::array<int, 3>{255, 255, 255}));
}

TEST(Rasterize, CircleHasItsArea) {
  Sketch sketch{100, 100};
  sketch.add(SketchCircle{{50, 50}, 30, {0, 0, 0}});
  const Picture picture = rasterize(sketch);
  double ink = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) ink += 1 - picture.rgb[i] / 255.0;
  EXPECT_NEAR(ink, 900 * M_PI, 5);
}

TEST(Rasterize, DashesCoverHalfOfALine) {
  const auto ink = [](double dash) {
    Sketch sketch{220, 20};
    sketch.add(SketchLine{.points = {{10, 10}, {210, 10}}, .width = 1, .dash = dash});
    return inked(rasterize(sketch));
  };
  EXPECT_NEAR(static_cast<double>(ink(10)) / static_cast<double>(ink(0)), 0.55, 0.08);
}

TEST(Rasterize, ShapesBeyondTheEdgeAreCut) {
  Sketch sketch{20, 20};
  sketch.add(SketchLine{.points = {{-50, -50}, {70, 70}}, .width = 3});
  sketch.add(SketchText{{-30, 5}, "left of it", SketchText::Anchor::start});
  sketch.add(SketchCircle{{1e6, 1e6}, 5, {0, 0, 0}});
  EXPECT_GT(inked(rasterize(sketch)), 20);
}

TEST(Svg, EscapesTextAndMendsBytes) {
  EXPECT_EQ(xml_text("a<b & \"c\""), "a&lt;b &amp; &quot;c&quot;");
  EXPECT_EQ(xml_text("ä±测"), "ä±测");
  EXPECT_EQ(xml_text("\xff\x01"), "\xEF\xBF\xBD\xEF\xBF\xBD");
  EXPECT_EQ(xml_text("\xed\xa0\x80x"), "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBDx");  // a surrogate
  EXPECT_EQ(xml_text("\xc3"), "\xEF\xBF\xBD");
}

LogLogChart falling_chart() {
  LogLogChart chart{"title", "error", "seconds", {{"N", {0, 0, 1}, {}, 0}}};
  for (const double x : {0.1, 0.05, 0.02, 0.01})
    chart.curves[0].points.push_back({x, 1 / x, 0.9 / x, 1.1 / x, "n"});
  return chart;
}

TEST(LogLogChart, ErrorFallsToTheRightAndTimeGrowsUpwards) {
  Sketch sketch{600, 500};
  draw(falling_chart(), frame, sketch);
  const auto points = shapes_of<SketchCircle>(sketch);
  ASSERT_EQ(points.size(), 4u);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_GT(points[i].center.x(), frame.left);
    EXPECT_LT(points[i].center.x(), frame.right);
    if (i == 0) continue;
    EXPECT_GT(points[i].center.x(), points[i - 1].center.x());
    EXPECT_LT(points[i].center.y(), points[i - 1].center.y());
  }
}

TEST(LogLogChart, ShowsRingBandSlopeAndFailures) {
  LogLogChart chart = falling_chart();
  Sketch plain{600, 500};
  draw(chart, frame, plain);
  chart.ring = chart.curves[0].points[1];
  chart.band = 0.015;
  chart.slope = {-1, "slope"};
  chart.failures = {{"solver=broken", {1, 0, 0}}};
  Sketch full{600, 500};
  draw(chart, frame, full);
  EXPECT_EQ(shapes_of<SketchCircle>(full).size(), shapes_of<SketchCircle>(plain).size() + 1);
  const auto areas = shapes_of<SketchArea>(full);
  ASSERT_EQ(areas.size(), 1u);
  EXPECT_EQ(areas[0].corners[1].x(), frame.right) << "the band holds the least errors";
  bool cross_on_top = false;
  for (const SketchLine& line : shapes_of<SketchLine>(full))
    cross_on_top |=
        line.color == Color{1, 0, 0} && (line.points[0] + line.points[1]).y() / 2 == frame.top;
  EXPECT_TRUE(cross_on_top);
}

TEST(LogLogChart, HollowPointsHaveAHole) {
  LogLogChart chart = falling_chart();
  chart.curves[0].points[2].mark = ChartPoint::Mark::hollow;
  Sketch sketch{600, 500};
  draw(chart, frame, sketch);
  const auto circles = shapes_of<SketchCircle>(sketch);
  ASSERT_EQ(circles.size(), 5u);
  EXPECT_EQ(circles[3].center, circles[2].center);
  EXPECT_LT(circles[3].radius, circles[2].radius);
  EXPECT_EQ(circles[3].color, (Color{1, 1, 1}));
}

TEST(LogLogChart, IsDrawnOfNothingAndOfValuesWithoutLogarithm) {
  LogLogChart chart{"title", "error", "seconds", {{"N", {0, 0, 1}, {}, 0}}};
  Sketch empty{600, 500};
  draw(chart, frame, empty);
  chart.curves[0].points = {{0, 1, 1, 1}, {-1, 2, 2, 2}, {std::nan(""), 1, 1, 1}, {0.1, 1, 1, 1}};
  Sketch sketch{600, 500};
  draw(chart, frame, sketch);
  for (const char* word : {"inf", "nan"}) EXPECT_EQ(svg(sketch).find(word), std::string::npos);
}

TEST(StackedBars, PartsFillTheBar) {
  Sketch sketch{600, 500};
  draw(StackedBars{"time", {"a", "b", "c"}, {{"bar", {1, 0, 3}, "4 s"}}}, frame, sketch);
  const auto areas = shapes_of<SketchArea>(sketch);
  ASSERT_EQ(areas.size(), 2u + 3) << "two parts above nothing, and three patches of the names";
  EXPECT_NEAR(areas[0].corners[1].x(), frame.left + 100, 1e-9);
  EXPECT_NEAR(areas[1].corners[1].x(), frame.right, 1e-9);
}

}  // namespace
}  // namespace supple
