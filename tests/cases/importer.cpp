#include <chrono>
#include <filesystem>
#include <thread>

#include "tests/cases/cases.h"
#include "tests/support/fake_importer.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace supple {
namespace {

namespace fs = std::filesystem;

/// A copy of the program, beside which stands no importer yet.
fs::path copy_program(const TemporaryFolder& folder) {
  const fs::path program = SUPPLE_PROGRAM;
  fs::copy_file(program, folder / "supple");
  fs::create_directory_symlink(program.parent_path() / "lib", folder / "lib");
  return folder / "supple";
}

/// What the program does while its importer does what `lines` say.
ProgramResult run_with(std::string_view lines, const fs::path& program,
                       const TemporaryFolder& folder) {
  fake_importer(folder, lines);
  return Program(program, {"pose", "shape.fbx", "--fix", "x<1", "-o", "out.obj"}, folder.path())
      .wait();
}

void measure_importer(Figures& figures) {
  const TemporaryFolder folder;
  const fs::path program = copy_program(folder);
  folder.put("shape.fbx", "not read by any of these");
  folder.put("out.obj", "old");
  int died = 0, told = 0, traces = 0;
  const std::pair<const char*, const char*> deaths[] = {
      {"kill -SEGV $$", "Segmentation fault"},
      {"kill -ABRT $$", "Aborted"},
      {"kill -KILL $$", "Killed"},
      {"kill -XCPU $$", "CPU time"},
      {"exit 77", "code 77"},
      {"exec yes 'v 0 0 0'", "more than its memory"}};
  for (const auto& [lines, words] : deaths) {
    const ProgramResult result = run_with(lines, program, folder);
    died += result.code == 4;
    told += result.err.find(words) != std::string::npos;
    traces += bytes_of(folder / "out.obj") != "old";
  }
  const double count = static_cast<double>(std::size(deaths));
  figures["death_exit_4"] = died / count;
  figures["death_told"] = told / count;
  figures["left_behind"] = traces;
  figures["wrong_answer_exit_3"] = run_with("echo v 0 0 nan", program, folder).code == 3;
  figures["refusal_exit_3"] = run_with("echo no >&2; exit 3", program, folder).code == 3;

  // What a hang costs is a matter of its limit, which the library's own test shortens.
  fake_importer(folder, "exec sleep 10");
  const Program waiting(program, {"inspect", "shape.fbx"}, folder.path());
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  const auto start = std::chrono::steady_clock::now();
  waiting.signal(SIGTERM);
  figures["signal_while_it_hangs"] = waiting.wait().code;
  figures["signal_seconds"] =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

constexpr Case cases[] = {{"K19", measure_importer}};

}  // namespace

std::span<const Case> importer_cases() {
  return cases;
}

}  // namespace supple
