#pragma once

#include <limits>

#include "solver/core/describe.h"
#include "solver/core/export.h"

namespace supple {

/// lbfgs: L-BFGS on preconditioned unknowns; trust_region: the reference;
/// nlopt: sequential quadratic programming (SLSQP), an independent check; its time grows with the
/// third power of the particles.
enum class MinimizerKind { lbfgs, trust_region, nlopt };
SUPPLE_API EnumNames<MinimizerKind> enum_names(MinimizerKind);

struct MinimizeOptions {
  MinimizerKind kind = MinimizerKind::lbfgs;
  int max_iterations = 2000;
  double tolerance = 1e-6;  ///< relative change of the energy between iterations
  double most_seconds = std::numeric_limits<double>::infinity();  ///< for one solve

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit("kind", self.kind, {.doc = "minimiser"});
    visit("max_iterations", self.max_iterations, {.doc = "limit for one solve", .min = 1});
    visit("tolerance", self.tolerance,
          {.doc = "relative change of energy at which a solve stops", .min = 1e-15, .max = 0.1});
    visit("most_seconds", self.most_seconds,
          {.doc = "time after which a solve stops with what it has", .unit = "s", .min = 0});
  }
};

}  // namespace supple
