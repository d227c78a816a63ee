#pragma once

#include <string>
#include <vector>

#include "io/chart/sketch.h"

namespace supple {

/// Parts of a whole, drawn as shares of the bar's length.
struct StackedBar {
  std::string name;
  std::vector<double> parts;  ///< as many as the chart names
  std::string text;           ///< behind the bar
};

/// Lying bars below each other.
struct StackedBars {
  std::string title;
  std::vector<std::string> part_names;
  std::vector<StackedBar> bars;
};

/// The bars fill `frame`; their names stand left of it, the names of the parts below.
void draw(const StackedBars& chart, const Frame& frame, Sketch& sketch);

}  // namespace supple
