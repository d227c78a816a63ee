#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "modeler/cli/study_run.h"

namespace supple {
namespace {

constexpr std::string_view columns =
    "knob,value,own,unknowns,error,uncertainty,reference,total_error,order,seconds_median,"
    "seconds_min,seconds_max,runs,iterations,peak_bytes,status,reference_too_coarse,noisy,pareto,"
    "reasons";

/// In quotes where it must be (RFC 4180).
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "";
}

std::string reasons(const Trial& trial) {
  if (!trial.skipped.empty()) return trial.skipped;
  return fmt::format("{}", fmt::join(trial.outcome.reasons, "; "));
}

std::string line(const Study& study, const StudyRow& row) {
  const Trial& trial = study.trial(row);
  std::vector<std::string> fields = {field(row.knob), field(row.value),
                                     fmt::format("{:d}", row.own),
                                     fmt::format("{}", trial.outcome.unknowns)};
  for (const auto& value : {row.error, row.error ? std::optional(row.uncertainty) : std::nullopt})
    fields.push_back(number(value));
  fields.push_back(field(row.reference));
  fields.push_back(number(row.total));
  fields.push_back(number(row.order));
  if (trial.seconds.empty()) {
    fields.insert(fields.end(), 3, "");
  } else {
    const auto [least, greatest] = std::minmax_element(trial.seconds.begin(), trial.seconds.end());
    for (const double seconds : {median(trial.seconds), *least, *greatest})
      fields.push_back(number(seconds));
  }
  fields.push_back(fmt::format("{}", trial.seconds.size()));
  fields.push_back(fmt::format("{}", trial.outcome.iterations));
  fields.push_back(fmt::format("{}", trial.outcome.peak_bytes));
  fields.push_back(std::string(enum_name(trial.outcome.status)));
  for (const bool flag : {row.reference_too_coarse, row.noisy, row.pareto})
    fields.push_back(fmt::format("{:d}", flag));
  fields.push_back(field(reasons(trial)));
  return fmt::format("{}\n", fmt::join(fields, ","));
}

}  // namespace

std::string study_csv(const StudyRun& run) {
  std::string text = fmt::format("{}\n", columns);
  for (const StudyRow& row : run.study.rows) text += line(run.study, row);
  return text;
}

}  // namespace supple
