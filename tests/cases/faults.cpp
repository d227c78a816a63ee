#include <algorithm>
#include <chrono>
#include <map>
#include <thread>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "io/errors.h"
#include "io/picture/picture.h"
#include "solver/core/random.h"
#include "tests/cases/bar_runs.h"
#include "tests/cases/cases.h"
#include "tests/support/file_size_limit.h"

namespace supple {
namespace {

namespace fs = std::filesystem;

constexpr const char* writable_formats[] = {"obj",  "off", "ply", "stl", "glb",
                                            "gltf", "pcd", "pwn", "xyz"};

const Words quick_study = {"study", "bar.off", "--fix",   "z<10%",   "--move",    "z>90%",
                           "--by",  "10%,0,0", "--quick", "--knobs", "particles", "--particles",
                           "60",    "--quiet", "-o",      "study",   "--report",  "report.json"};
const Words study_outputs = {"study/study.csv", "study/study.json", "study/study.svg",
                             "study/study.png", "study/study.html", "report.json"};

/// A run and the files that it writes.
struct Run {
  Words words, outputs;
};

/// `words`, once for each of `outputs`, which is a link to a full device.
void measure_full_device(const BarRuns& bar, const Run& run, Figures& figures) {
  for (const std::string& output : run.outputs) {
    fs::create_directories((bar.folder / output).parent_path());
    fs::remove(bar.folder / output);
    fs::create_symlink("/dev/full", bar.folder / output);
    const ProgramResult result = bar.run(run.words);
    ++figures["full_devices"];
    figures["full_refused"] += result.code == 3;
    figures["full_said"] += result.err.find("ENOSPC") != std::string::npos &&
                            result.err.find(output) != std::string::npos;
    fs::remove(bar.folder / output);
  }
}

/// The same where no file may grow beyond `limit`: files that would stay as they were.
void measure_limit(const BarRuns& bar, const Run& run, rlim_t limit, Figures& figures) {
  for (const std::string& output : run.outputs) bar.folder.put(output, "old");
  const long entries = bar.folder.entries();
  const FileSizeLimit held(limit);
  const ProgramResult result = bar.run(run.words);
  ++figures["limits"];
  figures["limits_refused"] += result.code == 3;
  figures["left_behind"] += static_cast<double>(bar.folder.entries() - entries);
  for (const std::string& output : run.outputs) {
    const std::string bytes = bar.bytes(output);
    figures["broken"] += bytes != "old" && bytes.size() > limit;
    figures["kept"] += bytes == "old";
  }
}

/// Each output of `run` cut where it would grow beyond 0, 1, half and nine tenths of its bytes: the
/// times that outputs tell make them longer or shorter.
void measure_limits(const BarRuns& bar, const Run& run, Figures& figures) {
  bar.run(run.words);
  std::vector<rlim_t> limits = {0, 1};
  for (const std::string& output : run.outputs)
    for (const double share : {0.5, 0.9})
      limits.push_back(static_cast<rlim_t>(share * double(bar.bytes(output).size())));
  for (const rlim_t limit : limits) measure_limit(bar, run, limit, figures);
}

/// Every write of a mesh's files, of 256 KB each, cut short: refused, the old file as it was.
void measure_every_write(Figures& figures) {
  const TemporaryFolder folder;
  Mesh sphere = make_icosphere(1, 5);
  sphere.normals.values = sphere.positions;
  for (const char* format : writable_formats) {
    const fs::path path = folder / fmt::format("a.{}", format);
    write_mesh(sphere, path);
    const auto size = static_cast<rlim_t>(fs::file_size(path));
    folder.put(path.filename().string(), "old");
    for (rlim_t limit = 0; limit < size; limit = std::max(limit + (1 << 18), limit + 1)) {
      const FileSizeLimit held(std::min(limit, size - 1));
      ++figures["writes"];
      try {
        write_mesh(sphere, path);
      } catch (const OutputError&) {
        ++figures["writes_refused"];
      }
      figures["writes_broken"] += bytes_of(path) != "old";
    }
  }
  figures["writes_left_behind"] =
      static_cast<double>(folder.entries()) - static_cast<double>(std::size(writable_formats));
}

void measure_full_disks(Figures& figures) {
  const BarRuns bar;
  for (const char* figure : {"full_said", "broken", "left_behind", "kept"}) figures[figure] = 0;
  const Run pose{quick_pose("bar.off", all_outputs), pose_outputs};
  const Run study{quick_study, study_outputs};
  for (const char* format : writable_formats) {
    const std::string mesh = fmt::format("posed.{}", format);
    if (mesh != "posed.pwn")  // needs normals, which the bar has not
      measure_full_device(bar, {quick_pose("bar.off", {"-o", mesh}), {mesh}}, figures);
  }
  measure_full_device(bar, pose, figures);
  measure_full_device(bar, study, figures);
  measure_limits(bar, pose, figures);
  measure_limits(bar, study, figures);
  measure_every_write(figures);
  figures["full_refused"] /= figures["full_devices"];
  figures["full_said"] /= figures["full_devices"];
  figures["limits_refused"] /= figures["limits"];
  figures["writes_refused"] /= figures["writes"];
  // Standard output, where all else was written.
  fs::remove(bar.folder / ".out");
  fs::create_symlink("/dev/full", bar.folder / ".out");
  figures["full_terminal_exit_code"] = bar.run(pose.words).code;
}

/// Whether a report is none, the old one, or whole.
bool is_sound_report(const std::string& bytes) {
  return bytes.empty() || bytes == "old" || nlohmann::json::accept(bytes);
}

void measure_kills(Figures& figures) {
  const BarRuns bar;
  const Words words = quick_pose("bar.off", all_outputs);
  bar.run(words);  // the first one waits for the disk
  const ProgramResult whole = bar.run(words);
  std::map<std::string, std::string> result;
  for (const std::string& output : pose_outputs) result[output] = bar.bytes(output);
  Random random(13);
  for (const char* figure : {"broken", "killed", "written", "others"}) figures[figure] = 0;
  for (int kill = 0; kill < 100; ++kill) {
    for (const std::string& output : pose_outputs) {
      fs::remove(bar.folder / output);
      if (kill % 2 == 0) bar.folder.put(output, "old");
    }
    const Program program = bar.start(words);
    std::this_thread::sleep_for(
        std::chrono::duration<double>(random.uniform() * 1.1 * whole.seconds));
    program.signal(SIGKILL);
    figures["killed"] += program.wait().code == 128 + SIGKILL;
    for (const std::string& output : pose_outputs) {
      const std::string bytes = bar.bytes(output);
      const bool old = bytes.empty() || bytes == "old";
      const bool sound = output == "posed.json" ? is_sound_report(bytes) : bytes == result[output];
      figures["broken"] += !old && !sound;
      figures["written"] += !old;
    }
  }
  for (const auto& entry : fs::directory_iterator(bar.folder.path()))
    figures["others"] += entry.path().extension() == ".tmp";
  bar.run(words);
  figures["differs_at_last"] = bar.bytes("posed.ply") != result["posed.ply"] ||
                               bar.bytes("posed.png") != result["posed.png"];
}

/// A pose whose standard streams are closed: written, and told by the exit code alone. No output
/// may get the number of a stream.
void measure_closed_streams(const BarRuns& bar, Figures& figures) {
  const Words pose = quick_pose("bar.off", {"-o", "posed.ply", "--report", "posed.json"});
  bar.run(pose);
  const std::string whole = bar.bytes("posed.ply");
  for (const std::string closed : {"0<&-", ">&-", "2>&-", "0<&- >&- 2>&-"}) {
    for (const char* output : {"posed.ply", "posed.json"}) fs::remove(bar.folder / output);
    const Words words = {"-c", "exec \"$0\" \"$@\" " + closed, SUPPLE_PROGRAM};
    const int code = Program("/bin/sh", words + pose, bar.folder.path()).wait().code;
    const bool silent = closed.find(">&-") == 0 || closed.find(" >&-") != std::string::npos;
    figures["closed_off"] += code != (silent ? 3 : 0) || bar.bytes("posed.ply") != whole ||
                             !nlohmann::json::accept(bar.bytes("posed.json"));
  }
  const Words words = {"-c", "(\"$0\" \"$@\"; echo $? > code) | true", SUPPLE_PROGRAM};
  Program("/bin/sh", words + pose, bar.folder.path()).wait();
  figures["broken_pipe_exit_code"] = std::stoi(bar.bytes("code"));
}

/// A run that is stopped in its middle, with files that stood before.
void measure_signal(const BarRuns& bar, const Words& words, double after, int signal,
                    Figures& figures) {
  const long entries = bar.folder.entries();
  const Program program = bar.start(words);
  std::this_thread::sleep_for(std::chrono::duration<double>(after));
  program.signal(signal);
  const double sent = program.seconds();
  const ProgramResult result = program.wait();
  figures["seconds"] = std::max(figures["seconds"], result.seconds - sent);
  figures["other_exit_codes"] += result.code != 128 + signal;
  figures["left_behind"] += static_cast<double>(bar.folder.entries() - entries);
  figures["stopped"] += 1;
  if (result.code != 128 + signal || result.seconds - sent > 2)
    fmt::print(stderr, "K15: signal {} after {} s of {}: exit code {} after {} s more: {}\n",
               signal, after, fmt::join(words, " "), result.code, result.seconds - sent,
               result.err);
}

Words long_pose(const std::string& shape, const Words& more) {
  return Words{"pose",  shape,    "--fix",     "z<10%",      "--move", "z>90%",  "-o",
               "a.ply", "--turn", "0,0,1,170", "--substeps", "5000",   "--quiet"} +
         more;
}

void measure_signals(Figures& figures) {
  const BarRuns bar;
  write_mesh(make_torus(2, 0.7, 500, 200), bar.folder / "ball.ply");
  for (const char* figure : {"other_exit_codes", "left_behind", "closed_off"}) figures[figure] = 0;
  measure_closed_streams(bar, figures);
  // Busy with its set-up, with its steps, with one pose after the other.
  const Words runs[] = {
      long_pose("ball.ply", {"--particles", "3000"}),
      long_pose("bar.off", {"--particles", "500", "--no-inversion"}),
      {"study", "ball.ply", "--fix", "z<10%", "--move", "z>90%", "--by", "10%,0,0", "-o", "study"}};
  int turn = 0;
  ::mkfifo((bar.folder / "pipe.ply").c_str(), 0600);  // which nobody reads
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    measure_signal(bar, quick_pose("bar.off", {"-o", "pipe.ply"}), 1, signal, figures);
  for (const Words& words : runs)
    for (const double after : {0.1, 0.4, 1.0, 3.0})
      measure_signal(bar, words, after, ++turn % 2 == 0 ? SIGTERM : SIGINT, figures);
}

constexpr Case cases[] = {
    {"K12", measure_full_disks}, {"K13", measure_kills}, {"K15", measure_signals}};

}  // namespace

std::span<const Case> fault_cases() {
  return cases;
}

}  // namespace supple
