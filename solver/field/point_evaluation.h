#pragma once

#include "solver/field/moving_least_squares.h"

namespace supple {

/// φ and its derivatives up to Order at x, of the particles that at_x names already. Compiled in
/// files of their own, as each pair of dimension and order takes long.
template <int Dim, int Order>
void evaluate_at(const MovingLeastSquares<Dim>& field, const VectorOf<Dim>& x,
                 ShapeFunctions<Dim>& at_x);

/// φ and the linear fit's gradients.
template <int Dim>
void fit_at(const MovingLeastSquares<Dim>& field, const VectorOf<Dim>& x,
            ShapeFunctions<Dim>& at_x);

}  // namespace supple
