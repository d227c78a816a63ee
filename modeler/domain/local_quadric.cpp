#include "modeler/domain/local_quadric.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace supple {

namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// A slope off by 1 counts like a height off by this share of the radius.
constexpr double slope_weight = 0.2;

/// Against bending where points are few, in shares of their weight.
constexpr double stiffness = 1e-5;

constexpr double freedom = 6;

double falloff(const Vec3& d, double radius) {
  const double rest = std::max(0.0, 1 - d.squaredNorm() / (radius * radius));
  return rest * rest + 1e-6;
}

/// Axes: two in the plane, the normal last.
Mat3 frame_about(const Vec3& normal) {
  Mat3 frame;
  frame.col(0) = normal.unitOrthogonal();
  frame.col(1) = normal.cross(frame.col(0));
  frame.col(2) = normal;
  return frame;
}

/// Over the plane of `normal`; `normals` are empty where slopes do not count.
QuadricFit fit_heights(const Points& positions, const Points& normals, const Vec3& normal,
                       std::span<const int> chosen, const Vec3& center, double radius, double far) {
  const Mat3 frame = frame_about(normal);

  // In units of the radius: height = Σ a_k φ_k(u, v), φ = 1, u, v, u², uv, v².
  Mat6 A = Mat6::Zero();
  Vec6 B = Vec6::Zero();
  double weights = 0;
  for (int i : chosen) {
    const Vec3 d = positions.row(i).transpose() - center;
    const Vec3 x = frame.transpose() * d / radius;
    const double weight = falloff(d, radius);
    const double u = x[0], v = x[1];
    Vec6 row;
    row << 1, u, v, u * u, u * v, v * v;
    A += weight * row * row.transpose();
    B += weight * x[2] * row;
    weights += weight;
    if (normals.rows() == 0) continue;
    const Vec3 n = frame.transpose() * normals.row(i).transpose();
    // n_w ∂h/∂u = −n_u, the same for v.
    const double slopes = weight * slope_weight * slope_weight;
    Vec6 along_u, along_v;
    along_u << 0, n[2], 0, 2 * n[2] * u, n[2] * v, 0;
    along_v << 0, 0, n[2], 0, n[2] * u, 2 * n[2] * v;
    A += slopes * (along_u * along_u.transpose() + along_v * along_v.transpose());
    B -= slopes * (n[0] * along_u + n[1] * along_v);
  }
  A.diagonal().array() += stiffness * weights;
  const Vec6 a = A.ldlt().solve(B);

  QuadricFit fit;
  const Vec3 u = frame.col(0), v = frame.col(1);
  const double steepness = std::sqrt(1 + a[1] * a[1] + a[2] * a[2]);
  fit.quadric.center = center;
  fit.quadric.constant = -radius * a[0] / steepness;
  fit.quadric.slope = (normal - a[1] * u - a[2] * v) / steepness;
  fit.quadric.curvature =
      -(a[3] * u * u.transpose() + 0.5 * a[4] * (u * v.transpose() + v * u.transpose()) +
        a[5] * v * v.transpose()) /
      (radius * steepness);

  double squares = 0;
  Index beyond = 0;
  for (int i : chosen) {
    const Vec3 x = positions.row(i);
    const double distance = fit.quadric.value(x);
    squares += falloff(x - center, radius) * distance * distance;
    if (std::abs(distance) > far) ++beyond;
  }
  const auto count = static_cast<double>(chosen.size());
  fit.rms = std::sqrt(squares / weights * count / std::max(count - freedom, 1.0));
  fit.beyond = static_cast<double>(beyond) / count;
  return fit;
}

}  // namespace

QuadricFit fit_quadric(const Points& positions, const Points& normals, std::span<const int> chosen,
                       const Vec3& center, double radius, double far) {
  Vec3 sum = Vec3::Zero();
  for (int i : chosen)
    sum += falloff(positions.row(i).transpose() - center, radius) * normals.row(i).transpose();
  const Vec3 normal =
      sum.norm() > 1e-9 ? Vec3(sum.normalized()) : Vec3(normals.row(chosen[0]).transpose());
  return fit_heights(positions, normals, normal, chosen, center, radius, far);
}

QuadricFit fit_quadric(const Points& positions, const Vec3& normal, std::span<const int> chosen,
                       const Vec3& center, double radius, double far) {
  return fit_heights(positions, {}, normal, chosen, center, radius, far);
}

}  // namespace supple
