#include "solver/minimize/minimize.h"

#include <cmath>

#include "solver/core/check.h"

namespace supple {
namespace {

Report run(const EnergySum& energy, const Preconditioner& preconditioner,
           const MinimizeOptions& options, Points& u) {
  switch (options.kind) {
    case MinimizerKind::lbfgs:
      return minimize_lbfgs(energy, preconditioner, options, u);
    case MinimizerKind::trust_region:
      return minimize_trust_region(energy, options, u);
    case MinimizerKind::nlopt:
      break;
  }
  fail_check("the minimiser is known", __FILE__, __LINE__, std::string(enum_name(options.kind)));
}

}  // namespace

Report minimize(const EnergySum& energy, const Preconditioner& preconditioner,
                const MinimizeOptions& options, Points& u) {
  SUPPLE_CHECK(u.rows() == energy.particles(), "one displacement a particle");
  Report report;
  if (!u.allFinite() || !std::isfinite(energy.evaluate(u))) {
    report.fail({ReasonCode::not_finite, 1, 0, "the energy is not finite where the solve starts"});
    return report;
  }
  const Points start = u;
  report = run(energy, preconditioner, options, u);
  if (!u.allFinite()) {
    u = start;
    report.fail({ReasonCode::not_finite, 1, 0, "the minimiser left the finite numbers"});
  }
  report.energies = energy.values(u);
  report.finish();
  return report;
}

}  // namespace supple
