#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "io/mesh/mesh_files.h"
#include "tests/support/loaded_libraries.h"
#include "tests/support/run_program.h"
#include "tests/support/shapes.h"

namespace supple {
namespace {

/// Poses a bar with the loader told to `tune` the processor, and to say what it loads.
std::string load_messages(const TemporaryFolder& folder, const std::string& tune,
                          const std::string& output, const std::string& solver = "lbfgs") {
  const std::vector<std::string> words = {"GLIBC_TUNABLES=" + tune,
                                          "LD_DEBUG=libs",
                                          SUPPLE_PROGRAM,
                                          "pose",
                                          "bar.obj",
                                          "--fix",
                                          "y<10%",
                                          "--move",
                                          "y>90%",
                                          "--by",
                                          "10%,0,0",
                                          "--particles",
                                          "60",
                                          "--set",
                                          "pose.solver=" + solver,
                                          "-o",
                                          output};
  const ProgramResult result = Program("/usr/bin/env", words, folder.path()).wait();
  EXPECT_EQ(result.code, 0);
  return result.err;
}

/// The folder that a library was loaded from; empty where it was not.
std::filesystem::path folder_of(const std::string& library, const std::string& messages) {
  for (const std::filesystem::path& path : loaded_libraries(messages))
    if (path.filename() == library) return path.parent_path();
  return {};
}

constexpr char without_avx2[] = "glibc.cpu.hwcaps=-AVX2_Usable,-AVX2";

TEST(BothBuilds, OldProcessorsGetTheBaselineSolverAndTheSamePose) {
  const std::filesystem::path library = std::filesystem::path(SUPPLE_PROGRAM).parent_path() / "lib";
  if (!std::filesystem::exists(library / "glibc-hwcaps"))
    GTEST_SKIP() << "skipped: this preset builds the solver once";
  TemporaryFolder folder;
  write_mesh(make_bar({0.2, 1, 0.2}, {4, 20, 4}), folder / "bar.obj");
  load_messages(folder, "", "usual.obj");
  const std::string messages = load_messages(folder, without_avx2, "baseline.obj");
  EXPECT_NE(messages.find("calling init: " + (library / "libsupple_solver.so").string()),
            std::string::npos);
  EXPECT_EQ(messages.find("calling init: " + (library / "glibc-hwcaps").string()),
            std::string::npos);
  const Points usual = read_mesh(folder / "usual.obj").positions;
  const Points baseline = read_mesh(folder / "baseline.obj").positions;
  EXPECT_LT((usual - baseline).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(BothBuilds, LoadTheMinimisersThatWereBuiltWithThem) {
  TemporaryFolder folder;
  write_mesh(make_bar({0.2, 1, 0.2}, {4, 20, 4}), folder / "bar.obj");
  for (const std::string tune : {"", without_avx2}) {
    const std::string messages = load_messages(folder, tune, "posed.obj", "trust_region");
    const std::filesystem::path solver = folder_of("libsupple_solver.so", messages);
    EXPECT_FALSE(solver.empty());
    EXPECT_EQ(folder_of("libsupple_minimizers.so", messages), solver);
  }
}

}  // namespace
}  // namespace supple
