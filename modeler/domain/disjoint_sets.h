#pragma once

#include <numeric>
#include <vector>

namespace supple {

/// Sets of the numbers 0 … n−1, each at first alone in its own.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parents_(count) {
    std::iota(parents_.begin(), parents_.end(), 0);
  }

  /// The number that stands for i's set; halves the path to it on the way.
  int root(int i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }

  void unite(int i, int j) { parents_[root(i)] = root(j); }
  bool together(int i, int j) { return root(i) == root(j); }

 private:
  std::vector<int> parents_;
};

}  // namespace supple
