#pragma once

#include <string>
#include <vector>

#include "io/mesh/mesh_files.h"
#include "tests/support/run_program.h"
#include "tests/support/shapes.h"
#include "tests/support/temporary_folder.h"

namespace supple {

using Words = std::vector<std::string>;

inline Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// A folder with a bar of a few vertices, and runs of the program in it.
class BarRuns {
 public:
  BarRuns() {
    write_mesh(make_bar({1, 1, 4}, {2, 2, 8}), folder / "bar.off");
    for (const char* said : {".out", ".err"}) folder.put(said, "");
  }

  Program start(const Words& words, const Words& variables = {}) const {
    return {SUPPLE_PROGRAM, words, folder.path(), variables};
  }
  ProgramResult run(const Words& words, const Words& variables = {}) const {
    return start(words, variables).wait();
  }

  /// A file's bytes; empty where there is none.
  std::string bytes(std::string_view name) const { return bytes_of(folder / name); }

  TemporaryFolder folder;
};

/// A pose of `shape` that takes a moment.
inline Words quick_pose(const std::string& shape, const Words& more) {
  return Words{"pose",  shape,    "--particles", "60",   "--fix",
               "z<10%", "--move", "z>90%",       "--by", "10%,0,0"} +
         more;
}

/// The names of its three outputs, and the words that ask for them.
inline const Words pose_outputs = {"posed.ply", "posed.png", "posed.json"};
inline const Words all_outputs = {"-o",       "posed.ply",  "--picture", "posed.png",
                                  "--report", "posed.json", "--size",    "64x64"};

}  // namespace supple
