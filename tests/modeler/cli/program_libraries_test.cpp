#include <algorithm>

#include "tests/modeler/cli/program_fixture.h"
#include "tests/support/loaded_libraries.h"

namespace supple {
namespace {

using Libraries = std::vector<std::filesystem::path>;

/// Parts of the names of libraries that take long to load.
const std::vector<std::string> of_minimizers = {"supple_minimizers", "nlopt",  "glog",
                                                "cholmod",           "lapack", "blas"};
const std::vector<std::string> of_pictures = {"OSMesa", "LLVM"};

/// Runs the program with the loader told to say what it loads.
class LibrariesOfProgramTest : public ProgramTest {
 protected:
  Libraries loaded_by(std::vector<std::string> words) const {
    words.insert(words.begin(), {"LD_DEBUG=libs", SUPPLE_PROGRAM});
    const ProgramResult result = Program("/usr/bin/env", words, folder.path()).wait();
    EXPECT_EQ(result.code, 0) << result.err;
    return loaded_libraries(result.err);
  }

  Libraries loaded_by_pose(std::vector<std::string> words) const {
    words.insert(words.begin(), {"pose", "scene.yaml", "-o", "posed.obj"});
    return loaded_by(words);
  }

  /// With the minimisers' library replaced by a file that is none.
  ProgramResult pose_by_broken(const std::string& solver) const {
    folder.put("libsupple_minimizers.so", "not a library");
    return Program("/usr/bin/env",
                   {"LD_LIBRARY_PATH=.", SUPPLE_PROGRAM, "pose", "scene.yaml", "--set",
                    "pose.solver=" + solver, "-o", "posed.obj"},
                   folder.path())
        .wait();
  }
};

bool holds(const Libraries& libraries, const std::string& part) {
  return std::any_of(libraries.begin(), libraries.end(), [&](const std::filesystem::path& library) {
    return library.filename().string().find(part) != std::string::npos;
  });
}

void expect_none(const Libraries& libraries, const std::vector<std::string>& heavy) {
  EXPECT_TRUE(holds(libraries, "libsupple_solver.so"));
  for (const std::string& part : heavy) EXPECT_FALSE(holds(libraries, part)) << part;
}

void expect_all(const Libraries& libraries, const std::vector<std::string>& heavy) {
  for (const std::string& part : heavy) EXPECT_TRUE(holds(libraries, part)) << part;
}

TEST_F(LibrariesOfProgramTest, AreFewAtTheStart) {
  const Libraries libraries = loaded_by({"--version"});
  expect_none(libraries, of_minimizers);
  expect_none(libraries, of_pictures);
  EXPECT_LT(libraries.size(), 20u) << "34 took 9 ms to load, 12 take 2";
}

TEST_F(LibrariesOfProgramTest, AreThoseOfWhatAPoseAsksFor) {
  const Libraries plain = loaded_by_pose({});
  expect_none(plain, of_minimizers);
  expect_none(plain, of_pictures);
  for (const std::string solver : {"trust_region", "nlopt"}) {
    const Libraries libraries = loaded_by_pose({"--set", "pose.solver=" + solver});
    expect_all(libraries, of_minimizers);
    expect_none(libraries, of_pictures);
  }
  const Libraries drawn = loaded_by_pose({"--picture", "posed.png"});
  expect_none(drawn, of_minimizers);
  expect_all(drawn, of_pictures);
}

TEST_F(LibrariesOfProgramTest, ThatAreBrokenAreMissedWhereTheyAreNeeded) {
  EXPECT_EQ(pose_by_broken("lbfgs").code, 0);
  std::filesystem::remove(folder / "posed.obj");
  for (const std::string solver : {"trust_region", "nlopt"}) {
    const ProgramResult result = pose_by_broken(solver);
    EXPECT_EQ(result.code, 3);
    expect_contains(result.err, "the trust region and NLopt cannot be loaded: ");
    expect_contains(result.err, "libsupple_minimizers.so: ");
    expect_lacks(result.err, "bug");
    EXPECT_FALSE(exists("posed.obj"));
  }
}

}  // namespace
}  // namespace supple
