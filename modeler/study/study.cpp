#include "modeler/study/study.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "modeler/study/pareto.h"

namespace supple {
namespace {

/// Errors within so many uncertainties of the reference say little.
constexpr double sure_over_uncertainty = 10;

/// Times that spread by more than this share of their median.
constexpr double noisy_spread = 0.1;

bool is_chosen(const Knob& knob, const std::vector<Knob>& chosen) {
  return std::find(chosen.begin(), chosen.end(), knob) != chosen.end();
}

/// The chosen knobs, and the one that converges where another is compared with its limit.
std::vector<Knob> needed_knobs(const std::vector<Knob>& knobs, const std::vector<Knob>& chosen) {
  const bool compared = std::any_of(chosen.begin(), chosen.end(),
                                    [](const Knob& knob) { return knob.exact.empty(); });
  std::vector<Knob> needed;
  for (const Knob& knob : knobs)
    if (is_chosen(knob, chosen) || (knob.converges && compared)) needed.push_back(knob);
  return needed;
}

/// What no row shows is not timed: one run tells its result.
void run_unseen_once(const std::vector<Knob>& chosen, Sweeps& sweeps) {
  for (const KnobSweep& sweep : sweeps.knobs)
    for (const SweepPoint& point : sweep.points)
      if (Trial& trial = sweeps.trials[point.trial];
          !is_chosen(sweep.knob, chosen) && !trial.settings.empty())
        trial.wanted_runs = 1;
}

/// The limit of the knob that converges.
std::optional<Reference> converged(const Sweeps& sweeps) {
  std::vector<GridLevel> levels;
  for (const KnobSweep& sweep : sweeps.knobs) {
    if (!sweep.knob.converges) continue;
    for (const SweepPoint& point : sweep.points) {
      const Trial& trial = sweeps.trials[point.trial];
      if (trial.usable())
        levels.push_back({&trial.outcome.positions, static_cast<double>(trial.outcome.unknowns)});
    }
  }
  return extrapolate(levels);
}

bool is_noisy(const std::vector<double>& seconds) {
  const auto [least, greatest] = std::minmax_element(seconds.begin(), seconds.end());
  return seconds.size() > 1 && *greatest - *least > noisy_spread * median(seconds);
}

/// What the error of a knob is seen to fall with, the spacing or the value itself; 0: nothing.
double fineness(const Knob& knob, const SweepPoint& point, const Trial& trial) {
  if (knob.converges) return std::cbrt(1 / static_cast<double>(trial.outcome.unknowns));
  return knob.exact.empty() ? 0 : point.number;
}

/// The rows of one knob.
class KnobRows {
 public:
  KnobRows(const Sweeps& sweeps, const KnobSweep& sweep, const std::optional<Reference>& shared)
      : sweeps_(sweeps), sweep_(sweep), shared_(shared) {}

  std::vector<StudyRow> make() const {
    std::vector<StudyRow> rows;
    for (std::size_t i = 0; i < sweep_.points.size(); ++i) {
      rows.push_back(row(i));
      if (i > 0) rows[i].order = order(rows[i - 1], rows[i], i);
    }
    return rows;
  }

 private:
  const Trial& trial(std::size_t i) const { return sweeps_.trials[sweep_.points[i].trial]; }

  StudyRow row(std::size_t i) const {
    const Knob& knob = sweep_.knob;
    StudyRow row{.knob = knob.name, .value = knob.values[i], .trial = sweep_.points[i].trial};
    row.own = i == knob.own;
    row.noisy = is_noisy(trial(i).seconds);
    if (!trial(i).usable()) return row;
    const Points& x = trial(i).outcome.positions;
    if (shared_) row.total = rms_distance(x, shared_->positions);
    if (sweep_.exact) {
      const Trial& exact = sweeps_.trials[sweep_.exact->trial];
      if (!exact.usable()) return row;
      row.error = rms_distance(x, exact.outcome.positions);
      row.reference = fmt::format("{}={}", knob.name, knob.exact);
    } else if (shared_) {
      row.error = row.total;
      row.uncertainty = shared_->uncertainty;
      row.reference = "extrapolated";
      row.reference_too_coarse = *row.error < sure_over_uncertainty * row.uncertainty;
    }
    return row;
  }

  /// The finest result is as far from a reference in doubt as the expected order wants it.
  bool order_is_assumed(std::size_t i) const {
    if (!sweep_.knob.converges || !shared_ || shared_->plausible) return false;
    return std::all_of(sweep_.points.begin(), sweep_.points.end(), [&](const SweepPoint& point) {
      return sweeps_.trials[point.trial].outcome.unknowns <= trial(i).outcome.unknowns;
    });
  }

