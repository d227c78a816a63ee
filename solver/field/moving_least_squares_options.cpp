#include "solver/field/moving_least_squares_options.h"

#include <array>

namespace supple {

EnumNames<BasisOrder> enum_names(BasisOrder) {
  static constexpr std::array<std::pair<BasisOrder, std::string_view>, 3> names{{
      {BasisOrder::constant, "constant"},
      {BasisOrder::linear, "linear"},
      {BasisOrder::quadratic, "quadratic"},
  }};
  return names;
}

EnumNames<KernelKind> enum_names(KernelKind) {
  static constexpr std::array<std::pair<KernelKind, std::string_view>, 6> names{{
      {KernelKind::polynomial, "polynomial"},
      {KernelKind::wendland, "wendland"},
      {KernelKind::cubic_spline, "cubic_spline"},
      {KernelKind::gaussian, "gaussian"},
      {KernelKind::box, "box"},
      {KernelKind::singular, "singular"},
  }};
  return names;
}

EnumNames<GradientKind> enum_names(GradientKind) {
  static constexpr std::array<std::pair<GradientKind, std::string_view>, 2> names{{
      {GradientKind::full, "full"},
      {GradientKind::least_squares, "least_squares"},
  }};
  return names;
}

EnumNames<SupportKind> enum_names(SupportKind) {
  static constexpr std::array<std::pair<SupportKind, std::string_view>, 2> names{{
      {SupportKind::round, "round"},
      {SupportKind::stretched, "stretched"},
  }};
  return names;
}

}  // namespace supple
