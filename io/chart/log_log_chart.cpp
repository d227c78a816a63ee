#include "io/chart/log_log_chart.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/chart/log_axis.h"

namespace supple {
namespace {

using Anchor = SketchText::Anchor;

constexpr Color grid_color{0.88f, 0.88f, 0.9f}, axis_color{0.35f, 0.35f, 0.38f};
constexpr Color band_color{0.95f, 0.95f, 0.96f}, front_color{0.98f, 0.80f, 0.30f};
constexpr double point_radius = 4, ring_radius = 9, front_width = 11;  // [px]
constexpr double line_height = 20;                                     // [px]

struct Extent {
  double least = std::numeric_limits<double>::infinity(), greatest = 0;

  void add(double value) {
    if (!(value > 0) || !std::isfinite(value)) return;
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }

  /// Widened by a share of itself; around 1 where nothing was added.
  Extent widened() const {
    if (greatest == 0) return {0.5, 2};
    const double factor = std::max(1.25, std::pow(greatest / least, 0.08));
    return {least / factor, greatest * factor};
  }
};

/// Of the solid curves; dashed ones may reach a decade further.
Extent x_extent(const LogLogChart& chart) {
  Extent solid, all;
  for (const ChartCurve& curve : chart.curves)
    for (const ChartPoint& point : curve.points) {
      all.add(point.x);
      if (curve.dash == 0) solid.add(point.x);
    }
  if (solid.greatest == 0) return all.widened();
  all.least = std::max(all.least, solid.least / 10);
  all.greatest = std::min(all.greatest, solid.greatest * 10);
  return all.widened();
}

Extent y_extent(const LogLogChart& chart) {
  Extent extent;
  for (const ChartCurve& curve : chart.curves)
    for (const ChartPoint& point : curve.points)
      for (const double y : {point.y, point.low, point.high}) extent.add(y);
  return extent.widened();
}

class LogLogDrawing {
 public:
  LogLogDrawing(const LogLogChart& chart, const Frame& frame, Sketch& sketch)
      : LogLogDrawing(chart, frame, sketch, x_extent(chart), y_extent(chart)) {}

  void draw() {
    draw_band();
    draw_grid();
    draw_front();
    for (const ChartCurve& curve : chart_.curves) draw_curve(curve);
    draw_ring();
    draw_failures();
    draw_slope();
    draw_titles();
    draw_names();
  }

 private:
  LogLogDrawing(const LogLogChart& chart, const Frame& frame, Sketch& sketch, const Extent& x,
                const Extent& y)
      : chart_(chart),
        frame_(frame),
        sketch_(sketch),
        x_(x.least, x.greatest, frame.right, frame.left),
        y_(y.least, y.greatest, frame.bottom, frame.top + failure_height()) {}

  /// Room for crosses above everything else.
  double failure_height() const { return chart_.failures.empty() ? 0 : 2 * line_height; }

  Pixel at(const ChartPoint& point) const { return {x_.at(point.x), y_.at(point.y)}; }

  void add_line(const Pixel& a, const Pixel& b, const Color& color, double width = 1) {
    sketch_.add(SketchLine{.points = {a, b}, .color = color, .width = width});
  }

  void add_text(const Pixel& at, const std::string& text, Anchor anchor,
                const Color& color = axis_color) {
    sketch_.add(SketchText{at, text, anchor, color});
  }

  void draw_band() {
    if (!(chart_.band > 0)) return;
    const Frame band{x_.at(chart_.band), frame_.top, frame_.right, frame_.bottom};
    if (!(band.right > band.left)) return;
    sketch_.add(SketchArea{band.corners(), band_color});
    add_text({frame_.right - 6, frame_.bottom - 12}, chart_.band_text, Anchor::end);
  }

  void draw_grid() {
    for (const double tick : x_.ticks()) {
      const double x = x_.at(tick);
      add_line({x, frame_.top}, {x, frame_.bottom}, grid_color);
      add_text({x, frame_.bottom + 14}, tick_text(tick), Anchor::middle);
    }
    for (const double tick : y_.ticks()) {
      const double y = y_.at(tick);
      add_line({frame_.left, y}, {frame_.right, y}, grid_color);
      add_text({frame_.left - 8, y}, tick_text(tick), Anchor::end);
    }
    std::vector<Pixel> border = frame_.corners();
    border.push_back(border.front());
    sketch_.add(SketchLine{.points = std::move(border), .color = axis_color});
  }

  void draw_front() {
    SketchLine line{.points = {}, .color = front_color, .width = front_width, .opacity = 0.75};
    for (const ChartPoint& point : chart_.front) line.points.push_back(at(point));
    if (line.points.size() == 1) line.points.push_back(line.points.front() + Pixel(1, 0));
    sketch_.add(line);
  }

  /// Whether a point lies in the chart and not on its edge instead.
  bool is_within(const ChartPoint& point) const {
    return point.x >= x_.least() && point.x <= x_.greatest();
  }

