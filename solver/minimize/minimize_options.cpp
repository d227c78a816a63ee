#include "solver/minimize/minimize_options.h"

#include <array>

namespace supple {

EnumNames<MinimizerKind> enum_names(MinimizerKind) {
  static constexpr std::array<std::pair<MinimizerKind, std::string_view>, 3> names{{
      {MinimizerKind::lbfgs, "lbfgs"},
      {MinimizerKind::trust_region, "trust_region"},
      {MinimizerKind::nlopt, "nlopt"},
  }};
  return names;
}

}  // namespace supple
