#include <algorithm>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "modeler/cli/messages.h"
#include "modeler/cli/study_run.h"

namespace supple {
namespace {

std::string seconds_text(const std::vector<double>& seconds) {
  if (seconds.empty()) return "-";
  const auto [least, greatest] = std::minmax_element(seconds.begin(), seconds.end());
  return fmt::format("{:.3g} [{:.3g}-{:.3g}]", median(seconds), *least, *greatest);
}

std::string error_text(const StudyRow& row) {
  if (!row.error) return "-";
  return row.uncertainty > 0 ? fmt::format("{:.2e} ±{:.0e}", *row.error, row.uncertainty)
                             : fmt::format("{:.2e}", *row.error);
}

std::string flags_text(const StudyRow& row) {
  std::vector<std::string> flags;
  if (row.own) flags.push_back("as it is");
  if (row.pareto) flags.push_back("Pareto");
  if (row.reference_too_coarse) flags.push_back("reference too coarse");
  if (row.noisy) flags.push_back("noisy");
  return fmt::format("{}", fmt::join(flags, ", "));
}

/// How many letters of a terminal UTF-8 text takes.
std::size_t letters(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

std::vector<std::string> study_columns() {
  return {"knob",    "value",      "unknowns", "error",  "total error", "order",
          "seconds", "iterations", "MB",       "status", "remarks"};
}

std::vector<std::string> study_cells(const Study& study, const StudyRow& row) {
  const Trial& trial = study.trial(row);
  const bool ran = !trial.seconds.empty();
  return {row.knob,
          row.value,
          trial.usable() ? fmt::format("{}", trial.outcome.unknowns) : "-",
          error_text(row),
          row.total ? fmt::format("{:.2e}", *row.total) : "-",
          row.order ? fmt::format("{:.2f}", *row.order) : "-",
          seconds_text(trial.seconds),
          trial.usable() ? fmt::format("{}", trial.outcome.iterations) : "-",
          trial.outcome.peak_bytes > 0
              ? fmt::format("{:.0f}", static_cast<double>(trial.outcome.peak_bytes) / 1e6)
              : "-",
          ran ? std::string(enum_name(trial.outcome.status)) : "left out",
          flags_text(row)};
}

std::vector<std::string> study_header(const StudyRun& run) {
  return {fmt::format("What accuracy costs in time: {}", one_line(run.input)),
          fmt::format("{}, {} thread{}", run.processor, run.threads, run.threads == 1 ? "" : "s"),
          fmt::format("supple {}, {}; scene {:016x}", SUPPLE_VERSION, run.build, run.scene_hash)};
}

std::string study_text(const StudyRun& run) {
  std::vector<std::vector<std::string>> lines = {study_columns()};
  for (const StudyRow& row : run.study.rows) lines.push_back(study_cells(run.study, row));
  std::vector<std::size_t> widths(lines.front().size(), 0);
  for (const auto& line : lines)
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], letters(line[i]));
  std::string text = fmt::format("{}\n\n", fmt::join(study_header(run), "\n"));
  for (const auto& line : lines) {
    std::string row;
    for (std::size_t i = 0; i < line.size(); ++i)
      row += line[i] + std::string(widths[i] - letters(line[i]) + 2, ' ');
    text += row.substr(0, row.find_last_not_of(' ') + 1) + "\n";
  }
  for (const std::vector<std::string>& part : {study_findings(run), study_shortfalls(run.study)})
    if (!part.empty()) text += fmt::format("\n{}\n", fmt::join(part, "\n"));
  return text;
}

}  // namespace supple
