#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "modeler/cli/study_run.h"

namespace supple {
namespace {

std::string error_text(const Study& study, const StudyRow& row) {
  const double error = *Study::compared(row);
  if (!row.total || !study.reference) return fmt::format("{:.2g}", error);
  return fmt::format("{:.2g} ± {:.1g}", error, study.reference->uncertainty);
}

std::string point_text(const Study& study, const StudyRow& row) {
  return fmt::format("{} (error {}, {:.2g} s)", row_text(row), error_text(study, row),
                     study.seconds(row));
}

std::string points_text(const Study& study, const std::vector<std::size_t>& rows) {
  std::vector<std::string> texts;
  for (const std::size_t i : rows) texts.push_back(point_text(study, study.rows[i]));
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::string own_finding(const Study& study) {
  if (!study.own || !Study::compared(study.rows[*study.own]))
    return "The scene as it is came to no result to compare.";
  const StudyRow& own = study.rows[*study.own];
  const std::string start = fmt::format("The scene as it is: error {} of the diagonal, {:.2g} s",
                                        error_text(study, own), study.seconds(own));
  if (study.trial(own).outcome.status != Status::ok)
    return start + "; its result is degraded, so it is not recommended.";
  if (study.better.empty()) return start + "; it is on the Pareto front.";
  return fmt::format("{}; as accurate or more in less time: {}.", start,
                     points_text(study, study.better));
}

std::string reference_finding(const Reference& reference) {
  if (!reference.plausible)
    return fmt::format(
        "The reference is extrapolated from the two finest results by order 2, since {}; its "
        "uncertainty, {:.1g}, has the factor 3.",
        reference.order
            ? fmt::format("the observed order {:.1f} is not plausible", *reference.order)
            : "three levels do not show an order",
        reference.uncertainty);
  return fmt::format(
      "The reference is extrapolated from the three finest results by their order {:.1f}; its "
      "uncertainty is {:.1g}.",
      *reference.order, reference.uncertainty);
}

std::string source_finding(const std::vector<ErrorSource>& sources) {
  std::vector<std::string> texts;
  for (const ErrorSource& source : sources)
    texts.push_back(fmt::format("{} {:.2g}", source.knob, source.error));
  return fmt::format("Dominant error source: {} ({}).", sources.front().knob,
                     fmt::join(texts, ", "));
}

/// As words for the command line, so that they can be pasted.
std::string set_words(const SceneOverrides& settings) {
  if (settings.empty()) return "the scene as it is";
  std::string words;
  for (const auto& [key, value] : settings)
    words += fmt::format("{}--set {}={}", words.empty() ? "" : " ", key, value);
  return words;
}

std::string choice_finding(const std::string& wish, const Choice& choice) {
  if (!choice.met) return fmt::format("{} cannot be had: {}.", wish, choice.why_not);
  return fmt::format("{}: {} (error {:.2g}, {:.2g} s).", wish, set_words(choice.settings),
                     *choice.error, choice.seconds);
}

}  // namespace

std::string row_text(const StudyRow& row) {
  return row.own ? std::string("as it is") : fmt::format("{}={}", row.knob, row.value);
}

std::string cost_text(const PowerLaw& cost) {
  const double times = std::pow(10, -cost.exponent);
  return times < 10 ? fmt::format("{:.1f}", times) : fmt::format("{:.0f}", times);
}

std::vector<std::string> study_findings(const StudyRun& run) {
  const Study& study = run.study;
  std::vector<std::string> findings = {own_finding(study)};
  if (study.pareto.empty())
    findings.push_back("No setting can be recommended: none came to an error with status ok.");
  else
    findings.push_back(fmt::format("Pareto front: {}.", points_text(study, study.pareto)));
  if (study.cost)
    findings.push_back(fmt::format("10 times less error costs {} times the time, by particles.",
                                   cost_text(*study.cost)));
  else if (study.reference)
    findings.push_back(
        "What less error costs cannot be told: fewer than two errors by particles are greater than "
        "the reference's uncertainty, or they do not fall with the time.");
  if (study.sources.size() > 1 && study.sources.front().error > 0)
    findings.push_back(source_finding(study.sources));
  if (study.reference) findings.push_back(reference_finding(*study.reference));
  if (run.for_error)
    findings.push_back(choice_finding(fmt::format("An error of {:.2g}", run.for_error->wish),
                                      run.for_error->choice));
  if (run.for_time)
    findings.push_back(choice_finding(fmt::format("A pose within {:.2g} s", run.for_time->wish),
                                      run.for_time->choice));
  return findings;
}

std::vector<std::string> study_shortfalls(const Study& study) {
  std::vector<std::string> lines;
  for (const Trial& trial : study.trials) {
    const std::string setting = setting_text(trial.settings);
    if (!trial.skipped.empty())
      lines.push_back(fmt::format("{}: left out: {}", setting, trial.skipped));
    else if (trial.outcome.status != Status::ok)
      lines.push_back(fmt::format("{}: {}: {}", setting, enum_name(trial.outcome.status),
                                  fmt::join(trial.outcome.reasons, "; ")));
    else if (static_cast<int>(trial.seconds.size()) < trial.wanted_runs)
      lines.push_back(fmt::format("{}: timed {} of {} times: the budget ended", setting,
                                  trial.seconds.size(), trial.wanted_runs));
  }
  return lines;
}

}  // namespace supple
