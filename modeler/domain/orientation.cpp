#include "modeler/domain/orientation.h"

#include <array>
#include <cmath>
#include <vector>

namespace supple {
namespace {

/// Bounds of the rounding of both determinants, over the sum of their terms' magnitudes
/// (Shewchuk 1997, Eq. for ccwerrboundA and o3derrboundA).
constexpr double half_ulp = 0x1p-53;
constexpr double bound_2d = (3 + 16 * half_ulp) * half_ulp;
constexpr double bound_3d = (7 + 56 * half_ulp) * half_ulp;

/// A number and what rounding left out of it.
struct Split {
  double value, rest;
};

Split sum(double a, double b) {
  const double value = a + b, b_part = value - a;
  return {value, (a - (value - b_part)) + (b - b_part)};
}

Split product(double a, double b) {
  const double value = a * b;
  return {value, std::fma(a, b, -value)};
}

/// An exact sum: its terms do not overlap and grow in magnitude, so the last has its sign.
class ExactSum {
 public:
  void add(double x) {
    std::size_t kept = 0;
    for (const double term : terms_) {
      const Split s = sum(x, term);
      x = s.value;
      if (s.rest != 0) terms_[kept++] = s.rest;
    }
    terms_.resize(kept);
    if (x != 0) terms_.push_back(x);
  }

  int sign() const { return terms_.empty() ? 0 : terms_.back() > 0 ? 1 : -1; }

 private:
  std::vector<double> terms_;
};

/// x·y, and times `sign`, for differences x and y.
void add_product(ExactSum& total, double sign, const Split& x, const Split& y) {
  for (const double a : {x.value, x.rest})
    for (const double b : {y.value, y.rest}) {
      if (a == 0 || b == 0) continue;
      const Split ab = product(a, b);
      total.add(sign * ab.value);
      total.add(sign * ab.rest);
    }
}

void add_product(ExactSum& total, double sign, const Split& x, const Split& y, const Split& z) {
  for (const double a : {x.value, x.rest})
    for (const double b : {y.value, y.rest}) {
      if (a == 0 || b == 0) continue;
      const Split ab = product(a, b);
      add_product(total, sign, ab, z);
    }
}

int sign_of(double x) {
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}

int exact_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  std::array<std::array<Split, 3>, 3> rows;
  for (int k = 0; k < 3; ++k) {
    rows[0][k] = sum(a[k], -d[k]);
    rows[1][k] = sum(b[k], -d[k]);
    rows[2][k] = sum(c[k], -d[k]);
  }
  ExactSum total;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3, last = (k + 2) % 3;
    add_product(total, 1, rows[0][k], rows[1][next], rows[2][last]);
    add_product(total, -1, rows[0][k], rows[1][last], rows[2][next]);
  }
  return total.sign();
}

}  // namespace

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 p = a - d, q = b - d, r = c - d;
  const double yz = q.y() * r.z(), zy = q.z() * r.y(), zx = q.z() * r.x(), xz = q.x() * r.z(),
               xy = q.x() * r.y(), yx = q.y() * r.x();
  const double determinant = p.x() * (yz - zy) + p.y() * (zx - xz) + p.z() * (xy - yx);
  const double magnitude = std::abs(p.x()) * (std::abs(yz) + std::abs(zy)) +
                           std::abs(p.y()) * (std::abs(zx) + std::abs(xz)) +
                           std::abs(p.z()) * (std::abs(xy) + std::abs(yx));
  if (magnitude == 0 || std::abs(determinant) > bound_3d * magnitude) return sign_of(determinant);
  return exact_orientation(a, b, c, d);
}

int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d p = a - c, q = b - c;
  const double plus = p.x() * q.y(), minus = p.y() * q.x();
  const double determinant = plus - minus, magnitude = std::abs(plus) + std::abs(minus);
  if (magnitude == 0 || std::abs(determinant) > bound_2d * magnitude) return sign_of(determinant);
  ExactSum total;
  add_product(total, 1, sum(a.x(), -c.x()), sum(b.y(), -c.y()));
  add_product(total, -1, sum(a.y(), -c.y()), sum(b.x(), -c.x()));
  return total.sign();
}

}  // namespace supple
