#include "solver/minimize/loaded/minimizers.h"

const supple::Minimizers* supple_minimizers() {
  static constexpr supple::Minimizers minimizers{supple::minimize_trust_region,
                                                 supple::minimize_nlopt};
  return &minimizers;
}
