#pragma once

#include <string>
#include <vector>

namespace supple {

/// A logarithmic axis from one pixel to another; values below the least lie at its start.
class LogAxis {
 public:
  /// `least` and `greatest` above 0, at the pixels `at_least` and `at_greatest`.
  LogAxis(double least, double greatest, double at_least, double at_greatest);

  double least() const { return least_; }
  double greatest() const { return greatest_; }

  /// The pixel of a value, within the axis.
  double at(double value) const;

  /// Round values: decades, or 1, 2 and 5 of each where there are few.
  std::vector<double> ticks() const;

 private:
  double least_, greatest_, at_least_, at_greatest_;
};

/// "0.02", "5", "1e-7": a round value in few letters.
std::string tick_text(double value);

}  // namespace supple
