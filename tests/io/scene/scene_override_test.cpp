// A scene that was read can be changed as --set would have changed it, and is told apart by its
// values alone.

#include <gtest/gtest.h>

#include "io/scene/scene_hash.h"
#include "io/scene/scene_reader.h"
#include "tests/support/temporary_folder.h"

namespace supple {
namespace {

const std::string text =
    "shape: {mesh: a.off, particles: 60}\n"
    "pose:\n"
    "  tolerance: 1e-4\n"
    "  handles:\n"
    "    - fix: y<10%\n"
    "    - {move: y>90%, by: [10%, 0, 0]}\n";

Scene read(const std::string& scene, const SceneOverrides& overrides = {}) {
  return read_scene_text(scene, "s.yaml", "folder", overrides);
}

TEST(Overridden, IsTheSameAsReadingWithTheOverrides) {
  for (const SceneOverrides& overrides :
       {SceneOverrides{{"shape.particles", "120"}}, SceneOverrides{{"pose.tolerance", "1e-8"}},
        SceneOverrides{{"pose.solver", "nlopt"}, {"pose.weights.volume", "10"}},
        SceneOverrides{{"shape.basis", "quadratic"}}, SceneOverrides{}})
    EXPECT_EQ(scene_hash(overridden(read(text), overrides)), scene_hash(read(text, overrides)));
}

TEST(Overridden, KeepsEverythingElse) {
  const Scene scene = overridden(read(text), {{"pose.solver", "nlopt"}});
  EXPECT_EQ(scene.pose->solver, MinimizerKind::nlopt);
  EXPECT_EQ(scene.pose->tolerance, 1e-4);
  EXPECT_EQ(scene.pose->handles.size(), 2u);
  EXPECT_EQ(scene.shape.particles, 60);
  EXPECT_EQ(scene.folder, "folder");
}

TEST(Overridden, ChecksTheRulesAgain) {
  const Scene exact = read(text, {{"pose.hard_handles", "true"}});
  EXPECT_NE(message_of<UsageError>([&] {
              overridden(exact, {{"pose.solver", "trust_region"}});
            }).find("--set pose.solver=trust_region: pose.hard_handles"),
            std::string::npos);
  EXPECT_NE(message_of<UsageError>([&] {
              overridden(read(text), {{"shape.partcles", "3"}});
            }).find("did you mean 'particles'?"),
            std::string::npos);
}

TEST(SceneHash, DependsOnValuesAndNotOnHowTheyAreWritten) {
  const std::string reordered =
      "# the same\n"
      "pose:\n"
      "  handles:\n"
      "    - {fix: y<10%}\n"
      "    - {by: [10%, 0, 0], move: y>90%}\n"
      "  tolerance: 0.0001\n"
      "shape: {particles: 60, mesh: a.off}\n";
  EXPECT_EQ(scene_hash(read(text)), scene_hash(read(reordered)));
}

TEST(SceneHash, TellsEveryValueApart) {
  const std::uint64_t before = scene_hash(read(text));
  for (const SceneOverrides& overrides :
       {SceneOverrides{{"shape.particles", "61"}}, SceneOverrides{{"shape.units", "mm"}},
        SceneOverrides{{"pose.handles[1].by", "[11%, 0, 0]"}},
        SceneOverrides{{"pose.handles[1].turn", "{axis: [0, 0, 1], degrees: 3}"}},
        SceneOverrides{{"pose.handles[0].fix", "y<11%"}}, SceneOverrides{{"pose.substeps", "3"}}})
    EXPECT_NE(scene_hash(read(text, overrides)), before) << overrides.front().first;
}

}  // namespace
}  // namespace supple
