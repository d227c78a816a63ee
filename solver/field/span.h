#pragma once

#include "solver/core/export.h"
#include "solver/core/types.h"

namespace supple {

/// The directions in which the particles near a point lie apart, and the share of each that their
/// gradients carry: P = Σ s a aᵀ is what Σ x_j ∇φ_jᵀ gives.
struct Span {
  Mat3 axes = Mat3::Identity();  ///< a, orthonormal columns, right-handed, the widest first
  Vec3 shares = Vec3::Ones();    ///< s ∈ [0, 1], falling

  bool full() const { return shares.minCoeff() >= 1; }

  /// I − P.
  Mat3 missing() const { return axes * (Vec3::Ones() - shares).asDiagonal() * axes.transpose(); }
};

/// A deformation gradient whose particles do not span space, completed by a rotation.
///
/// The carried part A = Σ f(x_j) ∇φ_jᵀ knows only how the span moves. With the span's axes V and
/// shares S let A V = Q T, Q a rotation and T upper triangular with a positive diagonal as far as
/// A decides it; then F = Q (T + I − S) Vᵀ = A + Q (I − S) Vᵀ. Particles in a plane leave the third
/// axis to the plane's unit normal, so det F is the area's factor; on a line the others follow by
/// the smallest rotation. A rotation of all particles, A = R P, gives F = R whatever the shares
/// are, and F passes smoothly into A where the span becomes full.
class SUPPLE_API Completion {
 public:
  Completion(const Mat3& carried, const Span& span);

  const Mat3& F() const { return F_; }

  /// ∂E/∂A from ∂E/∂F.
  Mat3 by_carried(const Mat3& by_F) const;

 private:
  /// Shorter carried axes have no direction.
  static constexpr double least_length = 1e-9;

  /// An axis across the first one, turned by the smallest rotation that takes that to Q's.
  Vec3 turned_with_first(const Vec3& axis) const;

  Span span_;
  Mat3 Q_, F_;
  Mat3 T_ = Mat3::Zero();     ///< what of it decides Q
  Vec3 turn_ = Vec3::Zero();  ///< axis × sine of the smallest rotation, over 1 + cosine
};

}  // namespace supple
