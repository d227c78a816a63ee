#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace supple {

/// y = factor·x^exponent.
struct PowerLaw {
  double factor = 0, exponent = 0;

  double at(double x) const;
};

/// The power law with the least squares of ln y over the points (x, y) with x, y > 0; none where
/// fewer than two of their x differ.
std::optional<PowerLaw> fit_power_law(std::span<const std::pair<double, double>> points);

/// The middle of the sorted values, or the mean of the middle two; 0 of none.
double median(std::vector<double> values);

}  // namespace supple
