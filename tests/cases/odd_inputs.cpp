#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "tests/cases/bar_runs.h"
#include "tests/cases/cases.h"

namespace supple {
namespace {

namespace fs = std::filesystem;

ProgramResult run_in(const TemporaryFolder& folder, const Words& words) {
  return Program(SUPPLE_PROGRAM, words, folder.path()).wait();
}

Mesh small_bar() {
  return make_bar({1, 1, 4}, {2, 2, 8});
}

/// `stem` with an extension, no longer than file systems take.
std::string file_name(std::string_view stem, const std::string& extension) {
  return std::string(stem.substr(0, 255 - extension.size())) + extension;
}

/// As JSON has it, whose text is UTF-8: each byte that is no part of that becomes U+FFFD.
std::string as_json_text(const std::string& name) {
  using Json = nlohmann::json;
  return Json::parse(Json(name).dump(-1, ' ', false, Json::error_handler_t::replace));
}

struct OddNames {
  int done = 0, valid_json = 0, names_back = 0, written = 0, lines_off = 0;
};

long lines_of(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

/// A report that parses and names its input and outputs.
void check_report(const std::string& text, const Words& names, OddNames& odd) {
  const nlohmann::json report = nlohmann::json::parse(text, nullptr, false);
  if (report.is_discarded()) return;
  ++odd.valid_json;
  Words told = {report["input"]};
  for (const auto& output : report["outputs"]) told.push_back(output);
  odd.names_back += std::equal(
      told.begin(), told.end(), names.begin(), names.end(),
      [](const std::string& json, const std::string& name) { return json == as_json_text(name); });
}

/// Poses with all names made of `stem`; `plain` is what the program says with a plain one.
void pose_with_names(std::string_view stem, bool by_scene, const ProgramResult& plain,
                     OddNames& odd) {
  const TemporaryFolder folder;
  const std::string shape = by_scene ? "bar.off" : file_name(stem, ".off");
  write_mesh(small_bar(), folder / shape);
  const std::string scene = file_name(stem, ".yaml");
  folder.put(scene,
             "shape: {mesh: bar.off, particles: 60}\npose:\n  handles:\n    - fix: z<10%\n"
             "    - {move: z>90%, by: [10%, 0, 0]}\n");
  const std::string mesh = file_name(stem, ".ply"), picture = file_name(stem, ".png"),
                    report = file_name(stem, ".json"), input = by_scene ? scene : shape;
  const Words outputs = {"-o", mesh, "--picture", picture, "--report", report, "--size", "64x64"};
  Words words = {"pose", scene};
  words.insert(words.end(), outputs.begin(), outputs.end());
  const ProgramResult run = run_in(folder, by_scene ? words : quick_pose(shape, outputs));
  odd.done += run.code == 0;
  odd.written += fs::exists(folder / mesh) && fs::exists(folder / picture);
  odd.lines_off += lines_of(run.out) != lines_of(plain.out);
  check_report(bytes_of(folder / report), {input, mesh, picture}, odd);
}

/// Whether a name that is nowhere is told in one line.
bool is_missed_in_one_line(std::string_view stem) {
  const TemporaryFolder folder;
  const ProgramResult run = run_in(folder, {"inspect", file_name(stem, ".off")});
  return run.code == 3 && lines_of(run.err) == 1;
}

const std::string odd_names[] = {"sp ace and  more ",
                                 "测试模型",
                                 "\xff\xfe\x80 no UTF-8 \xc3",
                                 "new\nline\r\nand return",
                                 "'single' \"double\" `back`",
                                 "back\\slash\\n",
                                 "bell\a escape\x1b[31m del\x7f",
                                 "{} {0} %s %n $HOME *?",
                                 "<b>&amp;<b>",
                                 "#comment: yes, [no]",
                                 std::string(255, 'n')};

void measure_names(Figures& figures) {
  const TemporaryFolder folder;
  write_mesh(small_bar(), folder / "bar.off");
  const ProgramResult plain =
      run_in(folder, quick_pose("bar.off", {"-o", "a.ply", "--picture", "a.png", "--report",
                                            "a.json", "--size", "64x64"}));
  OddNames shapes, scenes;
  int missed = 0;
  for (const std::string& name : odd_names) {
    pose_with_names(name, false, plain, shapes);
    pose_with_names(name, true, plain, scenes);
    missed += is_missed_in_one_line(name);
  }
  const double runs = 2.0 * static_cast<double>(std::size(odd_names));
  figures = {{"done", (shapes.done + scenes.done) / runs},
             {"written", (shapes.written + scenes.written) / runs},
             {"valid_json", (shapes.valid_json + scenes.valid_json) / runs},
             {"names_back", (shapes.names_back + scenes.names_back) / runs},
             {"lines_off", shapes.lines_off},
             {"missed_in_one_line", 2 * missed / runs}};
}

std::string repeated(std::string_view text, int times) {
  std::string all;
  for (int time = 0; time < times; ++time) all += text;
  return all;
}

/// Nine lists, each of nine aliases of the one before.
std::string alias_bomb() {
  std::string text = "a0: &a0 [x, x, x, x, x, x, x, x, x]\n";
  for (int level = 1; level < 9; ++level)
    text += fmt::format("a{0}: &a{0} [{1}*a{2}]\n", level,
                        repeated(fmt::format("*a{}, ", level - 1), 8), level - 1);
  return text;
}

/// Text that is no scene, and words of the answer to it.
struct OddScene {
  std::string text, words;
  std::uintmax_t megabytes = 0;  ///< to which the file is stretched
};

std::vector<OddScene> odd_scenes() {
  constexpr int deep = 100'000, large = 1 << 19;
  const std::string shape = "shape: {mesh: bar.off}\n";
  return {
      {repeated("[", deep), ""},
      {repeated("{a: ", deep), ""},
      {repeated("- ", deep), "nested deeper than 64"},
      {repeated("? ", deep), ""},
      {repeated("a: [", 60), ""},
      {alias_bomb(), "anchors"},
      {"a: &a [*a]\n", "anchors"},
      {shape + "<<: {a: 1}\n", "merges"},
      {"shape: {mesh: bar.off, particles: .nan}\n", ":1:35: "},
      {"shape: {mesh: bar.off, particles: .inf}\n", ":1:35: "},
      {"shape: {mesh: bar.off, support_scale: .nan}\n", ":1:39: "},
      {"shape: {mesh: bar.off, support_scale: nan}\n", ":1:39: "},
      {"shape: {mesh: bar.off, spacing: 1e400}\n", ":1:33: "},
      {"shape: {mesh: bar.off, particles: 99999999999999999999}\n", ":1:35: "},
      {shape + shape, ":2:1: the key 'shape' stands twice"},
      {"shape: {mesh: bar.off, mesh: b.off}\n", "stands twice"},
      {"shape:\n\tmesh: bar.off\n", ":2:1: a tab"},
      {"shape:\n  mesh: bar.off\n \t particles: 3\n", ":3:2: a tab"},
      {std::string("shape: {mesh: a\0b}\n", 19), "control character (byte 0x00)"},
      {std::string("\0\0\0\0", 4), ":1:1: a control character"},
      {"shape: {mesh: \"a\\0b.off\"}\n", "zero byte"},
      {"\xFE\xFFs", "UTF-16"},
      {"shape: {mesh: \"bar.off}\n", "not closed"},
      {"shape: {mesh: 'bar.off}\n", "not closed"},
      {"shape:\n  mesh: 'bar.off\n", "not closed"},
      {"shape:\n  mesh: \"bar.off\n", "not closed"},
      {"shape:\n  mesh: 'bar.off''\n", "not closed"},
      {"shape: \"" + std::string(large, 'a'), "EOF"},
      {"shape: '" + repeated("a\n", large / 2), "not closed"},
      {"shape: " + std::string(large, 'a') + "\n", "shape is text"},
      {std::string(large, ':'), ""},
      {std::string(large, '-'), ""},
      {std::string(large, '!'), ""},
      {std::string(large, '\n') + "a", "is text"},
      {"a:" + std::string(large, ' ') + "b\n", "unknown key"},
      {"shape: [" + std::string(large, ','), ""},
      {"shape: {" + repeated("a: 1, ", 90'000), "stands twice"},
      {"shape: aaa", "bytes, more than 1048576", 100},
  };
}

/// "scene.yaml:7:1: " at the start of what the program says.
bool has_place(const std::string& error) {
  int line = 0, column = 0, end = 0;
  std::sscanf(error.c_str(), "supple: scene.yaml:%d:%d: %n", &line, &column, &end);
  return end > 0 && line > 0 && column > 0;
}

void measure_odd_yaml(Figures& figures) {
  const TemporaryFolder folder;
  const std::vector<OddScene> scenes = odd_scenes();
  double seconds = 0, bytes = 0;
  int placed = 0, named = 0, accepted = 0;
  for (const OddScene& scene : scenes) {
    folder.put("scene.yaml", scene.text);
    if (scene.megabytes > 0) fs::resize_file(folder / "scene.yaml", scene.megabytes << 20);
    const ProgramResult run = run_in(folder, {"plan", "scene.yaml"});
    seconds = std::max(seconds, run.seconds);
    bytes = std::max(bytes, run.peak_bytes);
    const bool too_large = run.code == 3;  // told of the file, before it is read
    accepted += run.code != 2 && !too_large;
    placed += has_place(run.err) || too_large;
    const bool told = run.err.find(scene.words) != std::string::npos;
    named += told;
    if (!told || (!has_place(run.err) && !too_large))
      fmt::print(stderr, "K8: {:.40}: {} {:.200}\n", scene.text, run.code, run.err);
  }
  folder.put("scene.yaml", "\xEF\xBB\xBFshape: {mesh: bar.off, particles: 7}\n");
  const auto share = [&](int part) { return part / static_cast<double>(scenes.size()); };
  figures = {{"accepted", accepted},
             {"placed", share(placed)},
             {"named", share(named)},
             {"seconds", seconds},
             {"peak_megabytes", bytes / 1e6},
             {"byte_order_mark_exit_code", run_in(folder, {"plan", "scene.yaml"}).code}};
}

/// What stands in place of a file, all under names that end in `extension`.
Words put_no_files(const TemporaryFolder& folder, const std::string& extension) {
  const auto path = [&](const std::string& name) { return folder / (name + extension); };
  fs::create_directory(path("folder"));
  ::mkfifo(path("pipe").c_str(), 0600);
  fs::create_symlink("/dev/zero", path("zero"));
  fs::create_symlink("loop" + extension, path("loop"));
  folder.put("large" + extension, "");
  fs::resize_file(path("large"), std::uintmax_t{10} << 30);  // a hole, no bytes on the disk
  return {"folder" + extension, "pipe" + extension,  "zero" + extension,
          "loop" + extension,   "large" + extension, "missing" + extension};
}

/// Ways to name an input.
std::vector<Words> uses_of(const std::string& file) {
  if (file.ends_with(".yaml")) return {{"plan", file}, {"pose", file, "-o", "out.off"}};
  const Words lead = {"-o", "out.off"};
  if (file.ends_with(".off"))
    return {{"inspect", file},
            {"render", file, "-o", "out.png"},
            quick_pose(file, lead),
            quick_pose("bar.off", {"-o", "out.off", "--from", file}),
            quick_pose("bar.off", {"-o", "out.off", "--move", "z>95%", "--to", file})};
  return {quick_pose("bar.off", {"-o", "out.off", "--fix", "vertices(" + file + ")"}),
          {"pose", "bar.off", "--move", "z>90%", "--to", file, "-o", "out.off"}};
}

void measure_no_files(Figures& figures) {
  const TemporaryFolder folder;
  write_mesh(small_bar(), folder / "bar.off");
  double seconds = 0, bytes = 0;
  int wrong = 0, silent = 0;
  for (const char* extension : {".off", ".yaml", ".txt"})
    for (const std::string& file : put_no_files(folder, extension))
      for (Words& words : uses_of(file)) {
        words.insert(words.begin(), {"-s", "KILL", "10", SUPPLE_PROGRAM});
        const ProgramResult run = Program("/usr/bin/timeout", words, folder.path()).wait();
        seconds = std::max(seconds, run.seconds);
        bytes = std::max(bytes, run.peak_bytes);
        wrong += run.code != 3;
        silent += run.err.find(file) == std::string::npos;
        if (run.code != 3)
          fmt::print(stderr, "K18: {}: {} {}\n", fmt::join(words, " "), run.code, run.err);
      }
  figures = {{"not_exit_code_3", wrong},
             {"without_its_name", silent},
             {"seconds", seconds},
             {"peak_megabytes", bytes / 1e6},
             {"written", fs::exists(folder / "out.off") || fs::exists(folder / "out.png")}};
}

constexpr Case cases[] = {
    {"K7", measure_names}, {"K8", measure_odd_yaml}, {"K18", measure_no_files}};

}  // namespace

std::span<const Case> odd_input_cases() {
  return cases;
}

}  // namespace supple
