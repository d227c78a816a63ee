#include "modeler/study/pareto.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace supple {

std::vector<std::size_t> pareto_front(std::span<const Candidate> candidates, double gain) {
  std::vector<std::size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const Candidate &left = candidates[a], &right = candidates[b];
    return left.seconds != right.seconds ? left.seconds < right.seconds : left.error < right.error;
  });
  std::vector<std::size_t> front;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : order) {
    if (!(candidates[i].error < (1 - gain) * least)) continue;
    front.push_back(i);
    least = candidates[i].error;
  }
  return front;
}

}  // namespace supple
