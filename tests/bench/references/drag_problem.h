#pragma once

#include "solver/field/samples.h"

namespace supple::bench {

/// A pose problem laid bare, as the references take it: E = λ1 Σ ω |f − target|² +
/// Σ V (λ2 |FᵀF − I|² + λ3 (det F − 1)²), all over a shape of diagonal 1.
struct DragProblem {
  Index particles = 0;
  const Samples* quadrature = nullptr;
  Eigen::VectorXd volumes;  ///< V, sum 1
  const Samples* handles = nullptr;
  Eigen::VectorXd handle_weights;                 ///< ω, sum 1
  double handle = 1e4, rigidity = 1, volume = 1;  ///< λ
};

}  // namespace supple::bench
