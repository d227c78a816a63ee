#include "modeler/study/sweeps.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "modeler/study/fit.h"

namespace supple {
namespace {

/// How time is taken to grow with the degrees of freedom before two runs have shown it.
constexpr double cautious_exponent = 2;

/// A name, such as another minimiser, might take any time. It gets so much of what is left of the
/// budget, and no more than so many times what the scene's own value takes.
constexpr double share_of_a_name = 0.5, most_times_own = 30;

std::size_t trial_of(const SceneOverrides& settings, int runs, std::vector<Trial>& trials) {
  const auto same = [&](const Trial& trial) { return trial.settings == settings; };
  const auto found = std::find_if(trials.begin(), trials.end(), same);
  const auto index = static_cast<std::size_t>(found - trials.begin());
  if (found == trials.end()) trials.push_back({settings, runs});
  trials[index].wanted_runs = std::max(trials[index].wanted_runs, runs);
  return index;
}

/// What is known of a run before it starts.
struct Forecast {
  double seconds = 0;       ///< 0: nothing is known
  double most_seconds = 0;  ///< after which it is stopped
};

/// Runs trials within the budget, and remembers what they took.
class SweepRun {
 public:
  SweepRun(Sweeps& sweeps, const Runner& run, const SweepOptions& options)
      : sweeps_(sweeps), run_(run), options_(options) {
    for (const Trial& trial : sweeps.trials) wanted_ += trial.wanted_runs;
  }

  void first_runs() {
    for (std::size_t i = 0; i < sweeps_.trials.size(); ++i) {
      Trial& trial = sweeps_.trials[i];
      const Forecast forecast = forecast_of(i);
      if (left() == 0)
        trial.skipped = "the budget is spent";
      else if (forecast.seconds <= left())
        run_once(trial, forecast.most_seconds);
      else
        trial.skipped = fmt::format("predicted to take {:.2g} s, with {:.2g} s of the budget left",
                                    forecast.seconds, left());
    }
  }

  void repeat() {
    for (int round = 1; round < options_.runs; ++round)
      for (Trial& trial : sweeps_.trials)
        if (round < trial.wanted_runs && trial.usable() && median(trial.seconds) <= left())
          run_once(trial, left());
  }

 private:
  double left() const { return std::max(0.0, options_.budget - spent_); }

  void run_once(Trial& trial, double most_seconds) {
    if (options_.progress) options_.progress(setting_text(trial.settings), done_ / wanted_);
    TrialOutcome outcome = run_(trial.settings, most_seconds);
    done_ += 1;
    spent_ += outcome.seconds;
    trial.seconds.push_back(outcome.seconds);
    const bool fastest = trial.seconds.size() == 1 || outcome.seconds < trial.outcome.seconds;
    if (fastest) trial.outcome = std::move(outcome);
  }

  Forecast forecast_of(std::size_t index) const {
    for (const KnobSweep& sweep : sweeps_.knobs) {
      if (sweep.exact && sweep.exact->trial == index) return {predict(sweep, *sweep.exact), left()};
      for (const SweepPoint& point : sweep.points) {
        if (point.trial != index) continue;
        const bool by_name = sweep.knob.numbers.empty() && !sweeps_.trials[index].settings.empty();
        return {predict(sweep, point), by_name ? most_for_a_name(sweep) : left()};
      }
    }
    return {0, left()};
  }

  double most_for_a_name(const KnobSweep& sweep) const {
    const double own = own_seconds(sweep);
    return std::min(share_of_a_name * left(), own > 0 ? most_times_own * own : left());
  }

  /// 0 where it did not run yet.
  double own_seconds(const KnobSweep& sweep) const {
    return median(sweeps_.trials[sweep.points[sweep.knob.own].trial].seconds);
  }

  /// The time of a trial that has not run; 0 where nothing tells it.
  double predict(const KnobSweep& sweep, const SweepPoint& point) const {
    std::vector<std::pair<double, double>> times;
    for (const SweepPoint& other : sweep.points)
      if (const Trial& trial = sweeps_.trials[other.trial]; trial.usable())
        times.emplace_back(other.number, median(trial.seconds));
    if (const auto law = fit_power_law(times)) return law->at(point.number);
    if (sweep.knob.converges && !times.empty())
      return times.back().second * std::pow(point.number / times.back().first, cautious_exponent);
    return own_seconds(sweep);
  }

  Sweeps& sweeps_;
  const Runner& run_;
  const SweepOptions& options_;
  double wanted_ = 0, done_ = 0, spent_ = 0;
};

}  // namespace

std::string setting_text(const SceneOverrides& settings) {
  if (settings.empty()) return "as it is";
  std::string text;
  for (const auto& [key, value] : settings)
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", key.substr(key.rfind('.') + 1), value);
  return text;
}

Sweeps plan_sweeps(const std::vector<Knob>& knobs, const SweepOptions& options) {
  std::vector<std::size_t> in_turn(knobs.size());
  std::iota(in_turn.begin(), in_turn.end(), std::size_t{0});
  // What can be foretold comes first.
  std::stable_partition(in_turn.begin(), in_turn.end(),
                        [&](std::size_t i) { return !knobs[i].numbers.empty(); });
  Sweeps sweeps;
  sweeps.knobs.resize(knobs.size());
  for (const std::size_t at : in_turn) {
    const Knob& knob = knobs[at];
    KnobSweep& sweep = sweeps.knobs[at];
    sweep.knob = knob;
    for (std::size_t i = 0; i < knob.values.size(); ++i) {
      const SceneOverrides settings =
          i == knob.own ? SceneOverrides{} : SceneOverrides{{knob.key, knob.values[i]}};
      sweep.points.push_back({trial_of(settings, options.runs, sweeps.trials),
                              knob.numbers.empty() ? 0 : knob.numbers[i]});
    }
    if (!knob.exact.empty())
      sweep.exact = {trial_of({{knob.key, knob.exact}}, 1, sweeps.trials), std::stod(knob.exact)};
  }
  return sweeps;
}

void run_sweeps(Sweeps& sweeps, const Runner& run, const SweepOptions& options) {
  SweepRun sweep_run(sweeps, run, options);
  sweep_run.first_runs();
  sweep_run.repeat();
}

}  // namespace supple
