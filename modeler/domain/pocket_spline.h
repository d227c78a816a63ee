#pragma once

#include <array>
#include <span>
#include <vector>

#include "modeler/domain/inside_graph.h"

namespace supple {

/// Triquadratic B-splines over the pockets of a graph: C¹ where the region hangs together, and
/// free to jump where it does not. Each pocket has the 27 controls of its cell; linked pockets
/// share those of the same place (virtual nodes, Molino et al. 2004).
class PocketSpline {
 public:
  static constexpr int controls_a_pocket = 27;
  using Controls = std::array<int, controls_a_pocket>;

  /// What a pocket's 27 controls count at a point, with derivatives.
  struct Weights {
    std::array<double, controls_a_pocket> values;
    std::array<Vec3, controls_a_pocket> slopes;      ///< [1/m]
    std::array<Mat3, controls_a_pocket> curvatures;  ///< [1/m²]
  };

  explicit PocketSpline(const InsideGraph& graph);

  int size() const { return static_cast<int>(places_.size()); }  ///< number of controls
  const Vec3& place(int control) const { return places_[control]; }
  const Controls& controls(int pocket) const { return controls_[pocket]; }

  /// The controls whose values are to be taken from a seated pocket: those of its own place, and
  /// those that no nearer pocket speaks for.
  std::span<const int> spoken_for(int pocket) const;

  Weights weights(int pocket, const Vec3& x) const;

 private:
  void share_controls();
  void choose_speakers();

  const InsideGraph& graph_;
  std::vector<Controls> controls_;
  std::vector<Vec3> places_;
  std::vector<int> spoken_starts_, spoken_;
};

}  // namespace supple
