#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include <fmt/format.h>
#include <linux/capability.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "io/errors.h"
#include "io/mesh/mesh_files.h"
#include "io/output_file.h"
#include "io/scene/scene_reader.h"
#include "tests/cases/cases.h"
#include "tests/cases/posed_bar.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace supple {
namespace {

namespace fs = std::filesystem;

/// A mistake in a scene, its place, and words that the answer must hold.
struct Mistake {
  std::string text;
  int line, column;
  std::string words;
};

/// The shares of `mistakes` that are told with their place and with the words.
void measure_answers(const std::string& name, const std::vector<Mistake>& mistakes,
                     Figures& figures) {
  int placed = 0, named = 0;
  for (const Mistake& mistake : mistakes) {
    try {
      read_scene_text(mistake.text, "s.yaml", "");
    } catch (const UsageError& error) {
      const std::string message = error.what();
      const std::string place = fmt::format("s.yaml:{}:{}: ", mistake.line, mistake.column);
      if (message.rfind(place, 0) == 0) ++placed;
      if (message.find(mistake.words) != std::string::npos) ++named;
    }
  }
  figures[name + "_placed"] = placed / static_cast<double>(mistakes.size());
  figures[name + "_named"] = named / static_cast<double>(mistakes.size());
}

ProgramResult run_in(const TemporaryFolder& folder, std::vector<std::string> words) {
  return Program(SUPPLE_PROGRAM, std::move(words), folder.path()).wait();
}

/// Two points with normals, in the forms in which scanners and converters write them.
const std::pair<const char*, const char*> point_clouds[] = {
    {"faceless.ply",
     "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\n"
     "property double z\nproperty float nx\nproperty float ny\nproperty float nz\nend_header\n"
     "0.1 2 -3e-2 0 0 1\n4 5 6 0 1 0\n"},
    {"no_faces.ply",
     "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\n"
     "property double z\nproperty float nx\nproperty float ny\nproperty float nz\n"
     "element face 0\nproperty list uchar int vertex_indices\nend_header\n"
     "0.1 2 -3e-2 0 0 1\n4 5 6 0 1 0\n"},
    {"blanks.xyz", "  0.1\t2   -3e-2 0 0 1  \n\n   \n4 5 6 0 1 0\n\n"},
    {"commas.xyz", "0.1,2,-3e-2,0,0,1\n4,5,6,0,1,0\n"},
    {"commas_and_blanks.xyz", "0.1, 2, -3e-2, 0, 0, 1\r\n4, 5, 6, 0, 1, 0\r\n"},
    {"semicolons.xyz", "0.1;2;-3e-2;0;0;1\n4;5;6;0;1;0\n"},
    {"header.xyz", "x,y,z,nx,ny,nz\n0.1,2,-3e-2,0,0,1\n4,5,6,0,1,0\n"},
    {"comment.xyz", "# a scan\n//X Y Z Nx Ny Nz\n0.1 2 -3e-2 0 0 1\n4 5 6 0 1 0\n"},
    {"count.xyz", "2\n0.1 2 -3e-2 0 0 1\n4 5 6 0 1 0"}};

void measure_point_clouds(Figures& figures) {
  Points positions(2, 3), normals(2, 3);
  positions << 0.1, 2, -3e-2, 4, 5, 6;
  normals << 0, 0, 1, 0, 1, 0;
  const TemporaryFolder folder;
  int read = 0;
  for (const char* figure : {"positions", "normals", "faces", "exit_code"}) figures[figure] = 0;
  const auto grow = [&](const char* figure, double value) {
    figures[figure] = std::max(figures[figure], value);
  };
  for (const auto& [name, text] : point_clouds) {
    const Mesh cloud = read_mesh(folder.put(name, text));
    if (cloud.positions.rows() != 2 || cloud.normals.values.rows() != 2) continue;
    ++read;
    grow("positions", (cloud.positions - positions).cwiseAbs().maxCoeff());
    grow("normals", (cloud.normals.values - normals).cwiseAbs().maxCoeff());
    grow("faces", cloud.face_count());
    grow("exit_code", run_in(folder, {"render", name, "-o", "a.png", "--quiet"}).code);
  }
  figures["read"] = read / static_cast<double>(std::size(point_clouds));
}

void measure_wrong_keys(Figures& figures) {
  measure_answers("misspelt",
                  {{"shap: {mesh: a}", 1, 1, "did you mean 'shape'?"},
                   {"shape: {mesh: a}\npsoe: {}", 2, 1, "did you mean 'pose'?"},
                   {"shape:\n  mesh: a\n  partcles: 9", 3, 3, "did you mean 'particles'?"},
                   {"shape:\n  mesh: a\n  Basis: linear", 3, 3, "did you mean 'basis'?"},
                   {"shape: {mesh: a}\npose:\n  handels: []", 3, 3, "did you mean 'handles'?"},
                   {scene_text("    - fix: z<1%\n      wieght: 2"), 5, 7, "did you mean 'weight'?"},
                   {scene_text("    - move: z<1%\n      turn: {axis: [0, 0, 1], degres: 9}"), 5, 31,
                    "did you mean 'degrees'?"}},
                  figures);
  measure_answers("unknown",
                  {{"shape: {mesh: a}\nfrobnicate: 1", 2, 1, "allowed: shape, pose"},
                   {"shape: {mesh: a, 7: 1}", 1, 18, "allowed: mesh, "},
                   {scene_text("    - fix: z<1%\n      zzz: 2"), 5, 7, "allowed: fix, move, "}},
                  figures);
  measure_answers("wrong_type",
                  {{"shape: 4", 1, 8, "shape"},
                   {"shape:\n  mesh: [a]", 2, 9, "mesh"},
                   {"shape: {mesh: a, particles: many}", 1, 29, "particles"},
                   {"shape: {mesh: a, particles: 2.5}", 1, 29, "particles"},
                   {"shape: {mesh: a}\npose:\n  handles: 3", 3, 12, "handles"},
                   {"shape: {mesh: a}\npose:\n  hard_handles: 1", 3, 17, "hard_handles"},
                   {scene_text("    - move: z<1%\n      by: 3"), 5, 11, "by"},
                   {scene_text("    - fix: z<1%\n      weight: [1]"), 5, 15, "weight"}},
                  figures);
  const TemporaryFolder folder;
  folder.put("s.yaml", "shape: {mesh: a, partcles: 9}\n");
  figures["exit_code"] = run_in(folder, {"plan", "s.yaml"}).code;
}

/// The superuser may write everywhere; this process and the programs it starts no longer.
void obey_permissions() {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct capabilities[2];
  ::syscall(SYS_capget, &header, capabilities);
  ::prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE);
  capabilities[0].effective &= ~(1u << CAP_DAC_OVERRIDE);
  ::syscall(SYS_capset, &header, capabilities);
}

