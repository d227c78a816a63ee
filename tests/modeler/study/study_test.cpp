// A study finds what a manufactured problem was given: orders, limits, costs; and nothing that is
// not ok is recommended.

#include "modeler/study/study.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/modeler/study/manufactured.h"

namespace supple {
namespace {

const StudyRow& row_of(const Study& study, const std::string& knob, const std::string& value) {
  const auto found = std::find_if(study.rows.begin(), study.rows.end(), [&](const StudyRow& row) {
    return row.knob == knob && row.value == value;
  });
  if (found == study.rows.end()) throw std::runtime_error("no row " + knob + "=" + value);
  return *found;
}

/// As the manufactured problem, but with one solver that fails and one that is degraded; both
/// would be better than all others.
TrialOutcome with_solvers(const Manufactured& problem, const SceneOverrides& settings) {
  TrialOutcome outcome = problem(settings, 0);
  if (settings.empty() || settings.front().first != "pose.solver") return outcome;
  const bool broken = settings.front().second == "broken";
  outcome.status = broken ? Status::failed : Status::degraded;
  outcome.reasons = {broken ? "it broke" : "inverted: 3 points"};
  outcome.positions = broken ? Points() : problem.exact;
  outcome.seconds = 1e-6;
  return outcome;
}

class StudyOrders : public testing::TestWithParam<double> {};

TEST_P(StudyOrders, FindsTheOrderAndItsLimitWithinTheBand) {
  Manufactured problem;
  problem.order = GetParam();
  const Study result = study({particles_knob()}, {particles_knob()}, problem);
  ASSERT_TRUE(result.reference && result.reference->order);
  EXPECT_TRUE(result.reference->plausible);
  EXPECT_NEAR(*result.reference->order, GetParam(), 0.2);
  // Without a second term the limit is exact but for the solver's part.
  EXPECT_NEAR(*row_of(result, "particles", "100").error,
              rms_distance(problem.result(100, 1e-6), problem.result(1e30, 1e-6)), 1e-9);
  for (const StudyRow& row : result.rows) {
    if (row.value == "100") continue;
    ASSERT_TRUE(row.order) << row.value;
    EXPECT_NEAR(*row.order, GetParam(), 0.2) << row.value;
  }
}

INSTANTIATE_TEST_SUITE_P(Orders, StudyOrders, testing::Values(1.0, 2.0, 3.0));

TEST(Study, FindsTheOrderOfTheTolerance) {
  const Study result =
      study({particles_knob(), tolerance_knob()}, {tolerance_knob()}, Manufactured());
  for (const StudyRow& row : result.rows) {
    EXPECT_EQ(row.reference, "tolerance=1e-16");
    EXPECT_FALSE(row.total) << "no knob that was chosen needs the particles' reference";
    if (row.value == "0.01") continue;
    ASSERT_TRUE(row.order);
    EXPECT_NEAR(*row.order, 0.5, 0.2) << row.value;
  }
}

TEST(Study, CostOfTenTimesLessErrorFollowsFromBothOrders) {
  const Study result = study({particles_knob()}, {particles_knob()}, Manufactured());
  ASSERT_TRUE(result.cost);
  // t ~ N^1.5 and e ~ N^(−2/3).
  EXPECT_NEAR(result.cost->exponent, -1.5 / (2.0 / 3), 0.05);
}

TEST(Study, NamesTheDominantSource) {
  Manufactured coarse, loose;
  loose.size = 1e-6;
  loose.solver_field *= 1e3;
  const std::vector<Knob> knobs = {particles_knob(), tolerance_knob()};
  EXPECT_EQ(study(knobs, knobs, coarse).sources.front().knob, "particles");
  EXPECT_EQ(study(knobs, knobs, loose).sources.front().knob, "tolerance");
}

TEST(Study, FlagsErrorsThatItsReferenceCannotTell) {
  const Study result = study({particles_knob()}, {particles_knob()}, Manufactured());
  for (const StudyRow& row : result.rows)
    EXPECT_EQ(row.reference_too_coarse, *row.error < 10 * row.uncertainty) << row.value;
  EXPECT_TRUE(row_of(result, "particles", "1600").reference_too_coarse);
  EXPECT_GT(row_of(result, "particles", "1600").uncertainty, 0);
}

TEST(Study, TellsNoOrderThatItAssumed) {
  const Manufactured problem;
  const Study result = study(
      {particles_knob()}, {particles_knob()}, [&](const SceneOverrides& settings, double most) {
        TrialOutcome outcome = problem(settings, most);
        outcome.positions += (outcome.unknowns > 3000 ? 10.0 : 0.0) * problem.solver_field;
        return outcome;
      });
  ASSERT_TRUE(result.reference);
  EXPECT_FALSE(result.reference->plausible) << "the finest result jumps";
  EXPECT_FALSE(row_of(result, "particles", "1600").order);
  EXPECT_TRUE(row_of(result, "particles", "800").order);
}

TEST(Study, FlagsNoisyTimes) {
  const Manufactured problem;
  int run = 0;
  const Runner noisy = [&](const SceneOverrides& settings, double most) {
    TrialOutcome outcome = problem(settings, most);
    if (settings.empty()) outcome.seconds *= 1 + 0.1 * ++run;
    return outcome;
  };
  const Study result = study({particles_knob()}, {particles_knob()}, noisy);
  for (const StudyRow& row : result.rows) EXPECT_EQ(row.noisy, row.own) << row.value;
}

TEST(Study, RecommendsNothingThatIsNotOk) {
  const Manufactured problem;
  const std::vector<Knob> knobs = {particles_knob(), solver_knob()};
  const Study result = study(knobs, knobs, [&](const SceneOverrides& settings, double) {
    return with_solvers(problem, settings);
  });
  ASSERT_EQ(result.pareto.size(), 5u) << "the five numbers of particles";
  for (const std::size_t i : result.pareto)
    EXPECT_EQ(result.trial(result.rows[i]).outcome.status, Status::ok);
  EXPECT_TRUE(result.better.empty());
  EXPECT_FALSE(row_of(result, "solver", "broken").error);
  EXPECT_EQ(result.trial(row_of(result, "solver", "broken")).outcome.reasons.front(), "it broke");
  EXPECT_TRUE(row_of(result, "solver", "worse").error) << "measured, but not recommended";
}

TEST(Study, SaysWhatIsBetterThanTheSceneAsItIs) {
  const Manufactured problem;
  const std::vector<Knob> knobs = {particles_knob(), solver_knob()};
  const Study result = study(knobs, knobs, [&](const SceneOverrides& settings, double most) {
    TrialOutcome outcome = problem(settings, most);
    if (!settings.empty() && settings.front().second == "worse") {
      outcome.positions = problem.result(1000, 1e-6);
      outcome.seconds /= 2;
    }
    return outcome;
  });
  ASSERT_EQ(result.better.size(), 1u);
  EXPECT_EQ(result.rows[result.better.front()].value, "worse");
  EXPECT_FALSE(result.rows[*result.own].pareto);
}

TEST(Study, RunsTheParticlesForKnobsThatAreComparedWithThem) {
  const std::vector<Knob> knobs = {particles_knob(), solver_knob()};
  const Study result = study(knobs, {solver_knob()}, Manufactured());
  EXPECT_EQ(result.rows.size(), 3u);
  for (const StudyRow& row : result.rows) EXPECT_TRUE(row.error) << row.value;
  for (const Trial& trial : result.trials) {
    const bool shown = trial.settings.empty() || trial.settings.front().first == "pose.solver";
    EXPECT_EQ(trial.seconds.size(), shown ? 3u : 1u) << setting_text(trial.settings);
  }
}

TEST(Study, OfOneLevelAloneTellsNoError) {
  Knob one = particles_knob();
  one.values = {"200"};
  one.numbers = {200};
  one.own = 0;
  const Study result = study({one}, {one}, Manufactured());
  EXPECT_FALSE(result.reference);
  EXPECT_FALSE(result.rows.front().error);
  EXPECT_TRUE(result.pareto.empty());
}

}  // namespace
}  // namespace supple
