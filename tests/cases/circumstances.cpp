#include <algorithm>
#include <chrono>
#include <clocale>
#include <locale>
#include <map>
#include <regex>
#include <sstream>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "io/chart/log_log_chart.h"
#include "io/scene/scene_hash.h"
#include "io/scene/scene_reader.h"
#include "tests/cases/bar_runs.h"
#include "tests/cases/cases.h"
#include "tests/support/sample_files.h"

namespace supple {
namespace {

namespace fs = std::filesystem;

/// Notes on an unlikely size that `words` lead to; the size that they name must hold `size`.
int size_warnings(const BarRuns& bar, const Words& words, std::string_view size = {}) {
  const ProgramResult run = bar.run(words);
  const auto report = nlohmann::json::parse(bar.bytes("posed.json"));
  int warnings = 0;
  for (const std::string note : report["notes"])
    warnings += note.find(fmt::format("the shape is {}", size)) != std::string::npos &&
                note.find("unlikely") != std::string::npos &&
                run.err.find(note) != std::string::npos;
  return warnings;
}

void measure_sizes(Figures& figures) {
  const BarRuns bar;
  const Words outputs = {"-o", "posed.off", "--report", "posed.json"};
  const auto warned = [&](double size, const Words& more, std::string_view told = {}) {
    Mesh mesh = make_bar({1, 1, 4}, {2, 2, 8});
    mesh.positions *= size / std::sqrt(18.0);
    write_mesh(mesh, bar.folder / "sized.obj");
    return size_warnings(bar, quick_pose("sized.obj", outputs + more), told);
  };
  // A body of 1.8 m in millimetres, without the key that says so.
  figures["millimetres_told"] = warned(1800, {}, "1.8e+03 m large");
  figures["millimetres_honoured"] = warned(1800, {"--units", "mm"}) == 0;
  for (const auto& [units, size] : {std::pair{"cm", 18.0}, {"in", 1.0}, {"m", 0.1}})
    figures["likely_warned"] += warned(size, {"--units", units});
  figures["likely_warned"] += warned(1.01e-3, {}) + warned(0.99e3, {});
  figures["unlikely_warned"] = warned(0.99e-3, {}) + warned(1.01e3, {}) +
                               warned(0.5, {"--units", "mm"}) + warned(1e-9, {}) + warned(1e9, {});
  warned(1800, {});
  const std::string in_metres = bar.bytes("posed.off");
  warned(1800, {"--units", "mm"});
  figures["poses_differ"] = in_metres != bar.bytes("posed.off");
}

/// Numbers as a German writes them: 1.234,5.
class GermanNumbers : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// Numbers of C++ streams and, where the system has or can make that locale, of C functions, as
/// long as it lives.
class GermanLocale {
 public:
  explicit GermanLocale(const fs::path& made)
      : before_(std::locale::global(std::locale(std::locale::classic(), new GermanNumbers))) {
    ::setenv("LOCPATH", made.c_str(), 1);
    std::setlocale(LC_ALL, "de_DE.UTF-8");
  }
  ~GermanLocale() {
    std::locale::global(before_);
    std::setlocale(LC_ALL, "C");
    ::unsetenv("LOCPATH");
  }

  /// Of streams and of C.
  static int with_comma() {
    std::ostringstream stream;
    stream << 0.5;
    return (stream.str() == "0,5") + (*std::localeconv()->decimal_point == ',');
  }

