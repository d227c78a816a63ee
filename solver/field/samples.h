#pragma once

#include <optional>
#include <span>
#include <vector>

#include "solver/core/export.h"
#include "solver/core/types.h"
#include "solver/field/moving_least_squares.h"
#include "solver/field/span.h"

namespace supple {

/// The field's rows at a fixed set of points, built once: φ_j and ∇φ_j of the particles that
/// reach each point. With them f(x) = x + Σ φ_j u_j and F = I + Σ u_j ∇φ_jᵀ.
///
/// A point outside all supports takes the affine map of the particle nearest to it.
///
/// Where particles do not span space, the gradients are those of the linear fit, passing smoothly
/// into ∇φ_j where they do: they carry exactly the part P of an affine map (`short_spans`), and F
/// is completed by a rotation.
struct SUPPLE_API Samples {
  Points points;                   ///< x_k [m], n×3
  std::vector<int> row_starts{0};  ///< n+1 offsets into the arrays below
  std::vector<int> particles;
  std::vector<double> values;   ///< φ_j
  std::vector<Vec3> gradients;  ///< ∇φ_j [1/m]; empty where only values were asked for

  struct ShortSpan {
    Index sample;
    Span span;
  };
  std::vector<ShortSpan> short_spans;  ///< of the few samples whose particles do not span space,
                                       ///< ascending; none where only values were asked for

  long uncovered = 0;  ///< points outside all supports
  long rank_lost = 0;  ///< points whose particles do not span the basis

  Index size() const { return points.rows(); }
  int row_begin(Index k) const { return row_starts[static_cast<std::size_t>(k)]; }
  int row_end(Index k) const { return row_starts[static_cast<std::size_t>(k) + 1]; }

  /// u(x_k) [m], for particle displacements u [m] N×3.
  Vec3 displacement(Index k, const Points& u) const;
  /// f(x_k) = x_k + u(x_k) [m].
  Vec3 position(Index k, const Points& u) const {
    return points.row(k).transpose() + displacement(k, u);
  }
  /// F(x_k) = I + ∇u(x_k), completed where the span is short.
  Mat3 deformation_gradient(Index k, const Points& u) const;
  /// I + Σ u_j ∇φ_jᵀ, not completed.
  Mat3 plain_gradient(Index k, const Points& u) const;
  /// How a plain gradient at sample k is completed; nothing where the span is full.
  std::optional<Completion> completion(Index k, const Mat3& plain) const;
};

enum class SampleContent { values, values_and_gradients };

/// Builds the rows at `points` [m] n×3, by all threads; the result does not depend on them.
SUPPLE_API Samples sample_field(const MovingLeastSquares<3>& field, const Points& points,
                                SampleContent content);

/// The smallest det F over samples with gradients, where it is, and how many are ≤ 0.
struct InversionCount {
  double min_det_F = 1;
  Vec3 worst = Vec3::Zero();  ///< the sample [m] with the smallest, at rest
  long inverted = 0;
};
SUPPLE_API InversionCount count_inversions(const Samples& samples, const Points& u);

}  // namespace supple
