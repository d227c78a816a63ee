#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace supple {

/// Sets of the numbers below `count`, each at first alone in its own. A set's root is its least
/// number.
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

  void unite(int a, int b) {
    a = root(a);
    b = root(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }

  bool together(int a, int b) { return root(a) == root(b); }

 private:
  std::vector<int> parents_;
};

}  // namespace supple
