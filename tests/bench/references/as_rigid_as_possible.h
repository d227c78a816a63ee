#pragma once

#include <memory>
#include <vector>

#include "solver/core/types.h"

namespace supple::bench {

/// The peer: CGAL's as-rigid-as-possible deformation of a triangle mesh. Its unknowns are the
/// vertices, ours the particles, and it meets its control vertices exactly: a ratio of times speaks
/// of steps at equal handles, not of equal models.
class AsRigidAsPossible {
 public:
  /// `controls` vertices that are led.
  AsRigidAsPossible(const Points& vertices, const Triangles& triangles,
                    const std::vector<int>& controls);
  ~AsRigidAsPossible();

  /// Leads the controls to `targets` [m], one a row, and runs so many iterations.
  void deform(const Points& targets, int iterations);
  Points positions() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace supple::bench