 private:
  std::locale before_;
};

LogLogChart some_chart() {
  LogLogChart chart{.title = "a", .x_title = "b", .y_title = "c", .curves = {}, .band = 0.0015};
  chart.curves.push_back(
      {.name = "d", .color = {0, 0, 1}, .points = {{1e-3, 1234.5, 1e3, 2e3, "1"}, {0.5, 0.25}}});
  return chart;
}

/// All that the library writes, and a hash of what it reads, by name.
std::map<std::string, std::string> all_written() {
  const TemporaryFolder folder;
  std::map<std::string, std::string> bytes;
  for (const SampleFile& sample : sample_files()) {
    Mesh mesh = read_mesh(folder.put(sample.name, sample.bytes));
    mesh.positions *= 1234.5;
    for (const char* format : {"obj", "off", "ply", "stl", "glb", "gltf", "pcd", "pwn", "xyz"}) {
      const std::string name = fmt::format("b.{}", format);
      const bool fits = (mesh.face_count() > 0 || format != std::string_view("stl")) &&
                        (!mesh.normals.empty() || format != std::string_view("pwn"));
      if (fits) bytes[sample.name + name] = written(mesh, name);
    }
  }
  Sketch sketch{.width = 640, .height = 480, .shapes = {}};
  draw(some_chart(), Frame{100, 80, 500, 380}, sketch);
  bytes["svg"] = svg(sketch);
  write_png(rasterize(sketch), folder / "a.png");
  bytes["png"] = bytes_of(folder / "a.png");
  const Scene scene = read_scene_text(
      "shape: {mesh: a.off, spacing: 0.125}\npose:\n  tolerance: 2.5e-7\n"
      "  handles: [{fix: y<12.5%}, {move: z>0.75, by: [0.5%, 1.5%, 0%]}]\n",
      "s.yaml", "");
  bytes["scene"] = fmt::format("{:x}", scene_hash(scene));
  return bytes;
}

/// A report apart from the seconds and the memory that it took.
std::string timeless(std::string report) {
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(report);
  json.erase("seconds");
  json.erase("memory_peak_bytes");
  for (auto& effect : json["effects"]["active"]) effect.erase("seconds");
  return json.dump();
}

/// What a pose and a study write, of the study what does not depend on times.
std::map<std::string, std::string> program_written(const Words& variables) {
  const BarRuns bar;
  bar.run(quick_pose("bar.off", all_outputs), variables);
  std::map<std::string, std::string> bytes;
  for (const std::string& output : pose_outputs) bytes[output] = bar.bytes(output);
  bytes["posed.json"] = timeless(bytes["posed.json"]);
  bar.run({"study", "bar.off", "--fix", "z<10%", "--move", "z>90%", "--by", "10%,0,0", "--quick",
           "--knobs", "particles", "--particles", "60", "-o", "study"},
          variables);
  std::istringstream table(bar.bytes("study/study.csv"));
  for (std::string line; std::getline(table, line);)
    bytes["study"] += line.substr(0, line.find("extrapolated")) + "\n";
  bytes["svg"] = std::to_string(
      std::regex_search(bar.bytes("study/study.svg"), std::regex("=\"[0-9]+,[0-9]+\"")));
  return bytes;
}

int differences(const std::map<std::string, std::string>& a,
                const std::map<std::string, std::string>& b) {
  int count = a.size() == b.size() ? 0 : 1;
  for (const auto& [name, bytes] : a) {
    if (b.contains(name) && b.at(name) == bytes) continue;
    ++count;
    fmt::print(stderr, "K17: {} differs\n", name);
  }
  return count;
}

void measure_locales(Figures& figures) {
  const TemporaryFolder folder;
  Program("/usr/bin/env", {"localedef", "-i", "de_DE", "-f", "UTF-8", "./de_DE.UTF-8"},
          folder.path())
      .wait();
  const auto library = all_written();
  {
    const GermanLocale german(folder.path());
    figures["locales_with_comma"] = GermanLocale::with_comma();
    figures["library_differs"] = differences(library, all_written());
  }
  const auto program = program_written({"LC_ALL=C", "TZ=UTC"});
  figures["files_compared"] = static_cast<double>(library.size() + program.size());
  figures["program_differs"] = differences(
      program, program_written({"LANG=de_DE.UTF-8", "LC_ALL=de_DE.UTF-8",
                                "LOCPATH=" + folder.path().string(), "TZ=Asia/Kolkata"}));
}

/// A folder that another run writes into: refused at once, with who that is.
void measure_held_folder(const BarRuns& bar, Figures& figures) {
  const Words study = {"study", "bar.off", "--fix",   "z<10%", "--move", "z>90%",
                       "--by",  "10%,0,0", "--quiet", "-o",    "study"};
  const Program first = bar.start(study);
  while (!fs::exists(bar.folder / "study")) std::this_thread::yield();
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  const ProgramResult second = bar.run(study);
  figures["held_exit_code"] = second.code;
  figures["held_seconds"] = second.seconds;
  figures["held_said"] =
      second.err.find(fmt::format("(process {})", first.process())) != std::string::npos;
  first.signal(SIGKILL);
  first.wait();
  figures["after_kill_exit_code"] = bar.run(study + Words{"--quick", "--knobs", "particles"}).code;
  figures["files_in_folder"] = static_cast<double>(
      std::distance(fs::directory_iterator(bar.folder / "study"), fs::directory_iterator()));
}

/// Two runs into the same files: each is whole and of one of them.
void measure_same_files(const BarRuns& bar, Figures& figures) {
  const Words run[] = {quick_pose("bar.off", all_outputs),
                       quick_pose("bar.off", all_outputs + Words{"--set", "shape.particles=90"})};
  std::map<std::string, std::string> whole[2];
  for (int k = 0; k < 2; ++k) {
    bar.run(run[k]);
    for (const std::string& output : pose_outputs) whole[k][output] = bar.bytes(output);
  }
  figures["runs_alike"] = whole[0]["posed.ply"] == whole[1]["posed.ply"];
  for (int time = 0; time < 20; ++time) {
    const Program first = bar.start(run[0]), second = bar.start(run[1]);
    figures["failed"] += first.wait().code + second.wait().code;
    for (const char* output : {"posed.ply", "posed.png"})
      figures["mixed"] +=
          bar.bytes(output) != whole[0][output] && bar.bytes(output) != whole[1][output];
    figures["mixed"] += !nlohmann::json::accept(bar.bytes("posed.json"));
  }
}

/// Files that change when what was written is read and written again.
void measure_round_trips(Figures& figures) {
  const TemporaryFolder folder;
  for (const SampleFile& sample : sample_files()) {
    const std::string first =
        written(read_mesh(folder.put(sample.name, sample.bytes)), sample.name);
    const std::string second = written(read_mesh(folder.put(sample.name, first)), sample.name);
    figures["round_trips_differ"] += first != second;
    ++figures["round_trips"];
  }
}

void measure_two_runs(Figures& figures) {
  const BarRuns bar;
  for (const char* figure : {"failed", "mixed", "round_trips_differ"}) figures[figure] = 0;
  measure_same_files(bar, figures);
  measure_held_folder(bar, figures);
  measure_round_trips(figures);
}

constexpr Case cases[] = {
    {"K10", measure_sizes}, {"K17", measure_locales}, {"K20", measure_two_runs}};

}  // namespace

std::span<const Case> circumstance_cases() {
  return cases;
}

}  // namespace supple
