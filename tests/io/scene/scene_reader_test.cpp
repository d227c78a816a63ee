#include "io/scene/scene_reader.h"

#include <fstream>

#include <gtest/gtest.h>

#include "tests/support/selection_trees.h"

namespace supple {
namespace {

const std::filesystem::path scenes = SUPPLE_SHARED_DATA "/scenes";

const std::string head =
    "shape: {mesh: a.off}\n"
    "pose:\n"
    "  handles:\n";

Scene read(const std::string& text, const SceneOverrides& overrides = {}) {
  return read_scene_text(text, "s.yaml", "folder", overrides);
}

std::string message_of(const std::string& text, const SceneOverrides& overrides = {}) {
  try {
    read(text, overrides);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no error";
}

std::string refusal_of(const std::string& file) {
  try {
    read_scene(scenes / file);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no error";
}

TEST(SceneReader, ReadsTheArmadilloPose) {
  if (!std::filesystem::exists(scenes)) GTEST_SKIP() << "skipped: no shared data";
  const Scene scene = read_scene(scenes / "pose_armadillo.yaml");
  EXPECT_EQ(scene.folder, scenes);
  EXPECT_EQ(scene.shape.mesh, "../data/armadillo_26k.off");
  EXPECT_EQ(scene.shape.particles, 200);
  EXPECT_FALSE(scene.shape.spacing || scene.shape.size);
  EXPECT_EQ(scene.shape.basis, BasisOrder::linear);
  EXPECT_EQ(scene.shape.quadrature, QuadratureKind::automatic);
  ASSERT_TRUE(scene.pose);
  const PoseSpec& pose = *scene.pose;
  ASSERT_EQ(pose.handles.size(), 2u);
  EXPECT_EQ(test::show(*pose.handles[0].fix), "(y < 8%)");
  EXPECT_EQ(pose.handles[0].place.line, 10);
  const HandleSpec& head_handle = pose.handles[1];
  EXPECT_EQ(test::show(*head_handle.move), "(and (y > 85%) (x > 25%) (x < 75%))");
  EXPECT_EQ(head_handle.move->place.line, 11);
  EXPECT_EQ(head_handle.move->place.column, 13);
  EXPECT_EQ(test::show(head_handle.by), "15% -5% 0");
  ASSERT_TRUE(head_handle.turn);
  EXPECT_EQ(head_handle.turn->axis, Vec3::UnitZ());
  EXPECT_EQ(head_handle.turn->degrees, -35);
  EXPECT_FALSE(head_handle.turn->about);
  EXPECT_EQ(head_handle.weight, 1);
  EXPECT_EQ(pose.weights.handles, 1e4);
  EXPECT_EQ(pose.weights.rigidity, 1);
  EXPECT_EQ(pose.weights.volume, 1);
  EXPECT_EQ(pose.solver, MinimizerKind::lbfgs);
  EXPECT_FALSE(pose.hard_handles);
}

TEST(SceneReader, TakesThePublishedPoseOfAScan) {
  if (!std::filesystem::exists(scenes)) GTEST_SKIP() << "skipped: no shared data";
  const Scene scene = read_scene(scenes / "pose_scan.yaml");
  EXPECT_EQ(scene.shape.points, "../data/scan_kitten_5k.xyz");
  EXPECT_EQ(scene.shape.file(), scene.shape.points);
  EXPECT_TRUE(scene.shape.mesh.empty());
  EXPECT_EQ(scene.pose->handles.size(), 3u);
}

TEST(SceneReader, SaysWhatIsNotAvailableYet) {
  if (!std::filesystem::exists(scenes)) GTEST_SKIP() << "skipped: no shared data";
  for (const std::string file :
       {"motion_bar_under_ball.yaml", "motion_cactus_keys.yaml", "motion_spin.yaml"})
    EXPECT_NE(refusal_of(file).find(": motion is not available yet"), std::string::npos) << file;
  for (const std::string file : {"cantilever.yaml", "clay_bunny.yaml", "dam_break.yaml",
                                 "jelly_on_stairs.yaml", "modal_femur.yaml", "pool.yaml"})
    EXPECT_NE(refusal_of(file).find(": simulate is not available yet"), std::string::npos) << file;
}

TEST(SceneReader, ReadsEveryKey) {
  const Scene scene = read(
      "supple: 1\n"
      "shape: {mesh: \"yes\", units: mm, spacing: 2%, size: 0.3, basis: quadratic,\n"
      "        kernel: wendland, quadrature: particles}\n"
      "pose:\n"
      "  handles:\n"
      "    - {fix: y:..10%, weight: 1e-2}\n"
      "    - move: y:85%..\n"
      "      turn: {axis: [1, 2, 3], degrees: 720, about: [0%, 10%, 0]}\n"
      "      scale: 2\n"
      "    - {move: x>1, scale: [1, 2, +.5]}\n"
      "  weights: {volume: 0}\n"
      "  solver: trust_region\n"
      "  max_iterations: 7\n"
      "  most_seconds: 2.5\n"
      "  tolerance: 1.0e-8\n"
      "  substeps: 3\n"
      "  surface: particle_gradients\n");
  EXPECT_EQ(scene.folder, "folder");
  EXPECT_EQ(scene.shape.mesh, "yes");
  EXPECT_EQ(scene.shape.units, FileUnit::millimetre);
  EXPECT_EQ(to_string(*scene.shape.spacing), "2%");
  EXPECT_EQ(to_string(*scene.shape.size), "0.3");
  EXPECT_EQ(scene.shape.basis, BasisOrder::quadratic);
  EXPECT_EQ(scene.shape.kernel, KernelKind::wendland);
  EXPECT_EQ(scene.shape.quadrature, QuadratureKind::particles);
  ASSERT_EQ(scene.pose->handles.size(), 3u);
  EXPECT_EQ(scene.pose->handles[0].weight, 0.01);
  EXPECT_EQ(test::show(*scene.pose->handles[1].move), "(y > 85%)");
  EXPECT_EQ(scene.pose->handles[1].scale, Vec3(2, 2, 2));
  EXPECT_EQ(scene.pose->handles[1].turn->axis, Vec3(1, 2, 3));
  EXPECT_EQ(scene.pose->handles[1].turn->degrees, 720);
  EXPECT_EQ(test::show(*scene.pose->handles[1].turn->about), "0% 10% 0");
  EXPECT_EQ(scene.pose->handles[2].scale, Vec3(1, 2, 0.5));
  EXPECT_EQ(scene.pose->weights.volume, 0);
  EXPECT_EQ(scene.pose->weights.handles, 1e4);
  EXPECT_EQ(scene.pose->solver, MinimizerKind::trust_region);
  EXPECT_EQ(scene.pose->max_iterations, 7);
  EXPECT_EQ(scene.pose->most_seconds, 2.5);
  EXPECT_EQ(scene.pose->tolerance, 1e-8);
  EXPECT_EQ(scene.pose->substeps, 3);
  EXPECT_EQ(scene.pose->surface, SurfaceKind::particle_gradients);
}

TEST(SceneReader, ReadsWhatStandsBesideHandles) {
  const Scene scene = read_scene_text(
      "shape: {mesh: a.ply}\n"
      "pose:\n"
      "  from: posed.ply\n"
      "  stiffness: [{select: y<10%, times: 5}, {select: {group: arm}, times: 0.5}]\n"
      "  region: y>30% and not x<1\n"
      "  region_blend: 5%\n"
      "  mirror: {normal: [1, 0, 2], at: [10%, 0, 0]}\n"
      "  handles: [{move: x>1, to: there.ply}, {to: nose.txt}]\n",
      "s.yaml", "folder");
  const PoseSpec& pose = *scene.pose;
  EXPECT_EQ(pose.from->path, "posed.ply");
  EXPECT_EQ(to_string(pose.from->place), "s.yaml:3:9");
  ASSERT_EQ(pose.stiffness.size(), 2u);
  EXPECT_EQ(pose.stiffness[0].times, 5);
  EXPECT_EQ(test::show(pose.stiffness[1].select), "(group 'arm')");
  EXPECT_EQ(test::show(*pose.region), "(and (y > 30%) (not (x < 1)))");
  EXPECT_EQ(to_string(*pose.region_blend), "5%");
  EXPECT_EQ(pose.mirror->normal, Vec3(1, 0, 2));
  EXPECT_EQ(test::show(*pose.mirror->at), "10% 0 0");
  EXPECT_EQ(pose.handles[0].to->path, "there.ply");
  EXPECT_EQ(pose.handles[1].part(), "nose.txt");
  EXPECT_FALSE(pose.handles[1].move);
}

TEST(SceneReader, ReadsSelectionsAsMaps) {
  const std::pair<std::string, std::string> forms[] = {
      {"{box: {min: [0, 0, 0], max: [1, 2, 3]}}", "(box 0 0 0 | 1 2 3)"},
      {"{sphere: {center: [10%, 0, 0], radius: 5%}}", "(sphere 10% 0 0 | 5%)"},
      {"{nearest: [1, 2, 3]}", "(nearest 1 2 3)"},
      {"{vertices: \"a, (b).txt\"}", "(vertices 'a, (b).txt')"},
      {"{group: left arm}", "(group 'left arm')"},
      {"{and: [y<1, {not: x<2}]}", "(and (y < 1) (not (x < 2)))"},
      {"{or: [y<1 and z<1, \"sphere(0,0,0,1)\"]}", "(or (and (y < 1) (z < 1)) (sphere 0 0 0 | 1))"},
      {"{or: [y<1]}", "(y < 1)"},
  };
  for (const auto& [text, tree] : forms) {
    const Scene scene = read(head + "    - fix: " + text + "\n");
    EXPECT_EQ(test::show(*scene.pose->handles[0].fix), tree) << text;
  }
}

TEST(SceneReader, MapsAndTextsMeanTheSame) {
  const Scene scene = read(head +
                           "    - fix: {and: [{box: {min: [0, 0, 0], max: [1, 1, 5]}}, "
                           "{not: {group: arm}}, y:..10%]}\n");
  const Selection& map = *scene.pose->handles[0].fix;
  EXPECT_EQ(test::show(parse_selection(map.text, {})), test::show(map));
}

TEST(SceneReader, AcceptsTextFilesAsTheyCome) {
  const std::string body = "shape:\r\n  mesh: a.off   # a comment\r\n\r\n  particles: 20\r\n";
  EXPECT_EQ(read("\xEF\xBB\xBF" + body).shape.particles, 20);
  EXPECT_EQ(read("---\n" + body + "...\n").shape.mesh, "a.off");
  EXPECT_EQ(read("shape: {mesh: 测试 模型.off}").shape.mesh, "测试 模型.off");
  EXPECT_EQ(read("shape: {mesh: \"\\u6d4b.off\"}").shape.mesh, "测.off");
  EXPECT_EQ(read("shape: {mesh: a\xFF.off}").shape.mesh, "a\xFF.off");
}

TEST(SceneOverrides, ReplaceAndAddValues) {
  const std::string text = head + "    - fix: y<8%\n    - {move: y>90%, by: [1, 0, 0]}\n";
  const Scene scene = read(text, {{"pose.handles[1].weight", "2"},
                                  {"shape.particles", "100"},
                                  {"shape.mesh", "b.off"},
                                  {"pose.weights.volume", "10"},
                                  {"pose.handles[0].fix", "box(0,0,0,1,1,1)"},
                                  {"pose.handles[1].by[2]", "7"}});
  EXPECT_EQ(scene.pose->handles[1].weight, 2);
  EXPECT_EQ(scene.shape.particles, 100);
  EXPECT_EQ(scene.shape.mesh, "b.off");
  EXPECT_EQ(scene.pose->weights.volume, 10);
  EXPECT_EQ(test::show(*scene.pose->handles[0].fix), "(box 0 0 0 | 1 1 1)");
  EXPECT_EQ(test::show(scene.pose->handles[1].by), "1 0 7");
  EXPECT_EQ(scene.pose->handles[0].fix->place.file, "--set pose.handles[0].fix=box(0,0,0,1,1,1)");
}

TEST(SceneOverrides, NameTheirOptionInMistakes) {
  const std::string text = head + "    - fix: y<8%\n";
  const auto expect = [&](const std::string& path, const std::string& value,
                          const std::string& words) {
    const std::string message = message_of(text, {{path, value}});
    EXPECT_EQ(message.rfind("--set " + path + "=" + value, 0), 0u) << message;
    EXPECT_NE(message.find(words), std::string::npos) << message;
  };
  expect("pose.handles[0].weight", "-1", ": pose.handles[0].weight = -1, must be > 0");
  expect("shape.partcles", "9", "unknown key 'partcles' in shape; allowed: mesh");
  expect("shape.partcles", "9", "did you mean 'particles'?");
  expect("pose.handles[3].weight", "1", "[3] is beyond the list's end; it has 1 entries");
  expect("pose.handles[0].fix.box", "1", "what holds 'box' is not a map");
  expect("shape[0]", "1", "what holds [0] is not a list");
  expect("shape.mesh", "", "the value is missing");
  expect("shape.size", "{a: &b 1}", "anchors (&b) are not allowed");
  for (const std::string path : {"", ".", "shape.", "a..b", "[0]", "a[", "a[x]", "a[1", "a[1]b",
                                 "a[-1]", "a[99999999999999999999]"})
    expect(path, "1", "the path is wrong; allowed: keys");
}

TEST(SceneReader, TellsWhichFilesCannotBeRead) {
  const auto folder = std::filesystem::temp_directory_path() / "supple_scene_reader_test";
  std::filesystem::create_directories(folder);
  EXPECT_THROW(read_scene(folder / "missing.yaml"), InputError);
  EXPECT_THROW(read_scene(folder), InputError);
  std::ofstream(folder / "empty.yaml");
  EXPECT_THROW(read_scene(folder / "empty.yaml"), UsageError);
  std::ofstream(folder / "a scene.yaml") << "shape: {mesh: a.off}\n";
  const Scene scene = read_scene(folder / "a scene.yaml");
  EXPECT_EQ(scene.shape.mesh, "a.off");
  EXPECT_EQ(scene.folder, folder);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace supple