/// A pose that takes far longer than a second, behind which outputs are to be named.
std::vector<std::string> long_pose(const std::vector<std::string>& outputs) {
  std::vector<std::string> words = {"pose",    "bar.obj",    "--particles", "3000",   "--fix",
                                    "z<10%",   "--move",     "z>90%",       "--turn", "0,0,1,170",
                                    "--quiet", "--substeps", "500"};
  words.insert(words.end(), outputs.begin(), outputs.end());
  return words;
}

/// The longest time and the worst exit code with the mesh, the report, the picture at `path`.
void measure_bad_output(const std::string& name, const std::string& path,
                        const TemporaryFolder& folder, Figures& figures) {
  double seconds = 0;
  int code = 3;
  for (const auto& [option, file] :
       {std::pair{"-o", "/a.obj"}, {"--report", "/a.json"}, {"--picture", "/a.png"}}) {
    std::vector<std::string> outputs = {option, path + file};
    if (option != std::string_view("-o")) outputs.insert(outputs.end(), {"-o", "good.obj"});
    const auto start = std::chrono::steady_clock::now();
    const int exit_code = run_in(folder, long_pose(outputs)).code;
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    seconds = std::max(seconds, taken.count());
    if (exit_code != 3) code = exit_code;
  }
  figures[name + "_seconds"] = seconds;
  figures[name + "_exit_code"] = code;
}

bool found_by_check_writable(const fs::path& path) {
  try {
    check_writable(path);
  } catch (const OutputError&) {
    return true;
  }
  return false;
}

void measure_bad_outputs(Figures& figures) {
  obey_permissions();
  const TemporaryFolder folder;
  write_mesh(case_bar(), folder / "bar.obj");
  fs::create_directory(folder / "read_only");
  fs::permissions(folder / "read_only", fs::perms::owner_read | fs::perms::owner_exec);
  for (const char* said : {".out", ".err"}) folder.put(said, "");
  const long entries = folder.entries();
  const std::pair<std::string, std::string> paths[] = {
      {"missing", "no/such"}, {"read_only", "read_only"}, {"is_file", "bar.obj"}};
  int found = 0;
  for (const auto& [name, path] : paths) {
    measure_bad_output(name, path, folder, figures);
    if (found_by_check_writable(folder / (path + "/a.obj"))) ++found;
  }
  figures["found_by_check_writable"] = found / static_cast<double>(std::size(paths));
  figures["left_behind"] = static_cast<double>(folder.entries() - entries) +
                           static_cast<double>(!fs::is_empty(folder / "read_only"));

  const Program control(SUPPLE_PROGRAM, long_pose({"-o", "good.obj"}), folder.path());
  std::this_thread::sleep_for(std::chrono::seconds(1));
  control.signal(SIGTERM);
  figures["control_exit_code"] = control.wait().code;
}

constexpr Case cases[] = {
    {"K6", measure_point_clouds}, {"K9", measure_wrong_keys}, {"K11", measure_bad_outputs}};

}  // namespace

std::span<const Case> input_cases() {
  return cases;
}

}  // namespace supple
