#pragma once

#include <Eigen/Core>

namespace supple {

using Index = Eigen::Index;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// One point, vector or displacement a row, n×3.
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// As Points, with a zero behind each: a row fills one vector register.
using PaddedPoints = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;

inline PaddedPoints padded(const Points& points) {
  PaddedPoints out = PaddedPoints::Zero(points.rows(), 4);
  out.leftCols<3>() = points;
  return out;
}

/// Three vertex indices a row, n×3, counter-clockwise seen from outside.
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Axis-aligned box; born empty (lower > upper).
struct Box {
  Vec3 lower = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 upper = Vec3::Constant(-std::numeric_limits<double>::infinity());

  bool empty() const { return (lower.array() > upper.array()).any(); }
  Vec3 center() const { return 0.5 * (lower + upper); }
  Vec3 size() const { return upper - lower; }
  double diagonal() const { return empty() ? 0.0 : size().norm(); }
  void extend(const Vec3& x) {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
};

inline Box bounding_box(const Points& points) {
  Box box;
  for (Index i = 0; i < points.rows(); ++i) box.extend(points.row(i).transpose());
  return box;
}

}  // namespace supple
