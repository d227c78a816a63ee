#include "modeler/study/sweeps.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/modeler/study/manufactured.h"

namespace supple {
namespace {

/// The runs that a budget lets happen, as the settings in their order.
struct Runs {
  Sweeps sweeps;
  std::vector<std::string> settings;
  double seconds = 0;

  Runs(const std::vector<Knob>& knobs, const SweepOptions& options)
      : sweeps(plan_sweeps(knobs, options)) {
    const Manufactured problem;
    run_sweeps(
        sweeps,
        [&](const SceneOverrides& setting, double most) {
          settings.push_back(setting_text(setting));
          TrialOutcome outcome = problem(setting, most);
          seconds += outcome.seconds;
          return outcome;
        },
        options);
  }

  bool ran(const std::string& setting) const {
    return std::find(settings.begin(), settings.end(), setting) != settings.end();
  }
};

TEST(Sweeps, TheSceneAsItIsIsOneTrialOfAllKnobs) {
  const Sweeps sweeps = plan_sweeps({particles_knob(), tolerance_knob(), solver_knob()}, {});
  EXPECT_EQ(sweeps.trials.size(), 1u + 4 + 3 + 1 + 2);
  std::size_t own = sweeps.knobs[0].points[1].trial;
  EXPECT_TRUE(sweeps.trials[own].settings.empty());
  EXPECT_EQ(sweeps.knobs[1].points[2].trial, own);
  EXPECT_EQ(sweeps.knobs[2].points[0].trial, own);
}

TEST(Sweeps, RunEverythingThreeTimesCoarseFirst) {
  const Runs runs({particles_knob()}, {});
  EXPECT_EQ(runs.settings.size(), 15u);
  const std::vector<std::string> first(runs.settings.begin(), runs.settings.begin() + 5);
  EXPECT_EQ(first, (std::vector<std::string>{"particles=100", "as it is", "particles=400",
                                             "particles=800", "particles=1600"}));
}

TEST(Sweeps, TheExactOneIsRunOnce) {
  const Runs runs({tolerance_knob()}, {});
  EXPECT_EQ(std::count(runs.settings.begin(), runs.settings.end(), "tolerance=1e-16"), 1);
}

TEST(Sweeps, NeverStartWhatIsPredictedToOverrun) {
  // 1 + 2.8 + 8 s for 100 to 400 particles, then 22.6 s and 64 s.
  for (const double budget : {0.5, 2.0, 5.0, 15.0, 40.0, 120.0, 1000.0}) {
    SweepOptions options;
    options.budget = budget;
    const Runs runs({particles_knob()}, options);
    const double first_run = 1;  // of which nothing is known before
    EXPECT_LE(runs.seconds, std::max(budget, first_run)) << budget;
    for (const Trial& trial : runs.sweeps.trials) {
      EXPECT_EQ(trial.skipped.empty(), !trial.seconds.empty()) << setting_text(trial.settings);
      EXPECT_EQ(trial.skipped.empty(), runs.ran(setting_text(trial.settings)));
    }
  }
}

TEST(Sweeps, UseTheBudgetThatThereIs) {
  SweepOptions options;
  options.budget = 15;
  const Runs runs({particles_knob()}, options);
  EXPECT_TRUE(runs.ran("particles=400"));
  EXPECT_FALSE(runs.ran("particles=800"));
  EXPECT_GT(std::count(runs.settings.begin(), runs.settings.end(), "particles=100"), 1)
      << "what is left is for more runs of the coarse ones";
}

TEST(Sweeps, NamesRunLastAndCannotTakeTheWholeBudget) {
  SweepOptions options;
  options.budget = 100;
  Sweeps sweeps = plan_sweeps({solver_knob(), tolerance_knob()}, options);
  EXPECT_EQ(sweeps.knobs.front().knob.name, "solver") << "rows keep the order of the knobs";
  std::vector<std::string> settings;
  double spent = 0;
  run_sweeps(
      sweeps,
      [&](const SceneOverrides& setting, double most) {
        const bool by_name = !setting.empty() && setting.front().first == "pose.solver";
        TrialOutcome outcome;
        outcome.status = by_name ? Status::failed : Status::ok;
        outcome.seconds = by_name ? most : 2;  // it takes all that it may
        spent += outcome.seconds;
        settings.push_back(setting_text(setting));
        return outcome;
      },
      options);
  EXPECT_EQ(settings[0], "tolerance=0.01");
  EXPECT_EQ(settings[5], "solver=worse");
  EXPECT_EQ(std::count(settings.begin(), settings.end(), "tolerance=0.0001"), 3);
  EXPECT_LE(spent, options.budget);
}

TEST(Sweeps, ANameGetsThirtyTimesTheOwnTime) {
  Sweeps sweeps = plan_sweeps({solver_knob()}, {});
  std::vector<double> given;
  run_sweeps(sweeps,
             [&](const SceneOverrides& setting, double most) {
               if (!setting.empty()) given.push_back(most);
               TrialOutcome outcome;
               outcome.status = setting.empty() ? Status::ok : Status::failed;
               outcome.seconds = 2;
               return outcome;
             },
             {});
  EXPECT_EQ(given, (std::vector<double>{60, 60}));
}

TEST(Sweeps, FailedTrialsAreNotRepeated) {
  Sweeps sweeps = plan_sweeps({solver_knob()}, {});
  int runs = 0;
  run_sweeps(sweeps,
             [&](const SceneOverrides&, double) {
               ++runs;
               TrialOutcome outcome;
               outcome.status = Status::failed;
               outcome.reasons = {"no"};
               return outcome;
             },
             {});
  EXPECT_EQ(runs, 3);
}

TEST(Sweeps, TellTheirProgress) {
  SweepOptions options;
  std::vector<double> shares;
  options.progress = [&](const std::string&, double share) { shares.push_back(share); };
  const Runs runs({particles_knob()}, options);
  EXPECT_EQ(shares.size(), runs.settings.size());
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.front(), 0);
  EXPECT_LT(shares.back(), 1);
}

}  // namespace
}  // namespace supple
