#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace supple {

/// Sets of the numbers below `count`, at first of one each. A set's root is its least number.
class DisjointSets {
 public:
  explicit DisjointSets(int count) : parents_(static_cast<std::size_t>(count)) {
    std::iota(parents_.begin(), parents_.end(), 0);
  }

  int root(int i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }

  void unite(int a, int b) {
    a = root(a);
    b = root(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<int> parents_;
};

}  // namespace supple