  std::optional<double> order(const StudyRow& before, const StudyRow& row, std::size_t i) const {
    if (order_is_assumed(i)) return std::nullopt;
    const double coarse = fineness(sweep_.knob, sweep_.points[i - 1], trial(i - 1));
    const double fine = fineness(sweep_.knob, sweep_.points[i], trial(i));
    if (!before.error || !row.error || !(*before.error > 0) || !(*row.error > 0) ||
        !(coarse > fine) || !(fine > 0))
      return std::nullopt;
    return std::log(*before.error / *row.error) / std::log(coarse / fine);
  }

  const Sweeps& sweeps_;
  const KnobSweep& sweep_;
  const std::optional<Reference>& shared_;
};

/// The rows that can be recommended: each trial once, its status ok.
std::vector<std::size_t> sound_rows(const Study& study) {
  std::vector<std::size_t> sound, trials;
  for (std::size_t i = 0; i < study.rows.size(); ++i) {
    const StudyRow& row = study.rows[i];
    if (!Study::compared(row) || study.trial(row).outcome.status != Status::ok) continue;
    if (std::find(trials.begin(), trials.end(), row.trial) != trials.end()) continue;
    trials.push_back(row.trial);
    sound.push_back(i);
  }
  return sound;
}

void find_pareto(Study& study) {
  const std::vector<std::size_t> sound = sound_rows(study);
  std::vector<Candidate> candidates;
  for (const std::size_t i : sound)
    candidates.push_back({*Study::compared(study.rows[i]), study.seconds(study.rows[i])});
  for (const std::size_t k : pareto_front(candidates)) study.pareto.push_back(sound[k]);
  for (StudyRow& row : study.rows)
    for (const std::size_t i : study.pareto) row.pareto |= study.rows[i].trial == row.trial;
  if (!study.own || !Study::compared(study.rows[*study.own])) return;
  const StudyRow& own = study.rows[*study.own];
  // Nothing is better than an error that cannot be told from none.
  if (own.error && *own.error <= own.uncertainty) return;
  for (const std::size_t i : study.pareto)
    if ((1 - least_gain) * *Study::compared(study.rows[i]) <= *Study::compared(own) &&
        study.seconds(study.rows[i]) < study.seconds(own))
      study.better.push_back(i);
}

/// Time over error along the knob that converges, by errors that its reference can tell.
std::optional<PowerLaw> cost_of_accuracy(const Study& study, const Knob& knob) {
  std::vector<std::pair<double, double>> points;
  for (const StudyRow& row : study.rows)
    if (row.knob == knob.name && row.error && *row.error > row.uncertainty &&
        study.trial(row).outcome.status == Status::ok)
      points.emplace_back(*row.error, study.seconds(row));
  const std::optional<PowerLaw> law = fit_power_law(points);
  return law && law->exponent < 0 ? law : std::nullopt;  // else less error is no matter of time
}

/// The own row's error by the knobs that have an exact value or converge to one.
std::vector<ErrorSource> error_sources(const Study& study, const std::vector<Knob>& knobs) {
  std::vector<ErrorSource> sources;
  for (const StudyRow& row : study.rows)
    for (const Knob& knob : knobs)
      if (row.own && row.error && row.knob == knob.name && (knob.converges || !knob.exact.empty()))
        sources.push_back({row.knob, *row.error});
  std::stable_sort(sources.begin(), sources.end(),
                   [](const ErrorSource& a, const ErrorSource& b) { return a.error > b.error; });
  return sources;
}

}  // namespace

Study study(const std::vector<Knob>& knobs, const std::vector<Knob>& chosen, const Runner& run,
            const SweepOptions& options) {
  const std::vector<Knob> needed = needed_knobs(knobs, chosen);
  Sweeps sweeps = plan_sweeps(needed, options);
  run_unseen_once(chosen, sweeps);
  run_sweeps(sweeps, run, options);

  Study result;
  result.reference = converged(sweeps);
  for (const KnobSweep& sweep : sweeps.knobs)
    if (is_chosen(sweep.knob, chosen))
      for (StudyRow& row : KnobRows(sweeps, sweep, result.reference).make())
        result.rows.push_back(std::move(row));
  result.trials = std::move(sweeps.trials);
  for (std::size_t i = 0; i < result.rows.size() && !result.own; ++i)
    if (result.rows[i].own) result.own = i;
  find_pareto(result);
  for (const Knob& knob : chosen)
    if (knob.converges) result.cost = cost_of_accuracy(result, knob);
  result.sources = error_sources(result, chosen);
  return result;
}

}  // namespace supple
