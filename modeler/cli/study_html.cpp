#include <fmt/format.h>

#include "modeler/cli/study_chart.h"

namespace supple {
namespace {

constexpr std::string_view head = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8"/>
<title>supple study</title>
<style>
body { font-family: sans-serif; margin: 2em; color: #26262b; }
table { border-collapse: collapse; font-size: 14px; }
th, td { padding: 3px 10px; border-bottom: 1px solid #ddd; text-align: left; white-space: nowrap; }
svg { max-width: 100%; height: auto; }
</style>
</head>
<body>
)";

std::string list(std::string_view title, const std::vector<std::string>& items) {
  if (items.empty()) return {};
  std::string text = fmt::format("<h2>{}</h2>\n<ul>\n", title);
  for (const std::string& item : items) text += fmt::format("<li>{}</li>\n", xml_text(item));
  return text + "</ul>\n";
}

std::string table_row(std::string_view tag, const std::vector<std::string>& cells) {
  std::string text = "<tr>";
  for (const std::string& cell : cells) text += fmt::format("<{0}>{1}</{0}>", tag, xml_text(cell));
  return text + "</tr>\n";
}

}  // namespace

std::string study_html(const StudyRun& run) {
  const std::vector<std::string> header = study_header(run);
  std::string text(head);
  text += fmt::format("<h1>{}</h1>\n", xml_text(header.front()));
  for (std::size_t i = 1; i < header.size(); ++i)
    text += fmt::format("<p>{}</p>\n", xml_text(header[i]));
  text += list("Findings", study_findings(run)) + svg(study_chart(run));
  text += "<h2>Runs</h2>\n<table>\n" + table_row("th", study_columns());
  for (const StudyRow& row : run.study.rows) text += table_row("td", study_cells(run.study, row));
  text += "</table>\n" + list("Not ok, or left out", study_shortfalls(run.study)) +
          list("Notes", run.notes);
  return text + "</body>\n</html>\n";
}

}  // namespace supple
