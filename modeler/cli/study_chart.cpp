#include "modeler/cli/study_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "io/chart/log_log_chart.h"
#include "io/chart/stacked_bars.h"

namespace supple {
namespace {

constexpr int chart_width = 1380, chart_height = 860;  // [px]
constexpr Frame errors_frame{80, 160, 800, 700}, stages_frame{1040, 160, 1240, 780};
constexpr double header_step = 20, header_left = 30;  // [px]

constexpr std::array<Color, 7> knob_colors{{{0.12f, 0.35f, 0.75f},
                                            {0.80f, 0.20f, 0.15f},
                                            {0.15f, 0.55f, 0.25f},
                                            {0.55f, 0.30f, 0.65f},
                                            {0.75f, 0.45f, 0.05f},
                                            {0.05f, 0.55f, 0.60f},
                                            {0.35f, 0.35f, 0.35f}}};

ChartPoint point_of(const Study& study, const StudyRow& row, double error) {
  const std::vector<double>& seconds = study.trial(row).seconds;
  const auto [least, greatest] = std::minmax_element(seconds.begin(), seconds.end());
  const bool sound = study.trial(row).outcome.status == Status::ok;
  return {error,
          median(seconds),
          *least,
          *greatest,
          row.own ? std::string() : row.value,
          sound ? ChartPoint::Mark::full : ChartPoint::Mark::hollow};
}

/// The knobs of the rows, in their order.
std::vector<std::string> knobs_of(const Study& study) {
  std::vector<std::string> knobs;
  for (const StudyRow& row : study.rows)
    if (knobs.empty() || knobs.back() != row.knob) knobs.push_back(row.knob);
  return knobs;
}

/// Where a knob has a reference of its own, its error from that is a dashed curve.
void add_knob(const Study& study, const std::string& knob, const Color& color, LogLogChart& chart) {
  ChartCurve compared{knob, color, {}, 0}, own{"", color, {}, 5};
  for (const StudyRow& row : study.rows) {
    if (row.knob != knob) continue;
    const Trial& trial = study.trial(row);
    if (const auto error = Study::compared(row))
      compared.points.push_back(point_of(study, row, *error));
    else if (!trial.seconds.empty())
      chart.failures.push_back({fmt::format("{}={}", knob, row.value), color});
    if (row.total && row.error && *row.total != *row.error) {
      own.points.push_back(point_of(study, row, *row.error));
      own.name = fmt::format("{}, against {}", knob, row.reference);
    }
  }
  chart.curves.push_back(std::move(compared));
  if (!own.points.empty()) chart.curves.push_back(std::move(own));
}

LogLogChart errors_chart(const Study& study) {
  LogLogChart chart;
  chart.title = "Ring: the scene as it is; thick: Pareto front; hollow: degraded; x: failed";
  chart.y_title = "seconds, median of the runs [min-max]";
  chart.x_title = "error: rms over the surface, over the diagonal (falling)";
  const std::vector<std::string> knobs = knobs_of(study);
  for (std::size_t i = 0; i < knobs.size(); ++i)
    add_knob(study, knobs[i], knob_colors[i % knob_colors.size()], chart);
  for (const std::size_t i : study.pareto)
    chart.front.push_back(point_of(study, study.rows[i], *Study::compared(study.rows[i])));
  if (study.own && Study::compared(study.rows[*study.own]))
    chart.ring = point_of(study, study.rows[*study.own], *Study::compared(study.rows[*study.own]));
  if (study.reference) {
    chart.band = study.reference->uncertainty;
    chart.band_text = "uncertainty of the reference";
  }
  if (study.cost)
    chart.slope = {study.cost->exponent,
                   fmt::format("10x less error: {}x the time", cost_text(*study.cost))};
  return chart;
}

/// The stages of all trials, in the order in which they ran, and what they do not tell.
std::vector<std::string> stage_names(const Study& study) {
  std::vector<std::string> names;
  for (const Trial& trial : study.trials)
    for (const auto& [stage, seconds] : trial.outcome.stages)
      if (std::find(names.begin(), names.end(), stage) == names.end()) names.push_back(stage);
  names.push_back("rest");
  return names;
}

StackedBars stages_chart(const Study& study) {
  StackedBars chart{"Share of each stage in the time", stage_names(study), {}};
  for (const Trial& trial : study.trials) {
    if (trial.seconds.empty()) continue;
    StackedBar bar{
        setting_text(trial.settings), {}, fmt::format("{:.3g} s", median(trial.seconds))};
    bar.parts.assign(chart.part_names.size(), 0);
    for (const auto& [stage, seconds] : trial.outcome.stages) {
      const auto at = std::find(chart.part_names.begin(), chart.part_names.end(), stage);
      bar.parts[static_cast<std::size_t>(at - chart.part_names.begin())] += seconds;
    }
    const double told = std::accumulate(bar.parts.begin(), bar.parts.end(), 0.0);
    bar.parts.back() = std::max(0.0, trial.outcome.seconds - told);
    chart.bars.push_back(std::move(bar));
  }
  return chart;
}

}  // namespace

Sketch study_chart(const StudyRun& run) {
  Sketch sketch{chart_width, chart_height};
  double y = 24;
  for (const std::string& line : study_header(run)) {
    sketch.add(SketchText{{header_left, y}, line});
    y += header_step;
  }
  draw(errors_chart(run.study), errors_frame, sketch);
  draw(stages_chart(run.study), stages_frame, sketch);
  return sketch;
}

}  // namespace supple