  void draw_curve(const ChartCurve& curve) {
    SketchLine line{.points = {}, .color = curve.color, .width = 2, .dash = curve.dash};
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      const ChartPoint& point = curve.points[i];
      // A dashed curve goes on to the edge once.
      if (curve.dash > 0 && i > 0 && !is_within(point) && !is_within(curve.points[i - 1])) continue;
      line.points.push_back(at(point));
    }
    sketch_.add(line);
    for (const ChartPoint& point : curve.points) {
      if (curve.dash > 0 && !is_within(point)) continue;
      if (point.high > point.low)
        add_line({x_.at(point.x), y_.at(point.low)}, {x_.at(point.x), y_.at(point.high)},
                 curve.color);
      draw_point(at(point), point.mark, curve.color);
    }
    for (const ChartPoint& point : curve.points)
      if (!point.text.empty() && is_within(point)) add_label(at(point), point.text, curve.color);
  }

  void draw_point(const Pixel& at, ChartPoint::Mark mark, const Color& color) {
    sketch_.add(SketchCircle{at, point_radius, color});
    if (mark == ChartPoint::Mark::hollow)
      sketch_.add(SketchCircle{at, point_radius - 1.5, {1, 1, 1}});
  }

  /// Beside a point, where no other label is; else not at all.
  void add_label(const Pixel& point, const std::string& text, const Color& color) {
    const double width = letter_width * static_cast<double>(text.size());
    for (const Pixel& way : {Pixel(8, -11), Pixel(8, 11), Pixel(-8, -11), Pixel(-8, 11)}) {
      const double left = point.x() + way.x() - (way.x() < 0 ? width : 0);
      const double middle = point.y() + way.y();
      const Frame box{left - 4, middle - 8, left + width + 4, middle + 8};
      const auto overlaps = [&](const Frame& other) {
        return box.left < other.right && other.left < box.right && box.top < other.bottom &&
               other.top < box.bottom;
      };
      if (box.right > frame_.right || box.bottom > frame_.bottom ||
          std::any_of(labels_.begin(), labels_.end(), overlaps))
        continue;
      labels_.push_back(box);
      add_text({left, middle}, text, Anchor::start, color);
      return;
    }
  }

  void draw_ring() {
    if (chart_.ring) sketch_.add(SketchCircle{at(*chart_.ring), ring_radius, {0, 0, 0}, 2});
  }

  void draw_failures() {
    double x = frame_.left + 16;
    const double y = frame_.top, arm = 5;
    for (const ChartFailure& failure : chart_.failures) {
      add_line({x - arm, y - arm}, {x + arm, y + arm}, failure.color, 2);
      add_line({x - arm, y + arm}, {x + arm, y - arm}, failure.color, 2);
      const double width = letter_width * static_cast<double>(failure.text.size() + 2);
      const bool fits = x + width < frame_.right;  // else the cross alone
      if (fits) add_text({x - arm, y + 16}, failure.text, Anchor::start, failure.color);
      x = std::min(frame_.right, x + (fits ? width : 3 * arm));
    }
  }

  /// A triangle in the lower left corner: so much along x, by the slope along y.
  void draw_slope() {
    if (!chart_.slope) return;
    const double exponent = std::abs(chart_.slope->exponent);
    const double px_a_decade_x =
        (frame_.right - frame_.left) / std::log10(x_.greatest() / x_.least());
    const double px_a_decade_y =
        (frame_.bottom - frame_.top - failure_height()) / std::log10(y_.greatest() / y_.least());
    const double widest = 0.2 * (frame_.right - frame_.left);
    const double highest = 0.2 * (frame_.bottom - frame_.top);
    const double decades = std::min(widest / px_a_decade_x, highest / (px_a_decade_y * exponent));
    const Pixel foot(frame_.left + 20, frame_.bottom - 2 * line_height);
    const Pixel corner = foot + Pixel(decades * px_a_decade_x, 0);
    const Pixel top = corner - Pixel(0, decades * exponent * px_a_decade_y);
    sketch_.add(SketchLine{.points = {foot, corner, top, foot}, .color = axis_color, .width = 1.5});
    add_text(foot + Pixel(0, 14), chart_.slope->text, Anchor::start);
  }

  void draw_titles() {
    add_text({frame_.left, frame_.top - 38}, chart_.title, Anchor::start, {0, 0, 0});
    add_text({frame_.left, frame_.top - 16}, chart_.y_title, Anchor::start);
    add_text({(frame_.left + frame_.right) / 2, frame_.bottom + 36}, chart_.x_title,
             Anchor::middle);
  }

  void draw_names() {
    Pixel at(frame_.left, frame_.bottom + 66);
    for (const ChartCurve& curve : chart_.curves) {
      const double width = 50 + letter_width * static_cast<double>(curve.name.size() + 1);
      if (at.x() + width > frame_.right) at = Pixel(frame_.left, at.y() + line_height);
      sketch_.add(SketchLine{
          .points = {at, at + Pixel(30, 0)}, .color = curve.color, .width = 2, .dash = curve.dash});
      add_text(at + Pixel(38, 0), curve.name, Anchor::start);
      at.x() += width;
    }
  }

  const LogLogChart& chart_;
  const Frame& frame_;
  Sketch& sketch_;
  LogAxis x_, y_;
  std::vector<Frame> labels_;
};

}  // namespace

void draw(const LogLogChart& chart, const Frame& frame, Sketch& sketch) {
  LogLogDrawing(chart, frame, sketch).draw();
}

}  // namespace supple
