#include "modeler/study/choice.h"

#include <gtest/gtest.h>

#include "tests/modeler/study/manufactured.h"

namespace supple {
namespace {

const std::vector<Knob> knobs = {particles_knob(), tolerance_knob()};

/// The true error of a choice.
double true_error(const Manufactured& problem, const Choice& choice) {
  return rms_distance(problem.result(Manufactured::value(choice.settings, "shape.particles", 200),
                                     Manufactured::value(choice.settings, "pose.tolerance", 1e-6)),
                      problem.exact);
}

TEST(ChooseForError, HitsTheTargetOnTwentyProblems) {
  int hits = 0;
  for (int k = 0; k < 20; ++k) {
    Manufactured problem;
    problem.order = 1 + 0.1 * k;
    problem.size = std::pow(2, k % 5);
    const double target = true_error(problem, {}) * (k % 2 == 0 ? 0.8 : 0.5);
    const Study result = study(knobs, knobs, problem);
    const Choice choice = choose_for_error(result, knobs, problem, target);
    ASSERT_TRUE(choice.met) << k << ": " << choice.why_not;
    const double error = true_error(problem, choice);
    EXPECT_NEAR(*choice.error, error, 0.3 * error) << "as it was verified";
    hits += error < target * 1.1 && error > target / 3 ? 1 : 0;
  }
  EXPECT_GE(hits, 18);
}

TEST(ChooseForError, TakesNoMoreParticlesThanItNeeds) {
  const Manufactured problem;
  const Study result = study(knobs, knobs, problem);
  const Choice loose = choose_for_error(result, knobs, problem, 0.05);
  const Choice tight = choose_for_error(result, knobs, problem, 0.005);
  ASSERT_TRUE(loose.met && tight.met);
  EXPECT_LT(loose.seconds, tight.seconds);
}

TEST(ChooseForError, SaysWhatCanBeReachedWhereTheTargetCannot) {
  const Manufactured problem;
  const Study result = study(knobs, knobs, problem);
  const Choice choice = choose_for_error(result, knobs, problem, 1e-9);
  EXPECT_FALSE(choice.met);
  EXPECT_NE(choice.why_not.find("the least that was measured is"), std::string::npos)
      << choice.why_not;
}

TEST(ChooseForError, TrustsNoLawOfErrorsThatDoNotFall) {
  Manufactured problem;
  problem.order = 0;
  const Study result = study(knobs, knobs, problem);
  EXPECT_FALSE(choose_for_error(result, knobs, problem, 1e-3).met);
}

TEST(ChooseForError, DoesNotRecommendWhatIsNotOk) {
  const Manufactured problem;
  const Study result = study(knobs, knobs, problem);
  const Choice choice = choose_for_error(
      result, knobs,
      [&](const SceneOverrides& settings, double most) {
        TrialOutcome outcome = problem(settings, most);
        outcome.status = Status::degraded;
        return outcome;
      },
      0.05);
  EXPECT_FALSE(choice.met);
}

TEST(ChooseForTime, TakesTheMostAccurateThatFits) {
  const Manufactured problem;  // 1, 2.8, 8, 22.6 and 64 s
  const Study result = study({particles_knob()}, {particles_knob()}, problem);
  const Choice choice = choose_for_time(result, 12);
  ASSERT_TRUE(choice.met);
  EXPECT_EQ(Manufactured::value(choice.settings, "shape.particles", 200), 400);
  EXPECT_LE(choice.seconds, 0.8 * 12);
  EXPECT_FALSE(choose_for_time(result, 1).met);
}

}  // namespace
}  // namespace supple
