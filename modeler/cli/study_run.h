#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "modeler/study/choice.h"

namespace supple {

/// What the user wished for and the setting that the study found for it.
struct WishedChoice {
  double wish = 0;  ///< an error over the diagonal, or seconds
  Choice choice;
};

/// A run of `supple study`: what its tables, charts and pages tell.
struct StudyRun {
  std::string input;  ///< the scene or shape, as the user named it
  std::uint64_t scene_hash = 0;
  std::string processor, build;
  int threads = 1;
  Study study;
  std::optional<WishedChoice> for_error, for_time;
  std::vector<std::string> notes;
  double total_seconds = 0;
};

/// A row of the table in words: what stands in its columns, as `study_columns` names them.
std::vector<std::string> study_columns();
std::vector<std::string> study_cells(const Study& study, const StudyRow& row);

/// "particles=400", for people.
std::string row_text(const StudyRow& row);

/// How many times the time 10 times less error costs: "8.4", "120".
std::string cost_text(const PowerLaw& cost);

/// The scene, the machine and the program, a line each.
std::vector<std::string> study_header(const StudyRun& run);

/// What the study found, a sentence each.
std::vector<std::string> study_findings(const StudyRun& run);

/// What failed, is degraded or was left out, a line each, with the reason.
std::vector<std::string> study_shortfalls(const Study& study);

std::string study_text(const StudyRun& run);  ///< for a terminal
std::string study_csv(const StudyRun& run);   ///< every row, in full precision
std::string study_json(const StudyRun& run);  ///< keys are stable (docs/study.md)
std::string study_html(const StudyRun& run);  ///< one page that needs no other file

}  // namespace supple
