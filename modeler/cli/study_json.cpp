#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "modeler/cli/json_text.h"
#include "modeler/cli/study_run.h"

namespace supple {
namespace {

Json number(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json settings_json(const SceneOverrides& settings) {
  Json json = Json::object();
  for (const auto& [key, value] : settings) json[key] = value;
  return json;
}

Json seconds_json(const Trial& trial) {
  Json stages = Json::object();
  for (const auto& [stage, seconds] : trial.outcome.stages) stages[stage] = seconds;
  Json median_time = trial.seconds.empty() ? Json(nullptr) : Json(median(trial.seconds));
  return {{"median", median_time}, {"runs", trial.seconds}, {"stages", stages}};
}

Json row_json(const Study& study, const StudyRow& row) {
  const Trial& trial = study.trial(row);
  return {{"knob", row.knob},
          {"value", row.value},
          {"set", settings_json(trial.settings)},
          {"own", row.own},
          {"unknowns", trial.outcome.unknowns},
          {"error", number(row.error)},
          {"uncertainty", row.error ? Json(row.uncertainty) : Json(nullptr)},
          {"reference", row.reference},
          {"total_error", number(row.total)},
          {"order", number(row.order)},
          {"seconds", seconds_json(trial)},
          {"iterations", trial.outcome.iterations},
          {"peak_bytes", trial.outcome.peak_bytes},
          {"status", enum_name(trial.outcome.status)},
          {"reasons", trial.outcome.reasons},
          {"skipped", trial.skipped},
          {"reference_too_coarse", row.reference_too_coarse},
          {"noisy", row.noisy},
          {"pareto", row.pareto}};
}

Json reference_json(const std::optional<Reference>& reference) {
  if (!reference) return nullptr;
  return {{"uncertainty", reference->uncertainty},
          {"order", number(reference->order)},
          {"plausible", reference->plausible}};
}

Json cost_json(const std::optional<PowerLaw>& cost) {
  if (!cost) return nullptr;
  return {{"exponent", cost->exponent},
          {"seconds_factor_for_10_times_less_error", std::pow(10, -cost->exponent)}};
}

Json choice_json(const std::optional<WishedChoice>& wished) {
  if (!wished) return nullptr;
  const Choice& choice = wished->choice;
  return {{"wish", wished->wish},
          {"met", choice.met},
          {"set", settings_json(choice.settings)},
          {"error", number(choice.error)},
          {"seconds", choice.seconds},
          {"why_not", choice.why_not}};
}

}  // namespace

std::string study_json(const StudyRun& run) {
  const Study& study = run.study;
  Json rows = Json::array(), sources = Json::array();
  for (const StudyRow& row : study.rows) rows.push_back(row_json(study, row));
  for (const ErrorSource& source : study.sources)
    sources.push_back({{"knob", source.knob}, {"error", source.error}});
  return json_text(
      {{"command", "study"},
       {"version", SUPPLE_VERSION},
       {"input", run.input},
       {"scene_hash", fmt::format("{:016x}", run.scene_hash)},
       {"machine", {{"processor", run.processor}, {"threads", run.threads}, {"build", run.build}}},
       {"rows", rows},
       {"reference", reference_json(study.reference)},
       {"own", study.own ? Json(*study.own) : Json(nullptr)},
       {"better", study.better},
       {"pareto", study.pareto},
       {"cost", cost_json(study.cost)},
       {"sources", sources},
       {"for_error", choice_json(run.for_error)},
       {"for_time", choice_json(run.for_time)},
       {"findings", study_findings(run)},
       {"shortfalls", study_shortfalls(study)},
       {"notes", run.notes},
       {"seconds", {{"total", run.total_seconds}}}});
}

}  // namespace supple
