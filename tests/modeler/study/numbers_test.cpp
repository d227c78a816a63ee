// Power laws, Pareto sets and the extrapolated reference.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "modeler/study/fit.h"
#include "modeler/study/pareto.h"
#include "modeler/study/reference.h"

namespace supple {
namespace {

TEST(FitPowerLaw, FindsWhatItWasGiven) {
  std::vector<std::pair<double, double>> points;
  for (const double x : {10.0, 25.0, 80.0, 300.0}) points.emplace_back(x, 0.7 * std::pow(x, -1.3));
  const auto law = fit_power_law(points);
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->factor, 0.7, 1e-12);
  EXPECT_NEAR(law->exponent, -1.3, 1e-12);
  EXPECT_NEAR(law->at(50), 0.7 * std::pow(50, -1.3), 1e-12);
}

TEST(FitPowerLaw, IsNoneOfOnePlaceOrOfWhatHasNoLogarithm) {
  using Pairs = std::vector<std::pair<double, double>>;
  EXPECT_FALSE(fit_power_law(Pairs{}));
  EXPECT_FALSE(fit_power_law(Pairs{{2, 3}, {2, 4}}));
  EXPECT_FALSE(fit_power_law(Pairs{{2, 3}, {0, 4}, {3, 0}}));
}

TEST(Median, IsTheMiddle) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 2, 3}), 2.5);
  EXPECT_EQ(median({}), 0);
}

TEST(ParetoFront, HoldsWhatNothingBeats) {
  const std::vector<Candidate> candidates = {{0.1, 1},   {0.05, 2}, {0.07, 3},
                                             {0.2, 0.5}, {0.05, 4}, {0.2, 0.6}};
  EXPECT_EQ(pareto_front(candidates), (std::vector<std::size_t>{3, 0, 1}));
}

TEST(ParetoFront, LeavesOutWhatGainsNextToNothing) {
  EXPECT_EQ(pareto_front(std::vector<Candidate>{{0.1, 1}, {0.0999, 2}}),
            (std::vector<std::size_t>{0}));
}

TEST(ParetoFront, NoMemberBeatsAnotherAndEveryOtherIsBeaten) {
  std::vector<Candidate> candidates;
  for (int i = 0; i < 200; ++i)
    candidates.push_back({1 + std::fmod(0.618034 * i, 1), 1 + std::fmod(0.754878 * i, 1)});
  const std::vector<std::size_t> front = pareto_front(candidates, 0);
  const auto beats = [&](std::size_t a, std::size_t b) {
    return candidates[a].error <= candidates[b].error &&
           candidates[a].seconds <= candidates[b].seconds && a != b;
  };
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const bool beaten = std::any_of(front.begin(), front.end(),
                                    [&](std::size_t member) { return beats(member, i); });
    EXPECT_EQ(beaten, std::find(front.begin(), front.end(), i) == front.end()) << i;
  }
}

/// x* + h^p·a + h^(p+1)·b on levels of N particles.
struct Levels {
  Points exact = Points::Random(40, 3);
  std::vector<Points> results;
  std::vector<double> unknowns = {300, 600, 1200};

  Levels(double order, double second) {
    const Points a = Points::Random(40, 3), b = second * Points::Random(40, 3);
    for (const double n : unknowns) {
      const double h = std::cbrt(1 / n);
      results.push_back(exact + std::pow(h, order) * a + std::pow(h, order + 1) * b);
    }
  }

  std::vector<GridLevel> grid() const {
    std::vector<GridLevel> levels;
    for (std::size_t i = 0; i < results.size(); ++i) levels.push_back({&results[i], unknowns[i]});
    return levels;
  }
};

TEST(Extrapolate, TheLimitLiesWithinTheBand) {
  for (const double order : {1.0, 2.0, 3.0})
    for (const double second : {0.0, 0.5, 1.0, 2.0}) {
      const Levels levels(order, second);
      const auto reference = extrapolate(levels.grid());
      ASSERT_TRUE(reference);
      EXPECT_LE(rms_distance(reference->positions, levels.exact), reference->uncertainty)
          << order << " " << second;
      EXPECT_LT(rms_distance(reference->positions, levels.exact),
                rms_distance(levels.results.back(), levels.exact))
          << "nearer than the finest result";
    }
}

TEST(Extrapolate, FindsTheOrderOnUnevenLevels) {
  Levels levels(2, 0);
  levels.unknowns = {300, 500, 1700};
  const Points field = levels.results[0] - levels.exact;
  for (std::size_t i = 0; i < 3; ++i)
    levels.results[i] = levels.exact + std::pow(levels.unknowns[i] / 300, -2.0 / 3) * field;
  const auto reference = extrapolate(levels.grid());
  ASSERT_TRUE(reference && reference->order);
  EXPECT_NEAR(*reference->order, 2, 1e-6);
  EXPECT_LT(rms_distance(reference->positions, levels.exact), 1e-9);
}

TEST(Extrapolate, DoubtsWhatDoesNotConverge) {
  Levels levels(2, 0);
  levels.results[0] = levels.results[1];  // the steps grow
  const auto reference = extrapolate(levels.grid());
  ASSERT_TRUE(reference);
  EXPECT_FALSE(reference->plausible);
  const double r = std::cbrt(2.0);
  EXPECT_NEAR(reference->uncertainty,
              3 * rms_distance(levels.results[2], levels.results[1]) / (r * r - 1), 1e-12);
}

TEST(Extrapolate, TwoLevelsTakeTheExpectedOrderInDoubt) {
  const Levels levels(2, 0);
  std::vector<GridLevel> grid = levels.grid();
  grid.erase(grid.begin());
  const auto reference = extrapolate(grid);
  ASSERT_TRUE(reference);
  EXPECT_FALSE(reference->plausible);
  EXPECT_LT(rms_distance(reference->positions, levels.exact), 1e-9);
  grid.erase(grid.begin());
  EXPECT_FALSE(extrapolate(grid));
}

}  // namespace
}  // namespace supple
