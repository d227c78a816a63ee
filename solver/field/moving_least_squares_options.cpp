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
  static constexpr std::array<std::pair<KernelKind, std::string_view>, 3> names{{
      {KernelKind::polynomial, "polynomial"},
      {KernelKind::wendland, "wendland"},
      {KernelKind::box, "box"},
  }};
  return names;
}

}  // namespace supple
