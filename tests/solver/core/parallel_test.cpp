#include "solver/core/parallel.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace supple {
namespace {

double chunked_sum(int threads) {
  const ThreadLimit limit(threads);
  std::vector<double> partial(40);
  parallel_chunks(10000, 250, [&](Index begin, Index end) {
    double& sum = partial[static_cast<std::size_t>(begin / 250)];
    for (Index i = begin; i < end; ++i) sum += std::sin(static_cast<double>(i));
  });
  double sum = 0;
  for (const double part : partial) sum += part;
  return sum;
}

TEST(Parallel, GivesTheSameBitsForEveryNumberOfThreads) {
  const double one = chunked_sum(1);
  EXPECT_EQ(one, chunked_sum(2));
  EXPECT_EQ(one, chunked_sum(7));
  EXPECT_EQ(one, chunked_sum(0));
}

TEST(Parallel, DoesNothingForNothing) {
  parallel_chunks(0, 10, [](Index, Index) { FAIL(); });
}

}  // namespace
}  // namespace supple
