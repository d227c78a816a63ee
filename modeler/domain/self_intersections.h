#pragma once

#include <array>
#include <vector>

#include "solver/core/describe.h"
#include "solver/core/types.h"

namespace supple {

/// Pairs of triangles that have more in common than the vertices they share.
struct SelfIntersections {
  long count = 0;
  std::vector<std::array<int, 2>> pairs;  ///< the first few, ascending
  double tested = 1;  ///< share of the triangles that were held against the rest; below 1 `count`
                      ///< is an estimate
};

struct SelfIntersectionOptions {
  double most_candidates = 3e7;
  int most_pairs = 5;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit("most_candidates", self.most_candidates,
          {.doc = "pairs of triangles whose boxes meet, beyond which only a sample is tested",
           .min = 1});
    visit("most_pairs", self.most_pairs, {.doc = "kept of the pairs found", .min = 0});
  }
};

/// Exact tests (orientation.h) of all pairs whose boxes meet. Vertices at one position must have
/// one number, or triangles that share them count. Triangles with the same three vertices are
/// copies of each other and do not count; those without area are left out.
SelfIntersections self_intersections(const Points& positions, const Triangles& triangles,
                                     const SelfIntersectionOptions& options = {});

}  // namespace supple
