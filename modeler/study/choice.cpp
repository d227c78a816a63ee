#include "modeler/study/choice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace supple {
namespace {

constexpr double safety_of_order = 1.25, safety_of_doubt = 3;
constexpr double solver_share = 0.1;     // of the error of the particles
constexpr double share_of_time = 0.8;    // that a run may take, since times vary
constexpr double most_over_finest = 16;  // particles, over the most that were studied

/// A knob and its error as a power of its value.
struct ErrorLaw {
  const Knob* knob = nullptr;
  PowerLaw law;
};

/// By errors that the reference can tell, where they fall as the values become finer.
std::optional<ErrorLaw> error_law(const Study& study, const Knob& knob) {
  std::vector<std::pair<double, double>> points;
  for (const StudyRow& row : study.rows)
    if (row.knob == knob.name && row.error && *row.error > row.uncertainty &&
        study.trial(row).outcome.status == Status::ok)
      points.emplace_back(std::stod(row.value), *row.error);
  const std::optional<PowerLaw> law = fit_power_law(points);
  if (!law || (law->exponent < 0) != knob.converges) return std::nullopt;
  return ErrorLaw{&knob, *law};
}

double value_for(const PowerLaw& law, double error) {
  return std::pow(error / law.factor, 1 / law.exponent);
}

/// The loosest tolerance in whole decades, no looser and no tighter than what was studied.
std::string tolerance_for(const ErrorLaw& tolerance, double error) {
  const double value = std::pow(10, std::floor(std::log10(value_for(tolerance.law, error))));
  const auto& numbers = tolerance.knob->numbers;
  return fmt::format("{:.3g}", std::clamp(value, numbers.back(), numbers.front()));
}

/// Says what can be reached where the target cannot.
std::string reachable(const Study& study) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : study.pareto) least = std::min(least, *Study::compared(study.rows[i]));
  const double doubt = study.reference ? study.reference->uncertainty : 0;
  return study.pareto.empty()
             ? "no error was measured"
             : fmt::format("the least that was measured is {:.2g} ± {:.1g}", least, doubt);
}

/// The search for one target.
class ErrorChoice {
 public:
  ErrorChoice(const Study& study, const ErrorLaw& particles,
              const std::optional<ErrorLaw>& tolerance, const Runner& run, double target)
      : study_(study), particles_(particles), tolerance_(tolerance), run_(run), target_(target) {}

  Choice with_safety(double safety) const {
    const double spatial = target_ / safety / (1 + solver_share);
    const double count = std::max(1.0, std::ceil(value_for(particles_.law, spatial)));
    Choice choice;
    if (!(count <= most_over_finest * particles_.knob->numbers.back())) {
      choice.why_not = fmt::format("it would take {:.2g} particles; {}", count, reachable(study_));
      return choice;
    }
    choice.settings = settings(count, spatial);
    verify(count, spatial, choice);
    return choice;
  }

 private:
  SceneOverrides settings(double count, double spatial) const {
    SceneOverrides settings = {{particles_.knob->key, fmt::format("{:.0f}", count)}};
    if (tolerance_)
      settings.emplace_back(tolerance_->knob->key,
                            tolerance_for(*tolerance_, solver_share * spatial));
    return settings;
  }

  /// By the distance to the result of twice the particles and the order that the study saw.
  void verify(double count, double spatial, Choice& choice) const {
    constexpr double no_limit = std::numeric_limits<double>::infinity();
    const TrialOutcome here = run_(choice.settings, no_limit);
    const TrialOutcome finer = run_(settings(2 * count, spatial), no_limit);
    choice.seconds = here.seconds;
    if (here.status != Status::ok || finer.status != Status::ok) {
      choice.why_not = fmt::format("{} is not ok", setting_text(choice.settings));
      return;
    }
    const double order = std::clamp(-particles_.law.exponent * 3, least_order, greatest_order);
    const double r =
        std::cbrt(static_cast<double>(finer.unknowns) / static_cast<double>(here.unknowns));
    const double rise = std::pow(r, order);
    choice.error = rms_distance(here.positions, finer.positions) * rise / (rise - 1);
    choice.met = *choice.error <= target_;
    if (!choice.met)
      choice.why_not = fmt::format("with {} the error is still {:.2g}; {}",
                                   setting_text(choice.settings), *choice.error, reachable(study_));
  }

  const Study& study_;
  const ErrorLaw& particles_;
  const std::optional<ErrorLaw>& tolerance_;
  const Runner& run_;
  double target_;
};

}  // namespace

Choice choose_for_error(const Study& study, const std::vector<Knob>& chosen, const Runner& run,
                        double target) {
  std::optional<ErrorLaw> particles, tolerance;
  for (const Knob& knob : chosen) {
    if (knob.converges) particles = error_law(study, knob);
    if (!knob.exact.empty()) tolerance = error_law(study, knob);
  }
  Choice none;
  if (std::none_of(chosen.begin(), chosen.end(), [](const Knob& knob) { return knob.converges; })) {
    none.why_not = "particles were not studied: add them to --knobs";
    return none;
  }
  if (!particles) {
    none.why_not =
        "the errors of the particles do not fall clearly beyond the reference's uncertainty; " +
        reachable(study);
    return none;
  }
  const ErrorChoice search(study, *particles, tolerance, run, target);
  const bool sure = study.reference && study.reference->plausible;
  const Choice first = search.with_safety(sure ? safety_of_order : safety_of_doubt);
  return first.met || !sure ? first : search.with_safety(safety_of_doubt);
}

Choice choose_for_time(const Study& study, double seconds) {
  const auto slowest = [&](std::size_t row) {
    const std::vector<double>& times = study.trial(study.rows[row]).seconds;
    return *std::max_element(times.begin(), times.end());
  };
  Choice choice;
  choice.why_not = study.pareto.empty()
                       ? std::string("no setting came to an error with status ok")
                       : fmt::format("the fastest setting took up to {:.2g} s, and times vary",
                                     slowest(study.pareto.front()));
  for (const std::size_t i : study.pareto) {  // the later, the more accurate
    if (slowest(i) > share_of_time * seconds) continue;
    const StudyRow& row = study.rows[i];
    choice = {study.trial(row).settings, Study::compared(row), study.seconds(row), true, {}};
  }
  return choice;
}

}  // namespace supple
