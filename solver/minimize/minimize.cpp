#include "solver/minimize/minimize.h"

#include <cmath>

#include <fmt/format.h>

#include "solver/core/check.h"
#include "solver/minimize/loaded/minimizers.h"

namespace supple {
namespace {

void note_restarts(int count, Report& report) {
  if (count > 0)
    report.notes.push_back(
        fmt::format("the memory of earlier steps led nowhere {} time{}: given up, and on down the "
                    "preconditioned gradient",
                    count, count == 1 ? "" : "s"));
}

/// L-BFGS; where its line search gives up, the trust region goes on from there, and says so.
Report run_lbfgs(const EnergySum& energy, const Preconditioner& preconditioner,
                 const MinimizeOptions& options, const HardConstraints* constraints, Points& u) {
  const Deadline deadline(options.most_seconds);
  PaddedPoints unknowns = padded(u);
  const Lbfgs::Result result =
      Lbfgs().minimize(energy, preconditioner, options, constraints, unknowns);
  u = unknowns.leftCols<3>();
  if (result.stop == Lbfgs::Stop::stuck && !constraints) {
    Report report = minimizers().trust_region(energy, within(deadline, options), u);
    report.iterations += result.iterations;
    note_restarts(result.restarts, report);
    report.notes.push_back("the line search gave up; the trust region took over");
    degrade_not_finite(result.not_finite, result.evaluations, report);
    return report;
  }
  return report_of(result);
}

Report run(const EnergySum& energy, const Preconditioner& preconditioner,
           const MinimizeOptions& options, const HardConstraints* constraints, Points& u) {
  switch (options.kind) {
    case MinimizerKind::lbfgs:
      return run_lbfgs(energy, preconditioner, options, constraints, u);
    case MinimizerKind::trust_region:
      SUPPLE_CHECK(!constraints, "the trust region takes no constraints");
      return minimizers().trust_region(energy, options, u);
    case MinimizerKind::nlopt:
      return minimizers().nlopt(energy, preconditioner, options, constraints, u);
  }
  fail_check("the minimiser is known", __FILE__, __LINE__, std::string(enum_name(options.kind)));
}

}  // namespace

MinimizeOptions within(const Deadline& deadline, MinimizeOptions options) {
  options.most_seconds = std::min(options.most_seconds, deadline.left());
  return options;
}

Report report_of(const Lbfgs::Result& result) {
  Report report;
  report.iterations = result.iterations;
  note_restarts(result.restarts, report);
  degrade_not_finite(result.not_finite, result.evaluations, report);
  switch (result.stop) {
    case Lbfgs::Stop::converged:
      break;
    case Lbfgs::Stop::max_iterations:
      report.degrade({ReasonCode::max_iterations, 1, static_cast<double>(result.iterations),
                      fmt::format("stopped after {} iterations", result.iterations)});
      break;
    case Lbfgs::Stop::out_of_time:
      degrade_out_of_time("iterations", report);
      break;
    case Lbfgs::Stop::stuck:
      report.degrade(
          {ReasonCode::not_converged, 1, result.energy, "the line search finds no lower energy"});
      break;
  }
  return report;
}

void degrade_out_of_time(std::string_view steps, Report& report) {
  report.degrade({ReasonCode::out_of_time, 1, static_cast<double>(report.iterations),
                  fmt::format("out of time after {} {}", report.iterations, steps)});
}

void degrade_not_finite(int count, int evaluations, Report& report) {
  if (count > 0)
    report.degrade({ReasonCode::not_finite, count, 0,
                    fmt::format("the energy was not finite at {} of {} evaluations: steps to there "
                                "were rejected",
                                count, evaluations)});
}

Report minimize(const EnergySum& energy, const Preconditioner& preconditioner,
                const MinimizeOptions& options, Points& u, const HardConstraints* constraints) {
  SUPPLE_CHECK(u.rows() == energy.particles(), "one displacement a particle");
  const Deadline deadline(options.most_seconds);
  Report report;
  if (!u.allFinite() || !std::isfinite(energy.evaluate(u))) {
    report.fail({ReasonCode::not_finite, 1, 0, "the energy is not finite where the solve starts"});
    return report;
  }
  const Points start = u;
  report = run(energy, preconditioner, within(deadline, options), constraints, u);
  if (!u.allFinite()) {
    u = start;
    report.fail({ReasonCode::not_finite, 1, 0, "the minimiser left the finite numbers"});
  }
  report.energies = energy.values(u);
  report.finish();
  return report;
}

}  // namespace supple
