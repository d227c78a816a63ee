#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "io/mesh/mesh_files.h"
#include "tests/support/run_program.h"
#include "tests/support/shapes.h"

namespace supple {
namespace {

/// Poses a bar with the loader told to `tune` the processor, and to say what it loads.
std::string load_messages(const TemporaryFolder& folder, const std::string& tune,
                          const std::string& output) {
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
                                          "-o",
                                          output};
  const ProgramResult result = Program("/usr/bin/env", words, folder.path()).wait();
  EXPECT_EQ(result.code, 0);
  return result.err;
}

TEST(BothBuilds, OldProcessorsGetTheBaselineSolverAndTheSamePose) {
  const std::filesystem::path library = std::filesystem::path(SUPPLE_PROGRAM).parent_path() / "lib";
  if (!std::filesystem::exists(library / "glibc-hwcaps"))
    GTEST_SKIP() << "skipped: this preset builds the solver once";
  TemporaryFolder folder;
  write_mesh(make_bar({0.2, 1, 0.2}, {4, 20, 4}), folder / "bar.obj");
  load_messages(folder, "", "usual.obj");
  const std::string messages =
      load_messages(folder, "glibc.cpu.hwcaps=-AVX2_Usable,-AVX2", "baseline.obj");
  EXPECT_NE(messages.find("calling init: " + (library / "libsupple_solver.so").string()),
            std::string::npos);
  EXPECT_EQ(messages.find("calling init: " + (library / "glibc-hwcaps").string()),
            std::string::npos);
  const Points usual = read_mesh(folder / "usual.obj").positions;
  const Points baseline = read_mesh(folder / "baseline.obj").positions;
  EXPECT_LT((usual - baseline).cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace supple
