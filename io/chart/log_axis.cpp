#include "io/chart/log_axis.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "solver/core/check.h"

namespace supple {
namespace {

constexpr double few_decades = 2.2, many_decades = 12;

}  // namespace

LogAxis::LogAxis(double least, double greatest, double at_least, double at_greatest)
    : least_(least), greatest_(greatest), at_least_(at_least), at_greatest_(at_greatest) {
  SUPPLE_CHECK(least > 0 && greatest > least, "a logarithmic axis is above 0");
}

double LogAxis::at(double value) const {
  if (!(value > least_)) return at_least_;  // nor what is no number
  const double share = std::log(std::min(value, greatest_) / least_) / std::log(greatest_ / least_);
  return at_least_ + share * (at_greatest_ - at_least_);
}

std::vector<double> LogAxis::ticks() const {
  const double decades = std::log10(greatest_ / least_);
  const std::vector<double> digits =
      decades < few_decades ? std::vector<double>{1, 2, 5} : std::vector<double>{1};
  const int step = decades > many_decades ? 2 : 1;
  std::vector<double> ticks;
  const int first = static_cast<int>(std::floor(std::log10(least_)));
  const int last = static_cast<int>(std::ceil(std::log10(greatest_)));
  for (int exponent = first; exponent <= last; exponent += step)
    for (const double digit : digits) {
      const double tick = digit * std::pow(10, exponent);
      if (tick >= least_ && tick <= greatest_) ticks.push_back(tick);
    }
  return ticks;
}

std::string tick_text(double value) {
  const int exponent = static_cast<int>(std::floor(std::log10(value) + 1e-9));
  if (exponent >= -3 && exponent < 4) return fmt::format("{:.3g}", value);
  return fmt::format("{:.3g}e{}", value / std::pow(10, exponent), exponent);
}

}  // namespace supple
