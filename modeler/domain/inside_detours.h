#pragma once

#include <memory>
#include <vector>

#include "modeler/domain/inside_graph.h"
#include "solver/field/detours.h"

namespace supple {

class PocketSpline;

/// How much longer than the straight line ways inside a region are, from each of its particles:
/// δ = length inside − straight distance, found at the pockets of its graph and interpolated by
/// splines over them. So δ is C¹ inside, and differs between the walls of a gap however thin.
class InsideDetours {
 public:
  /// `graph` and the region outlive this and all detours from it. `positions` [m] n×3, inside.
  InsideDetours(std::shared_ptr<const InsideGraph> graph, const Points& positions, double spacing);
  ~InsideDetours();

  /// The detours within support radii up to `supports` h_i [m] n, which will not grow beyond
  /// `widest`. Null where no straight line leaves the region. Particles whose support has hardly
  /// grown since the last call cost nothing.
  std::shared_ptr<const Detours> within(const Eigen::VectorXd& supports, double widest);

 private:
  class Finder;
  class Field;
  struct AtControl {
    int control;
    double length;  ///< δ [m]
  };

  std::shared_ptr<const InsideGraph> graph_;
  std::shared_ptr<const PocketSpline> spline_;
  Points positions_;
  double spacing_;
  Eigen::VectorXd radii_;                        ///< within which detours are known [m]
  std::vector<std::vector<AtControl>> lengths_;  ///< of each particle, not zero
  std::shared_ptr<const Detours> latest_;
};

}  // namespace supple
