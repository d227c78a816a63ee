#include "io/chart/stacked_bars.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "solver/core/check.h"

namespace supple {
namespace {

using Anchor = SketchText::Anchor;

constexpr std::array<Color, 6> part_colors{{{0.55f, 0.63f, 0.80f},
                                            {0.99f, 0.73f, 0.45f},
                                            {0.40f, 0.76f, 0.65f},
                                            {0.91f, 0.54f, 0.76f},
                                            {0.75f, 0.75f, 0.75f},
                                            {0.90f, 0.85f, 0.40f}}};
constexpr Color text_color{0.35f, 0.35f, 0.38f};
constexpr double greatest_step = 24;  // from one bar to the next [px]
constexpr double line_height = 20;    // [px]

const Color& part_color(std::size_t part) {
  return part_colors[part % part_colors.size()];
}

void draw_bar(const StackedBar& bar, const Frame& frame, Sketch& sketch) {
  const double whole = std::accumulate(bar.parts.begin(), bar.parts.end(), 0.0);
  const double middle = (frame.top + frame.bottom) / 2;
  sketch.add(SketchText{{frame.left - 8, middle}, bar.name, Anchor::end, text_color});
  sketch.add(SketchText{{frame.right + 8, middle}, bar.text, Anchor::start, text_color});
  double left = frame.left;
  for (std::size_t i = 0; i < bar.parts.size() && whole > 0; ++i) {
    const double right = left + (frame.right - frame.left) * bar.parts[i] / whole;
    if (right > left)
      sketch.add(SketchArea{Frame{left, frame.top, right, frame.bottom}.corners(), part_color(i)});
    left = right;
  }
}

void draw_part_names(const std::vector<std::string>& names, const Frame& frame, Sketch& sketch) {
  Pixel at(frame.left, frame.bottom);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double width = 34 + letter_width * static_cast<double>(names[i].size());
    if (at.x() + width > frame.right) at = Pixel(frame.left, at.y() + line_height);
    const Frame patch{at.x(), at.y() - 7, at.x() + 14, at.y() + 7};
    sketch.add(SketchArea{patch.corners(), part_color(i)});
    sketch.add(SketchText{at + Pixel(20, 0), names[i], Anchor::start, text_color});
    at.x() += width;
  }
}

}  // namespace

void draw(const StackedBars& chart, const Frame& frame, Sketch& sketch) {
  sketch.add(SketchText{{frame.left, frame.top - 16}, chart.title, Anchor::start, text_color});
  const auto count = static_cast<double>(chart.bars.size());
  const double step = std::min(greatest_step, (frame.bottom - frame.top) / std::max(1.0, count));
  Frame bar = frame;
  for (const StackedBar& each : chart.bars) {
    SUPPLE_CHECK(each.parts.size() == chart.part_names.size(), "a value for each part of a bar");
    bar.bottom = bar.top + 0.7 * step;
    draw_bar(each, bar, sketch);
    bar.top += step;
  }
  draw_part_names(chart.part_names, {frame.left, bar.top, frame.right + 90, bar.top + 14}, sketch);
}

}  // namespace supple
