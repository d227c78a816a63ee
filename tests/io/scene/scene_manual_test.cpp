#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "io/scene/scene_reader.h"

namespace supple {
namespace {

TEST(SceneManual, IsTheOneInTheRepository) {
  std::ifstream file(SUPPLE_SOURCE_DIR "/docs/scene.md", std::ios::binary);
  const std::string stored{std::istreambuf_iterator<char>(file), {}};
  if (stored == scene_manual()) return;
  const auto folder = std::filesystem::temp_directory_path() / "supple_scene_manual_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "scene.md", std::ios::binary) << scene_manual();
  FAIL() << "docs/scene.md is out of date; copy " << (folder / "scene.md") << " there";
}

TEST(SceneManual, DocumentsEveryKeyWithItsBoundsAndDefault) {
  const std::string manual = scene_manual();
  for (const std::string row :
       {"| `tolerance` | number ≥ 1e-15, ≤ 0.1 |  | `1e-06` |",
        "| `solver` | `lbfgs`, `trust_region`, `nlopt` |  | `lbfgs` |",
        "| `handles` | list, an entry each: map, see below |",
        "| `by` | list of 3 lengths | length | `[0, 0, 0]` |", "## `pose.handles[].turn`"})
    EXPECT_NE(manual.find(row), std::string::npos) << row;
}

}  // namespace
}  // namespace supple
