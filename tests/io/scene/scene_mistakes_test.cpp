#include <ctime>
#include <string>

#include <gtest/gtest.h>

#include "io/errors.h"
#include "io/scene/scene_reader.h"

namespace supple {
namespace {

/// What a mistake in a scene must be answered with.
struct Mistake {
  std::string text;
  std::string place;  ///< line:column
  std::string words;
};

std::string message_of(const std::string& text) {
  try {
    read_scene_text(text, "s.yaml", "");
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no error";
}

void expect_message(const Mistake& mistake) {
  const std::string message = message_of(mistake.text);
  EXPECT_EQ(message.rfind("s.yaml:" + mistake.place + ": ", 0), 0u)
      << mistake.place << " expected in: " << message << "\nfor:\n"
      << mistake.text;
  EXPECT_NE(message.find(mistake.words), std::string::npos)
      << "'" << mistake.words << "' expected in: " << message;
}

TEST(SceneMistakes, InKeysAndStructure) {
  const Mistake mistakes[] = {
      {"", "1:1", "the scene is empty"},
      {"# only a comment\n", "1:1", "the scene is empty"},
      {"abc", "1:1", "the scene is text, must be a map"},
      {"[1, 2]", "1:1", "the scene is a list, must be a map"},
      {"shap: {mesh: a}", "1:1", "unknown key 'shap'; allowed: shape, pose; did you mean 'shape'?"},
      {"shape:\n  mesh: a\n  partcles: 200", "3:3",
       "unknown key 'partcles' in shape; allowed: mesh, points, units, particles, spacing, size, "
       "basis, kernel, gradient, supports, support_scale, placement, quadrature, coupling; did you "
       "mean "
       "'particles'?"},
      {"shape: {mesh: a}\nshape: {mesh: b}", "2:1", "'shape' stands twice; it stands in line 1"},
      {"shape:\n  mesh: a\n  \"mesh\": b", "3:3", "'mesh' stands twice"},
      {"shape: a.off", "1:8", "shape is text, must be a map"},
      {"shape:mesh", "1:1", "a space is missing after ':'"},
      {"shape: [a]", "1:8", "shape is a list, must be a map"},
      {"shape:\n  mesh: [a]", "2:9", "shape.mesh is a list, must be text"},
      {"shape:\n  mesh:\n  size: 1", "2:3", "shape.mesh has no value, must be text"},
      {"shape: {mesh: ~}", "1:9", "shape.mesh has no value"},
      {"shape: {mesh: \"\"}", "1:15", "shape.mesh is empty"},
      {"shape: {size: 1}", "1:8", "shape.mesh is missing"},
      {"supple: 2\nshape: {mesh: a}", "1:9", "supple = 2: this program reads version 1"},
      {"supple: one\nshape: {mesh: a}", "1:9", "supple = 'one', must be a whole number"},
      {"motion: {}\n", "1:1", "motion is not available yet"},
      {"simulate:\n", "1:1", "simulate is not available yet"},
      {"shape:\n  points: a.xyz\n  mesh: a.off", "2:11", "shape.points: shape.mesh is given too"},
      {"shape: {box: {}}", "1:9", "shape.box is not available yet"},
      {"shape: {mesh: a, target_error: 1%}", "1:18", "shape.target_error is not available yet"},
  };
  for (const Mistake& mistake : mistakes) expect_message(mistake);
}

TEST(SceneMistakes, InYaml) {
  const Mistake mistakes[] = {
      {"shape: !!map {mesh: a}", "1:8", "tags ('tag:yaml.org,2002:map') are not allowed"},
      {"shape: {mesh: !!str a}", "1:15", "tags ('tag:yaml.org,2002:str') are not allowed"},
      {"shape: {mesh: ! a}", "1:15", "tags ('!') are not allowed"},
      {"shape: &s {mesh: a}", "1:8", "anchors (&s) are not allowed"},
      {"shape: {mesh: *a}", "1:15", "aliases (*name) are not allowed"},
      {"shape: {<<: {mesh: a}}", "1:9", "merges (<<) are not allowed"},
      {"shape: {mesh: a}\n---\nshape: {mesh: b}", "2:1", "a second document begins"},
      {"%YAML 1.2\n---\nshape: {mesh: a}", "1:1", "directives are not allowed"},
      {"shape:\n\tmesh: a", "2:1", "a tab as indentation; use spaces"},
      {"shape:\n  \tmesh: a", "2:3", "a tab as indentation; use spaces"},
      {std::string("shape: {mesh: a\0b}", 18), "1:16", "a control character (byte 0x00)"},
      {"\xFF\xFEs", "1:1", "the text is UTF-16; save it as UTF-8"},
      {"shape: {mesh: a", "1:1", "not valid YAML: end of map flow not found"},
      {"shape: \"a\nb", "2:2", "not valid YAML"},
      {"? [1, 2]\n: 3", "1:3", "a list or a map stands as key"},
      {"{: 3}", "1:2", "a key is missing"},
  };
  for (const Mistake& mistake : mistakes) expect_message(mistake);
}

TEST(SceneMistakes, InValues) {
  const std::string shape = "shape:\n  mesh: a\n  ";
  const Mistake mistakes[] = {
      {shape + "particles: 0", "3:14", "shape.particles = 0, must be >= 1 and <= 1000000"},
      {shape + "particles: 1000001", "3:14", "must be >= 1 and <= 1000000"},
      {shape + "particles: 99999999999999999999", "3:14", "must be >= 1 and <= 1000000"},
      {shape + "particles: 20.5", "3:14", "shape.particles = '20.5', must be a whole number"},
      {shape + "particles: many", "3:14", "must be a whole number"},
      {shape + "particles: \"20\"", "3:14", "is text in quotes, must be a whole number"},
      {shape + "particles: 5%", "3:14", "must be a whole number"},
      {shape + "particles:", "3:3", "shape.particles has no value, must be a whole number"},
      {shape + "size: 0", "3:9", "shape.size = 0, must be > 0"},
      {shape + "size: -5%", "3:9", "shape.size = -5%, must be > 0"},
      {shape + "size: 3 m", "3:9", "shape.size: '3 m' is not a length; allowed: a finite number"},
      {shape + "size: .inf", "3:9", "'.inf' is not a length"},
      {shape + "units: ft", "3:10", "shape.units = 'ft'; allowed: m, cm, mm, in"},
      {shape + "basis: Linear", "3:10",
       "'Linear'; allowed: constant, linear, quadratic; did you mean 'linear'?"},
      {"shape: {mesh: no}", "1:15", "shape.mesh = no is a boolean to YAML, must be text; quote it"},
      {"shape: {mesh: True}", "1:15", "must be text; quote it"},
      {"shape: {mesh: a, particles: 3, spacing: 1%}", "1:41", "shape.particles is given too"},
      {"pose: {handles: [{fix: y<1}]}", "1:7", "shape is missing"},
  };
  for (const Mistake& mistake : mistakes) expect_message(mistake);
}

TEST(SceneMistakes, InPoses) {
  const std::string pose = "shape: {mesh: a}\npose:\n  handles: [fix: y<1]\n  ";
  const Mistake mistakes[] = {
      {"shape: {mesh: a}\npose: {handles: {fix: y<1}}", "2:17",
       "pose.handles is a map, must be a "
       "list"},
      {"shape: {mesh: a}\npose:", "2:1", "pose has no value, must be a map"},
      {pose + "hard_handles: true\n  solver: trust_region", "4:17", "allowed: with lbfgs"},
      {pose + "hard_handles: yes", "4:17", "'yes'; allowed: true, false"},
      {pose + "hard_handles: True", "4:17", "'True'; allowed: true, false; did you mean 'true'?"},
      {pose + "hard_handles: \"true\"", "4:17", "allowed: true, false"},
      {pose + "solver: lbfg", "4:11", "allowed: lbfgs, trust_region, nlopt; did you mean 'lbfgs'?"},
      {pose + "region: y", "4:11", "incomplete: quote it"},
      {pose + "region_blend: 5%", "4:17", "pose.region is missing; allowed: only with it"},
      {pose + "region: y<1\n  region_blend: 0", "5:17", "pose.region_blend = 0, must be > 0"},
      {pose + "mirror: {at: [0, 0, 0]}", "4:11", "pose.mirror.normal is missing"},
      {pose + "mirror: {normal: [0, 0, 0]}", "4:20", "pose.mirror.normal = 0, must have a length"},
      {"shape: {mesh: a}\npose: {handles: [{move: y<1, to: b.ply, by: [1, 0, 0]}]}", "2:45",
       "pose.handles[0].by stands beside to"},
      {"shape: {mesh: a}\npose: {handles: [{fix: y<1, to: b.ply}]}", "2:33",
       "pose.handles[0].to stands beside fix"},
      {pose + "from: []", "4:9", "pose.from is a list, must be text"},
      {pose + "stiffness: [{select: y<1}]", "4:15", "pose.stiffness[0].times is missing"},
      {pose + "stiffness: [{times: 2}]", "4:15", "pose.stiffness[0].select is missing"},
      {pose + "stiffness: [{select: y<1, times: 0}]", "4:36", "must be > 0 and <= 1000000"},
      {pose + "stiffness: {select: y<1, times: 2}", "4:14",
       "pose.stiffness is a map, must be a list"},
      {pose + "weights: {rigidity: 0}", "4:23", "pose.weights.rigidity = 0, must be > 0"},
      {pose + "weights: {volume: -1}", "4:21", "pose.weights.volume = -1, must be >= 0"},
      {pose + "weights: {volume: .nan}", "4:21", "pose.weights.volume = '.nan', must be a finite"},
      {pose + "weights: {volume: 1e400}", "4:21", "'1e400', must be a finite number"},
      {pose + "weights: {volume: 1,5}", "4:23", "unknown key '5' in pose.weights"},
      {pose + "tolerance: 1", "4:14", "pose.tolerance = 1, must be >= 1e-15 and <= 0.1"},
  };
  for (const Mistake& mistake : mistakes) expect_message(mistake);
}

TEST(SceneMistakes, InHandles) {
  const std::string pose = "shape: {mesh: a}\npose:\n  handles:\n    - ";
  const Mistake mistakes[] = {
      {pose + "weight: 1", "4:7", "pose.handles[0]: fix or move is missing"},
      {pose + "{fix: y<1, move: y>2}", "4:24", "fix and move are both given"},
      {pose + "{fix: y<1, by: [1, 0, 0]}", "4:22", "pose.handles[0].by stands beside fix"},
      {pose + "{fix: y<1, turn: {degrees: 3}}", "4:24", "pose.handles[0].turn stands beside fix"},
      {pose + "{fix: y<1, scale: 2}", "4:25", "pose.handles[0].scale stands beside fix"},
      {pose + "fix: y<1\n    - {fix: y<1, weight: -1}", "5:26",
       "pose.handles[1].weight = -1, must be > 0"},
      {pose + "{move: y<1, by: [1, 0]}", "4:23", "pose.handles[0].by has 2 entries, must have 3"},
      {pose + "{move: y<1, by: 3}", "4:23", "pose.handles[0].by is text, must be three lengths"},
      {pose + "{move: y<1, by: [1, a, 0]}", "4:27", "pose.handles[0].by[1]: 'a' is not a length"},
      {pose + "{move: y<1, by: [1, 5%, 0]}", "4:23", "pose.handles[0].by: 1 stands beside a"},
      {pose + "{move: y<1, by: [1, , 0]}", "4:27", "pose.handles[0].by[1] has no value"},
      {pose + "{move: y<1, turn: {axis: [0, 0, 1]}}", "4:25", "turn.degrees is missing"},
      {pose + "{move: y<1, turn: {axis: [0, 0, 0], degrees: 1}}", "4:32", "turn.axis = 0, must"},
      {pose + "{move: y<1, turn: {axis: 1, degrees: 1}}", "4:32",
       "turn.axis is text, must be "
       "three numbers"},
      {pose + "{move: y<1, turn: {axis: [1, 0, 5%], degrees: 1}}", "4:39",
       "turn.axis[2] = '5%', must be a finite number"},
      {pose + "{move: y<1, turn: {degres: 1}}", "4:26", "did you mean 'degrees'?"},
      {pose + "{move: y<1, scale: 0}", "4:26", "pose.handles[0].scale = 0, must be > 0"},
      {pose + "{move: y<1, scale: [1, 1, -1]}", "4:33", "scale[2] = -1, must be > 0"},
  };
  for (const Mistake& mistake : mistakes) expect_message(mistake);
}

TEST(SceneMistakes, InSelections) {
  const std::string pose = "shape: {mesh: a}\npose:\n  handles:\n    - ";
  const Mistake mistakes[] = {
      {pose + "fix: y", "4:12", "in the selection 'y', column 1: incomplete: quote it"},
      {pose + "fix: y<1 && x<1", "4:12", "column 5: '&& x<1' is left over"},
      {pose + "fix: >85%", "4:14", "not valid YAML"},
      {pose + "fix: 5", "4:12", "column 1: unknown '5'; allowed: x, y, z, box"},
      {pose + "fix: [y<1, x<1]", "4:12", "pose.handles[0].fix is a list, must be a selection"},
      {pose + "fix:", "4:7", "pose.handles[0].fix has no value, must be a selection"},
      {pose + "{fix: box(0,0,0,1,1,1)}", "4:13",
       "'box(0' was cut off: inside { } and [ ] a comma "
       "ends text without quotes; quote it"},
      {pose + "{fix: y<1 or sphere(0,0,0,1)}", "4:13", "write the map form"},
      {pose + "{fix: {and: [y<1, nearest(0, 0, 0)]}}", "4:25", "'nearest(0' was cut off"},
      {pose + "{fix y<8%}", "4:8",
       "unknown key 'fix y<8%' in pose.handles[0]; allowed: fix, move, to, "
       "by, turn, scale, weight; it has no value: ': ' is missing"},
      {pose + "{fix:y<8%}", "4:8", "': ' is missing in it"},
      {pose + "fix:y<8%", "4:7", "a space is missing after ':'"},
      {pose + "fix: {boks: 1}", "4:13",
       "unknown key 'boks' in pose.handles[0].fix; allowed: box, "
       "sphere, nearest, vertices, group, and, or, not; did you "
       "mean 'box'?"},
      {pose + "fix: {group: a, vertices: b}", "4:12",
       "pose.handles[0].fix has 2 keys, must have "
       "one"},
      {pose + "fix: {}", "4:12", "has 0 keys, must have one"},
      {pose + "fix: {group: no}", "4:20", "fix.group = no is a boolean to YAML"},
      {pose + "fix: {and: []}", "4:18", "fix.and is empty"},
      {pose + "fix: {and: [y<1, z]}", "4:24", "in the selection 'z', column 1: incomplete"},
      {pose + "fix: {box: {min: [0, 0, 0]}}", "4:18", "fix.box.max is missing"},
      {pose + "fix: {box: {min: [0, 0, 0], max: [1, 1, -1]}}", "4:12",
       "along z the lower corner 0"},
      {pose + "fix: {box: {min: [0, 0, 0], mox: [1, 1, 1]}}", "4:35", "did you mean 'max'?"},
      {pose + "fix: {sphere: {center: [0, 0, 0], radius: 0}}", "4:12", "radius = 0, must be > 0"},
      {pose + "fix: {nearest: [0, 1, 5%]}", "4:22", "fix.nearest: 1 stands beside a percent"},
  };
  for (const Mistake& mistake : mistakes) expect_message(mistake);
}

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

TEST(SceneMistakes, HostileTextCostsLittle) {
  const std::pair<std::string, std::string> bombs[] = {
      {repeated("[", 1000) + repeated("]", 1000), "nested deeper than 64 levels"},
      {repeated("- ", 100'000), "nested deeper than 64 levels"},
      {repeated("[", 100'000), "its closing bracket is missing"},
      {repeated("{a: ", 100'000), "its closing bracket is missing"},
      {"shape: [" + repeated("1,", 200'000) + "]", "more than 100000 values"},
      {repeated("# long\n", 200'000), "the file has more than 1 MB"},
      {"a: &a [x, x, x, x, x, x, x, x, x]\nb: &b [*a, *a, *a, *a, *a, *a, *a, *a, *a]\n",
       "anchors (&a) are not allowed"},
  };
  for (const auto& [text, words] : bombs) {
    const std::clock_t start = std::clock();  // of the processor: the machine may be busy
    EXPECT_NE(message_of(text).find(words), std::string::npos) << message_of(text);
    EXPECT_LT(std::clock() - start, CLOCKS_PER_SEC) << words;
  }
}

/// A small generator of its own, so that a failure is the same everywhere.
struct Dice {
  unsigned long long state;
  unsigned roll(unsigned sides) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<unsigned>(state >> 33) % sides;
  }
};

std::string mutated(std::string text, Dice& dice) {
  static const std::string marks = "{}[]():,#&*!|>%@`\"'\n\t -?~<=.0e\\";
  for (unsigned edits = 1 + dice.roll(4); edits > 0; --edits) {
    const std::size_t place = dice.roll(static_cast<unsigned>(text.size()));
    const char mark = marks[dice.roll(static_cast<unsigned>(marks.size()))];
    switch (dice.roll(5)) {
      case 0:
        text[place] = mark;
        break;
      case 1:
        text[place] = static_cast<char>(dice.roll(256));
        break;
      case 2:
        text.insert(place, 1, mark);
        break;
      case 3:
        text.erase(place, 1 + dice.roll(8));
        break;
      default:
        text.insert(place, text.substr(dice.roll(unsigned(text.size())), 12));
        break;
    }
  }
  return text;
}

TEST(SceneMistakes, DamagedScenesAreReadOrRefused) {
  const std::string scene =
      "supple: 1\n"
      "shape: {mesh: a.off, particles: 200, size: 30%}  # a comment\n"
      "pose:\n"
      "  handles:\n"
      "    - fix: y<8% or (x:..10% and not group(arm))\n"
      "    - move: {and: [y>85%, {box: {min: [0, 0, 0], max: [1, 1, 1]}}]}\n"
      "      by: [15%, -5%, 0]\n"
      "      turn: {axis: [0, 0, 1], degrees: -35}\n"
      "  weights: {handles: 1.0e4, volume: 1}\n"
      "  solver: \"lbfgs\"\n";
  ASSERT_EQ(message_of(scene), "no error");
  Dice dice{2009};
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::string text = mutated(scene, dice);
    try {
      read_scene_text(text, "s.yaml", "");
    } catch (const UsageError& error) {
      ++refused;
      EXPECT_EQ(std::string(error.what()).rfind("s.yaml:", 0), 0u) << error.what();
    }
  }
  EXPECT_GT(refused, 1000);
  EXPECT_LT(refused, 2000);
}

}  // namespace
}  // namespace supple
