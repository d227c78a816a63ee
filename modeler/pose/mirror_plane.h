#pragma once

#include "solver/core/types.h"

namespace supple {

/// Reflection across a plane: x − 2 ((x − at)·n) n.
struct MirrorPlane {
  Vec3 normal = Vec3::UnitX();  ///< unit length
  Vec3 at = Vec3::Zero();

  Vec3 point(const Vec3& x) const { return x - 2 * (x - at).dot(normal) * normal; }
  Vec3 direction(const Vec3& v) const { return v - 2 * v.dot(normal) * normal; }

  Points points(const Points& x) const {
    return x - 2 * ((x.rowwise() - at.transpose()) * normal) * normal.transpose();
  }

  /// S F S for a deformation gradient F, with S the reflection of directions.
  Mat3 gradient(const Mat3& F) const {
    const Mat3 S = Mat3::Identity() - 2 * normal * normal.transpose();
    return S * F * S;
  }
};

}  // namespace supple
