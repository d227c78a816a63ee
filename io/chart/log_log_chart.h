#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/chart/sketch.h"

namespace supple {

/// A point with its bars along y; `text` beside it.
struct ChartPoint {
  enum class Mark { full, hollow };
  double x = 0, y = 0;
  double low = 0, high = 0;
  std::string text = {};
  Mark mark = Mark::full;
};

struct ChartCurve {
  std::string name;
  Color color{0, 0, 0};
  std::vector<ChartPoint> points;
  double dash = 0;  ///< length of dashes [px]; such curves may leave the chart on the right
};

/// What did not come to a point: a cross on the upper edge.
struct ChartFailure {
  std::string text;
  Color color{0, 0, 0};
};

/// y ~ x^exponent, shown as a triangle.
struct ChartSlope {
  double exponent = -1;
  std::string text;
};

/// Both axes are logarithmic, x falls to the right: cost over error. Values must be above 0; those
/// that are not lie on the chart's edge.
struct LogLogChart {
  std::string title, x_title, y_title;
  std::vector<ChartCurve> curves;
  std::vector<ChartPoint> front = {};   ///< a thick line
  std::optional<ChartPoint> ring = {};  ///< around one point
  double band = 0;                      ///< x below this is grey; 0: none
  std::string band_text = {};
  std::vector<ChartFailure> failures = {};
  std::optional<ChartSlope> slope = {};
};

/// Axes and their texts lie around `frame`; the names of the curves below them.
void draw(const LogLogChart& chart, const Frame& frame, Sketch& sketch);

}  // namespace supple
