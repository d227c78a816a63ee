#pragma once

#include <numeric>
#include <vector>

#include "solver/field/samples.h"

namespace supple {

/// Sets of particles that hang together: those that share a sample do.
class Pieces {
 public:
  explicit Pieces(Index particles) : parents_(static_cast<std::size_t>(particles)) {
    std::iota(parents_.begin(), parents_.end(), 0);
  }

  void tie(int i, int j) {
    parents_[root(static_cast<std::size_t>(i))] =
        static_cast<int>(root(static_cast<std::size_t>(j)));
  }

  void tie(const Samples& samples) {
    for (Index k = 0; k < samples.size(); ++k)
      for (int at = samples.row_begin(k); at < samples.row_end(k); ++at)
        tie(samples.particles[static_cast<std::size_t>(at)],
            samples.particles[static_cast<std::size_t>(samples.row_begin(k))]);
  }

  /// The number of the piece that each particle belongs to, from 0, in the particles' order.
  std::vector<int> numbers() {
    std::vector<int> of_root(parents_.size(), -1), numbers(parents_.size());
    int next = 0;
    for (std::size_t i = 0; i < parents_.size(); ++i) {
      int& number = of_root[root(i)];
      if (number < 0) number = next++;
      numbers[i] = number;
    }
    return numbers;
  }

  /// True for the particles in one piece with any that the samples reach.
  std::vector<bool> reached_by(const Samples& samples) {
    std::vector<bool> roots(parents_.size(), false), reached(parents_.size());
    for (const int i : samples.particles) roots[root(static_cast<std::size_t>(i))] = true;
    for (std::size_t i = 0; i < parents_.size(); ++i) reached[i] = roots[root(i)];
    return reached;
  }

 private:
  std::size_t root(std::size_t i) {
    while (static_cast<std::size_t>(parents_[i]) != i)
      i = static_cast<std::size_t>(parents_[i] = parents_[static_cast<std::size_t>(parents_[i])]);
    return i;
  }

  std::vector<int> parents_;
};

}  // namespace supple
