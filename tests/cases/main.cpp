#include <algorithm>
#include <exception>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tests/cases/cases.h"
#include "tests/cases/limits.h"

namespace supple {
namespace {

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const auto& group :
       {moment_matrix_cases(), degenerate_cloud_cases(), coupling_cases(), geometry_cases(),
        point_cloud_cases(), pose_cases(), extreme_pose_cases(), destroyed_start_cases(),
        input_cases(), hostile_file_cases(), cut_file_cases(), odd_input_cases(), fault_cases(),
        short_memory_cases(), circumstance_cases(), importer_cases(), solver_cases(),
        repeated_pose_cases()})
    cases.insert(cases.end(), group.begin(), group.end());
  return cases;
}

/// IDs that have a limit or a case, limits first, in their order.
std::vector<std::string> known_ids(const std::vector<Case>& cases) {
  std::vector<std::string> ids;
  const auto add = [&](std::string_view id) {
    if (std::find(ids.begin(), ids.end(), id) == ids.end()) ids.emplace_back(id);
  };
  for (const Limit& limit : limits()) add(limit.id);
  for (const Case& candidate : cases) add(candidate.id);
  return ids;
}

/// What the case gave; nothing where it ended by an exception.
Figures figures_of(std::string_view id, const std::vector<Case>& cases) {
  const auto hard = std::find_if(cases.begin(), cases.end(),
                                 [&](const Case& candidate) { return candidate.id == id; });
  if (hard == cases.end()) return {};
  try {
    Figures figures;
    hard->measure(figures);
    return figures;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", id, error.what());
    return {};
  }
}

struct Line {
  std::string_view id, figure;
  std::string value, relation, limit;
  bool pass;
  std::string_view doc;

  void print() const {
    fmt::print("{:<4} {:<31} {:>10} {:^8} {:>7}  {}  {}\n", id, figure, value, relation, limit,
               pass ? "pass" : "FAIL", doc);
  }
};

/// Prints a line for each limit and each figure of the case; returns how many fail.
int print_case(std::string_view id, const Figures& figures) {
  int failures = 0;
  const auto print = [&](const Line& line) {
    line.print();
    if (!line.pass) ++failures;
  };
  Figures unlimited = figures;
  for (const Limit& limit : limits()) {
    if (limit.id != id) continue;
    const auto found = figures.find(limit.figure);
    const bool measured = found != figures.end();
    print({id, limit.figure, measured ? fmt::format("{:.3g}", found->second) : "missing",
           std::string(symbol(limit.relation)), fmt::format("{:g}", limit.value),
           measured && limit.holds_for(found->second), limit.doc});
    if (measured) unlimited.erase(found->first);
  }
  for (const auto& [name, value] : unlimited)
    print({id, name, fmt::format("{:.3g}", value), "no limit", "", false, ""});
  return failures;
}

/// Runs the cases named in `wanted`, all where none is named. Returns the exit code.
int run(std::vector<std::string> wanted) {
  const std::vector<Case> cases = all_cases();
  const std::vector<std::string> known = known_ids(cases);
  for (const std::string& id : wanted)
    if (std::find(known.begin(), known.end(), id) == known.end()) {
      fmt::print(stderr, "cases: no case {}; there are {}\n", id, fmt::join(known, ", "));
      return 2;
    }
  if (wanted.empty()) wanted = known;
  int failures = 0;
  for (const std::string& id : wanted) failures += print_case(id, figures_of(id, cases));
  return failures == 0 ? 0 : 1;
}

}  // namespace
}  // namespace supple

int main(int argc, char** argv) {
  return supple::run({argv + 1, argv + argc});
}
