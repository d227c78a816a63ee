#include "modeler/cli/study_arguments.h"

#include <algorithm>

#include <fmt/format.h>

#include "io/errors.h"
#include "io/scene/complaint.h"
#include "io/scene/quantity.h"

namespace supple {
namespace {

constexpr int quick_levels = 3;

constexpr const char* description =
    "Shows what accuracy costs in time: varies the knobs of a scene one by one, times its pose "
    "with each, and measures how far it is from the result of ever more particles.";

constexpr const char* examples =
    R"(Writes study.csv, study.json, study.svg, study.png and study.html into the folder.

Examples:
  supple study scene.yaml -o study/
  supple study scene.yaml -o study/ --quick --knobs particles,tolerance
  supple study scene.yaml -o study/ --study-budget 120s --target-error 0.5%)";

/// "120s", "2min" or "120" [s].
double parse_time(const std::string& text, std::string_view option) {
  double unit = 1;
  std::string_view number = text;
  for (const auto& [suffix, seconds] : {std::pair<std::string_view, double>{"min", 60}, {"s", 1}})
    if (number.ends_with(suffix)) {
      number.remove_suffix(suffix.size());
      unit = seconds;
    }
  const std::optional<double> value = to_number(number);
  if (!value || !(*value > 0))
    throw UsageError(
        fmt::format("{} {}: allowed: a time above 0, as 120s or 2min", option, in_quotes(text)));
  return *value * unit;
}

/// "0.5%" or "0.005": over the diagonal.
double parse_error(const std::string& text) {
  const std::optional<Length> error = to_length(text);
  if (!error || !(error->value > 0))
    throw UsageError(fmt::format(
        "--target-error {}: allowed: an error above 0, over the shape's diagonal, as 0.5% or 0.005",
        in_quotes(text)));
  return resolve(*error, 1);
}

std::vector<std::string> parse_names(const std::string& text) {
  std::vector<std::string> names;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    names.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  return names;
}

}  // namespace

bool StudyArguments::parse(Words words) {
  CommandLine line("supple study", description);
  scene.declare(line);
  declare_study(line);
  run.declare(line);
  line.examples(examples);
  if (!line.parse(words)) return false;
  if (folder.empty()) throw UsageError("nothing to write to; give -o FOLDER");
  return true;
}

void StudyArguments::declare_study(CommandLine& line) {
  line.begin_group("Study");
  line.option("--knobs", {"NAME,...", "which knobs to vary (default: all that the scene has)"},
              [this](const std::string& value) { knobs = parse_names(value); });
  line.option("--study-budget",
              {"TIME", "start no run that is predicted to exceed this in all (120s, 2min)"},
              [this](const std::string& value) { budget = parse_time(value, "--study-budget"); });
  line.flag("--quick", "3 values of a knob instead of 5", [this] { levels = quick_levels; });
  line.option("--target-error",
              {"ERROR", "find the cheapest setting with this error, over the diagonal (0.5%)"},
              [this](const std::string& value) { target_error = parse_error(value); });
  line.option(
      "--time-budget", {"TIME", "find the most accurate setting whose pose takes so long"},
      [this](const std::string& value) { time_budget = parse_time(value, "--time-budget"); });
  line.begin_group("Output");
  line.option("-o,--output", {"FOLDER", "for tables and charts; needed"},
              [this](const std::string& value) { folder = value; });
  line.option("--report", {"FILE.json", "the same as study.json, elsewhere"},
              [this](const std::string& value) { report = value; });
}

}  // namespace supple
