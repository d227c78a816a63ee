#include "solver/field/span.h"

#include <Eigen/Geometry>

namespace supple {

Completion::Completion(const Mat3& carried, const Span& span)
    : span_(span), Q_(span.axes), F_(carried) {
  const Mat3 image = carried * span.axes;
  const double length = image.col(0).norm();
  if (length > least_length) {
    T_(0, 0) = length;
    Q_.col(0) = image.col(0) / length;
    T_(0, 1) = Q_.col(0).dot(image.col(1));
    const Vec3 across = image.col(1) - T_(0, 1) * Q_.col(0);
    const double width = across.norm();
    if (width > least_length) {
      T_(1, 1) = width;
      Q_.col(1) = across / width;
    } else {
      const Vec3 from = span.axes.col(0);
      const double cosine = from.dot(Q_.col(0));
      if (cosine > -1 + least_length) turn_ = from.cross(Q_.col(0)) / (1 + cosine);
      Q_.col(1) = turned_with_first(span.axes.col(1));
    }
    Q_.col(2) = Q_.col(0).cross(Q_.col(1));
  }
  F_ += Q_ * (Vec3::Ones() - span.shares).asDiagonal() * span.axes.transpose();
}

/// w + k×w + k×(k×w)/(1 + c) with k = turn·(1 + c); c = −1: half a turn about w itself.
Vec3 Completion::turned_with_first(const Vec3& axis) const {
  const double cosine = span_.axes.col(0).dot(Q_.col(0));
  const Vec3 half = turn_.cross(axis);
  return axis + (1 + cosine) * (half + turn_.cross(half));
}

Mat3 Completion::by_carried(const Mat3& by_F) const {
  if (!(T_(0, 0) > 0)) return by_F;
  // δQ = Q Ω. Ω is skew, and below the diagonal Qᵀ δA V = Ω T + δT has no δT.
  const Mat3 by_Q = by_F * span_.axes * (Vec3::Ones() - span_.shares).asDiagonal();
  const Mat3 M = Q_.transpose() * by_Q;
  const double by_10 = M(1, 0) - M(0, 1), by_20 = M(2, 0) - M(0, 2), by_21 = M(2, 1) - M(1, 2);
  Mat3 Z = Mat3::Zero();
  if (T_(1, 1) > 0) {
    Z(1, 0) = by_10 / T_(0, 0);
    Z(2, 0) = (by_20 - by_21 * T_(0, 1) / T_(1, 1)) / T_(0, 0);
    Z(2, 1) = by_21 / T_(1, 1);
  } else {
    // The smallest rotation spins about the first axis: Ω_21 = −turn·δq_0.
    Z(1, 0) = (by_10 - by_21 * turn_.dot(Q_.col(1))) / T_(0, 0);
    Z(2, 0) = (by_20 - by_21 * turn_.dot(Q_.col(2))) / T_(0, 0);
  }
  return by_F + Q_ * Z * span_.axes.transpose();
}

}  // namespace supple
