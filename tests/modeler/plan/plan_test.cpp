#include "modeler/plan/plan.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "io/scene/scene_reader.h"

namespace supple {
namespace {

/// "+ name: why" for what is active, "- name: why" for what is off, a line each.
std::string described(const Plan& plan) {
  std::string text;
  for (const Effect& effect : plan.effects)
    text += (effect.active ? "+ " : "- ") + effect.name + ": " + effect.why + "\n";
  return text;
}

std::string plan_of(const std::string& scene) {
  return described(make_plan(read_scene_text(scene, "scene.yaml", ".")));
}

TEST(Plan, NamesTheLineThatCausedEachEffect) {
  EXPECT_EQ(plan_of("shape: {mesh: bar.obj}\n"
                    "pose:\n"
                    "  handles:\n"
                    "    - fix: y<10%\n"
                    "      weight: 2\n"
                    "    - move: y>90%\n"
                    "      by: [10%, 0, 0]\n"
                    "      turn: {axis: [0, 0, 1], degrees: 30}\n"
                    "  weights: {volume: 0}\n"
                    "  surface: particle_gradients\n"),
            "+ quadrature: quadrature is auto, the default\n"
            "+ coupling: coupling is inside, the default\n"
            "- from: pose.from is not given: the way starts at rest\n"
            "- region: pose.region is not given: all may move\n"
            "- mirror: pose.mirror is not given: handles act where they are\n"
            "+ handles: scene.yaml:4:7: fix y<10% weight 2; "
            "scene.yaml:6:7: move y>90% by 10%,0,0 turn 0,0,1,30\n"
            "+ rigidity: weights.rigidity is 1, the default\n"
            "- volume: scene.yaml:3:3: weights.volume is 0\n"
            "- stiffness: pose.stiffness is not given: one for all parts\n"
            "+ substeps: scene.yaml:6:7: move y>90% by 10%,0,0 turn 0,0,1,30\n"
            "- hard_handles: hard_handles is false, the default\n"
            "- no_inversion: no_inversion is false, the default\n"
            "+ surface: scene.yaml:3:3: surface is particle_gradients\n"
            "+ normals: the surface moves; used where the mesh has normals\n"
            "- motion: the scene has no motion\n"
            "- simulate: the scene has no simulate\n");
}

TEST(Plan, StepsAreOffWhereNothingMoves) {
  const std::string held = "shape: {mesh: bar.obj}\npose: {handles: [{fix: y<10%}]}\n";
  EXPECT_NE(plan_of(held).find("- substeps: no handle moves\n"), std::string::npos);
  const std::string nowhere =
      "shape: {mesh: bar.obj}\npose: {handles: [{move: y<10%, by: [0, 0, 0]}]}\n";
  EXPECT_NE(plan_of(nowhere).find("- substeps: no handle moves\n"), std::string::npos);
  const std::string once =
      "shape: {mesh: bar.obj}\npose: {substeps: 1, handles: [{move: y<10%, by: [1, 0, 0]}]}\n";
  EXPECT_NE(plan_of(once).find("- substeps: scene.yaml:2:7: substeps is 1\n"), std::string::npos)
      << plan_of(once);
}

TEST(Plan, NamesThePartsThatAreStiffer) {
  const std::string scene =
      "shape: {mesh: bar.obj}\npose:\n  handles: [{fix: y<10%}]\n"
      "  stiffness: [{select: y:40%..60%, times: 5}, {select: group(arm), times: 0.5}]\n";
  EXPECT_NE(plan_of(scene).find("+ stiffness: scene.yaml:4:15: y:40%..60% is 5 times as stiff; "
                                "scene.yaml:4:47: group(arm) is 0.5 times as stiff\n"),
            std::string::npos)
      << plan_of(scene);
}

TEST(Plan, NamesFilesOfPoses) {
  const std::string scene =
      "shape: {mesh: bar.obj}\npose:\n  from: posed.ply\n"
      "  handles: [{move: y>1, to: targets.ply}, {to: nose.txt}]\n";
  for (const std::string line : {"+ from: scene.yaml:3:9: the way starts at posed.ply\n",
                                 "+ handles: scene.yaml:4:13: move y>1 to targets.ply; "
                                 "scene.yaml:4:43: move nose.txt\n",
                                 "+ substeps: scene.yaml:4:13"})
    EXPECT_NE(plan_of(scene).find(line), std::string::npos) << plan_of(scene);
}

TEST(Plan, NamesTheRegion) {
  const std::string scene =
      "shape: {mesh: bar.obj}\npose:\n  region: y>1\n  region_blend: 5%\n  handles: [{fix: y>2}]\n";
  EXPECT_NE(plan_of(scene).find("+ region: scene.yaml:3:11: nothing outside y>1 moves; the pose "
                                "sets in over 5%\n"),
            std::string::npos)
      << plan_of(scene);
}

TEST(Plan, NamesTheMirror) {
  const std::string scene =
      "shape: {mesh: bar.obj}\npose:\n  mirror: {normal: [1, 0, 0]}\n  handles: [{fix: y>2}]\n";
  EXPECT_NE(plan_of(scene).find("+ mirror: scene.yaml:3:11: handles act on both sides of the "
                                "plane across 1,0,0\n"),
            std::string::npos)
      << plan_of(scene);
}

TEST(Plan, WithoutHandlesNothingIsSolved) {
  Scene scene;
  scene.pose.emplace();
  for (const Effect& effect : make_plan(scene).effects)
    if (effect.name == "handles" || effect.name == "rigidity" || effect.name == "volume") {
      EXPECT_FALSE(effect.active) << effect.name;
      EXPECT_NE(effect.why.find("no handles"), std::string::npos) << effect.why;
    }
}

TEST(Plan, OfTheArmadilloScene) {
  const std::filesystem::path path = SUPPLE_SHARED_DATA "/scenes/pose_armadillo.yaml";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "skipped: no shared data";
  const std::string where = path.string();
  EXPECT_EQ(described(make_plan(read_scene(path))),
            "+ quadrature: quadrature is auto, the default\n"
            "+ coupling: coupling is inside, the default\n"
            "- from: pose.from is not given: the way starts at rest\n"
            "- region: pose.region is not given: all may move\n"
            "- mirror: pose.mirror is not given: handles act where they are\n"
            "+ handles: " +
                where + ":10:7: fix y<8%; " + where +
                ":11:7: move y>85% and x>25% and x<75% by 15%,-5%,0 turn 0,0,1,-35\n"
                "+ rigidity: weights.rigidity is 1, the default\n"
                "+ volume: weights.volume is 1, the default\n"
                "- stiffness: pose.stiffness is not given: one for all parts\n"
                "+ substeps: " +
                where +
                ":11:7: move y>85% and x>25% and x<75% by 15%,-5%,0 turn 0,0,1,-35\n"
                "- hard_handles: hard_handles is false, the default\n"
                "- no_inversion: no_inversion is false, the default\n"
                "+ surface: surface is field, the default\n"
                "+ normals: the surface moves; used where the mesh has normals\n"
                "- motion: the scene has no motion\n"
                "- simulate: the scene has no simulate\n");
}

}  // namespace
}  // namespace supple
