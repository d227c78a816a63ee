#include "modeler/study/fit.h"

#include <algorithm>
#include <cmath>

namespace supple {

double PowerLaw::at(double x) const {
  return factor * std::pow(x, exponent);
}

std::optional<PowerLaw> fit_power_law(std::span<const std::pair<double, double>> points) {
  std::vector<std::pair<double, double>> logs;
  for (const auto& [x, y] : points)
    if (x > 0 && y > 0) logs.emplace_back(std::log(x), std::log(y));
  double mean_x = 0, mean_y = 0;
  for (const auto& [x, y] : logs) {
    mean_x += x / static_cast<double>(logs.size());
    mean_y += y / static_cast<double>(logs.size());
  }
  double spread = 0, common = 0;
  for (const auto& [x, y] : logs) {
    spread += (x - mean_x) * (x - mean_x);
    common += (x - mean_x) * (y - mean_y);
  }
  constexpr double rounding = 1e-20;  // of logarithms of equal numbers
  if (!(spread > rounding)) return std::nullopt;
  const double exponent = common / spread;
  return PowerLaw{std::exp(mean_y - exponent * mean_x), exponent};
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

}  // namespace supple
