#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "tests/cases/bar_runs.h"
#include "tests/cases/cases.h"
#include "tests/support/sample_files.h"

namespace supple {
namespace {

namespace fs = std::filesystem;

// The sanitizers bring an allocator of their own; their build leaves K16 out.
#ifndef SUPPLE_FAILING_ALLOCATIONS
#define SUPPLE_FAILING_ALLOCATIONS ""
#endif

/// A run, the files that it writes, and what they hold where nothing fails.
struct Run {
  Words words;
  std::map<std::string, std::string> outputs;
};

/// Whether an output is whole; a report tells times, so that no two are alike.
bool is_whole(const std::string& output, const std::string& bytes, const std::string& whole) {
  return output.ends_with(".json") ? nlohmann::json::accept(bytes) : bytes == whole;
}

/// `run` with variables that make allocations fail.
void measure_failure(const BarRuns& bar, const Run& run, const Words& variables, Figures& figures) {
  for (const auto& [output, whole] : run.outputs) bar.folder.put(output, "old");
  const long entries = bar.folder.entries();
  const ProgramResult result = bar.run(run.words, variables);
  const bool clean = result.code == 0 || result.code == 1 || result.code == 3;
  ++figures["failures"];
  figures["not_clean"] += !clean;
  figures["unsaid"] += result.code != 0 && result.err.find("supple: ") == std::string::npos;
  figures["survived"] += result.code == 0;
  figures["left_behind"] += static_cast<double>(bar.folder.entries() - entries);
  for (const auto& [output, whole] : run.outputs) {
    const std::string bytes = bar.bytes(output);
    const bool old = bytes == "old" && result.code != 0;
    figures["broken"] += !old && !is_whole(output, bytes, whole);
  }
  if (!clean)
    fmt::print(stderr, "K16: {} {}: exit code {} {}\n", fmt::join(variables, " "),
               fmt::join(run.words, " "), result.code, result.err);
}

/// Every `stride`-th allocation of `words` fails alone, then with all that come after it.
void measure_failures(const BarRuns& bar, const Words& words, const Words& outputs, int runs,
                      Figures& figures) {
  Run run{words, {}};
  const Words preload = {"LD_PRELOAD=" SUPPLE_FAILING_ALLOCATIONS,
                         "TBB_MALLOC_DISABLE_REPLACEMENT=1"};
  const int code = bar.run(words, preload + Words{"SUPPLE_COUNT_INTO=count"}).code;
  if (code != 0) throw std::runtime_error(fmt::format("{}: {}", fmt::join(words, " "), code));
  for (const std::string& output : outputs) run.outputs[output] = bar.bytes(output);
  const long allocations = std::stol(bar.bytes("count"));
  figures["allocations"] += static_cast<double>(allocations);
  const char* every = std::getenv("SUPPLE_EVERY_ALLOCATION");
  const long stride = every ? std::max(1, std::atoi(every)) : std::max(1l, allocations / runs);
  for (long number = 1; number <= allocations; number += stride)
    for (const char* variable : {"SUPPLE_FAIL_AT", "SUPPLE_FAIL_FROM"})
      measure_failure(bar, run, preload + Words{fmt::format("{}={}", variable, number)}, figures);
}

/// The program within so many KB of addresses.
void measure_address_limits(const BarRuns& bar, Figures& figures) {
  const Words pose = quick_pose("bar.off", {"-o", "posed.off"});
  for (const int kilobytes :
       {5'000, 10'000, 15'000, 20'000, 30'000, 60'000, 80'000, 100'000, 120'000, 140'000, 170'000,
        200'000, 250'000, 300'000, 400'000, 600'000}) {
    const Words words = {
        "-c", fmt::format("ulimit -v {}; exec timeout -s KILL 20 \"$0\" \"$@\"", kilobytes),
        SUPPLE_PROGRAM};
    const ProgramResult run = Program("/bin/sh", words + pose, bar.folder.path()).wait();
    figures["limits_done"] += run.code == 0;
    figures["limits_refused"] += run.code == 1 || run.code == 126 || run.code == 127;
    figures["limits_by_signal"] += run.code >= 128;
    if (run.code >= 128) fmt::print(stderr, "K16: {} KB: {} {}\n", kilobytes, run.code, run.err);
  }
}

void measure_short_memory(Figures& figures) {
  const BarRuns bar;
  for (const char* figure :
       {"not_clean", "unsaid", "survived", "left_behind", "broken", "limits_by_signal"})
    figures[figure] = 0;
  const Words pose =
      quick_pose("bar.off", {"-o", "posed.off", "--report", "posed.json", "--threads", "1"});
  measure_failures(bar, pose, {"posed.off", "posed.json"}, 40, figures);
  bar.folder.put("scene.yaml",
                 "shape: {mesh: bar.off, particles: 60}\npose:\n  handles:\n    - fix: y<10%\n");
  measure_failures(bar, {"plan", "scene.yaml"}, {}, 20, figures);
  for (const SampleFile& sample : sample_files()) {
    bar.folder.put(sample.name, sample.bytes);
    measure_failures(bar, {"inspect", sample.name, "--json", "--threads", "1"}, {}, 3, figures);
  }
  for (const char* format : {"obj", "ply", "stl", "glb", "pcd", "xyz"}) {
    const std::string output = fmt::format("posed.{}", format);
    measure_failures(bar, quick_pose("bar.off", {"-o", output, "--threads", "1"}), {output}, 3,
                     figures);
  }
  measure_address_limits(bar, figures);
}

constexpr Case cases[] = {{"K16", measure_short_memory}};

}  // namespace

std::span<const Case> short_memory_cases() {
  return cases;
}

}  // namespace supple
