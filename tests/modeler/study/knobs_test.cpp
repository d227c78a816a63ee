#include "modeler/study/knobs.h"

#include <gtest/gtest.h>

#include "io/errors.h"
#include "io/scene/scene_reader.h"
#include "tests/support/temporary_folder.h"

namespace supple {
namespace {

Scene scene_of(const std::string& shape, const std::string& pose) {
  return read_scene_text("shape: {mesh: a.obj" + shape + "}\npose: {" + pose + "}\n", "scene.yaml",
                         {});
}

Knob knob_of(const Scene& scene, const std::string& name, int levels) {
  for (const Knob& knob : collect_knobs(scene, levels))
    if (knob.name == name) return knob;
  throw std::runtime_error("no knob " + name);
}

using Texts = std::vector<std::string>;

TEST(CollectKnobs, FindsThoseThatThePoseDescribes) {
  Texts keys;
  for (const Knob& knob : collect_knobs(scene_of("", ""), 5)) keys.push_back(knob.key);
  EXPECT_EQ(keys, (Texts{"shape.particles", "shape.basis", "shape.support_scale",
                         "shape.quadrature", "pose.solver", "pose.tolerance"}));
}

TEST(CollectKnobs, DoublesParticlesFromHalfOfTheOwn) {
  const Knob usual = knob_of(scene_of("", ""), "particles", 5);
  EXPECT_EQ(usual.values, (Texts{"100", "200", "400", "800", "1600"}));
  EXPECT_EQ(usual.own, 1u);
  EXPECT_TRUE(usual.converges);
  const Knob given = knob_of(scene_of(", particles: 50", ""), "particles", 3);
  EXPECT_EQ(given.values, (Texts{"25", "50", "100"}));
}

TEST(CollectKnobs, KeepsWithinTheBoundsOfTheMember) {
  EXPECT_EQ(knob_of(scene_of(", particles: 500000", ""), "particles", 5).values,
            (Texts{"250000", "500000", "1000000"}));
  EXPECT_EQ(knob_of(scene_of(", particles: 1", ""), "particles", 3).values, (Texts{"1", "2"}));
}

TEST(CollectKnobs, TakesTolerancesByWholeDecadesAndTheOwn) {
  const Knob knob = knob_of(scene_of("", "tolerance: 3e-5"), "tolerance", 5);
  EXPECT_EQ(knob.values.front(), "0.01");
  EXPECT_EQ(knob.values.back(), "1e-12");
  EXPECT_EQ(knob.values.size(), 6u);
  EXPECT_EQ(knob.values[knob.own], "3e-05");
  EXPECT_EQ(knob.exact, "1e-13");
  EXPECT_TRUE(std::is_sorted(knob.numbers.rbegin(), knob.numbers.rend()));
}

TEST(CollectKnobs, TakesAllNamesOfAnEnumeration) {
  const Knob knob = knob_of(scene_of(", basis: quadratic", ""), "basis", 3);
  EXPECT_EQ(knob.values, (Texts{"constant", "linear", "quadratic"}));
  EXPECT_EQ(knob.own, 2u);
}

TEST(CollectKnobs, EveryValueCanBeSet) {
  const Scene scene = scene_of("", "");
  for (const Knob& knob : collect_knobs(scene, 5))
    for (const std::string& value : knob.values)
      EXPECT_NO_THROW(overridden(scene, {{knob.key, value}})) << knob.key << "=" << value;
}

TEST(ChooseKnobs, NamesTheNearestOfWhatItDoesNotKnow) {
  const std::vector<Knob> knobs = collect_knobs(scene_of("", ""), 5);
  const std::string message =
      message_of<UsageError>([&] { choose_knobs(knobs, Texts{"tolerence"}, "--knobs"); });
  EXPECT_NE(message.find("--knobs: 'tolerence' is not a knob"), std::string::npos) << message;
  EXPECT_NE(message.find("did you mean 'tolerance'?"), std::string::npos) << message;
  EXPECT_EQ(choose_knobs(knobs, Texts{"tolerance", "basis"}, "--knobs").size(), 2u);
  EXPECT_EQ(choose_knobs(knobs, Texts{}, "--knobs").size(), knobs.size());
}

}  // namespace
}  // namespace supple
