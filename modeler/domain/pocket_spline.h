#pragma once

#include <array>
#include <span>
#include <vector>

#include "modeler/domain/inside_graph.h"
#include "solver/field/derivatives.h"

namespace supple {

/// Triquadratic B-splines over the pockets of a graph: C¹ where the region hangs together, and
/// free to jump where it does not. Each pocket has the 27 controls of its cell; linked pockets
/// share those of the same place (virtual nodes, Molino et al. 2004).
class PocketSpline {
 public:
  static constexpr int controls_a_pocket = 27;
  using Controls = std::array<int, controls_a_pocket>;

  /// The quadratic B-splines along the three axes that do not vanish at a point: values, first and
  /// second derivatives.
  using Basis = std::array<std::array<Vec3, 3>, 3>;

  /// What the controls of a pocket say.
  using Values = std::span<const float, controls_a_pocket>;

  /// A spline's value with its derivatives.
  struct Value {
    double value = 0;
    Vec3 slope = Vec3::Zero();      ///< [1/m]
    Mat3 curvature = Mat3::Zero();  ///< [1/m²]
  };

  explicit PocketSpline(const InsideGraph& graph);

  int size() const { return static_cast<int>(places_.size()); }  ///< number of controls
  const Vec3& place(int control) const { return places_[control]; }
  const Controls& controls(int pocket) const { return controls_[pocket]; }

  /// The controls whose values are to be taken from a seated pocket: those of its own place, and
  /// those that no nearer pocket speaks for.
  std::span<const int> spoken_for(int pocket) const;

  /// Of x in the cell of a pocket.
  Basis basis(int pocket, const Vec3& x) const;

  /// The spline with these values, where the basis was taken.
  static Value sum(const Basis& basis, Values values, Derivatives derivatives);

 private:
  void share_controls();
  void choose_speakers();

  const InsideGraph& graph_;
  std::vector<Controls> controls_;
  std::vector<Vec3> places_;
  std::vector<int> spoken_starts_, spoken_;
};

}  // namespace supple
