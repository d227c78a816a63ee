#pragma once

#include <span>
#include <vector>

#include "solver/core/types.h"

namespace supple {

struct Candidate {
  double error = 0, seconds = 0;
};

/// Less is no gain: a share of the error.
constexpr double least_gain = 0.01;

/// The candidates to which no other is better in one and as good in the other, from the fastest to
/// the most accurate. One that is slower must have less than (1 − `gain`) of the error to count.
std::vector<std::size_t> pareto_front(std::span<const Candidate> candidates,
                                      double gain = least_gain);

}  // namespace supple
