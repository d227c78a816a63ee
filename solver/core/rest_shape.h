#pragma once

#include <vector>

#include "solver/core/types.h"

namespace supple {

/// A closed region of space: what particles fill, and later what bodies collide with.
class Region {
 public:
  virtual ~Region() = default;

  /// Distance to the boundary [m], negative inside.
  virtual double signed_distance(const Vec3& x) const = 0;

  virtual bool contains(const Vec3& x) const = 0;

  /// The boundary point nearest to x [m].
  virtual Vec3 closest_boundary_point(const Vec3& x) const = 0;

  /// How many parts of the region overlap at x inside; 1 where none do.
  virtual int layers(const Vec3&) const { return 1; }

  /// True where the straight way from a to b, both inside, does not leave the region: not even
  /// for the width of a gap whose two walls touch. `layers_at_a` = layers(a).
  virtual bool connects(const Vec3& a, int layers_at_a, const Vec3& b) const = 0;

  /// Distance that straight ways from x inside may go before any of them leaves the region or
  /// crosses a wall, at least [m].
  virtual double clearance(const Vec3& x) const = 0;

  /// Enclosed volume [m³].
  virtual double volume() const = 0;

  virtual Box bounds() const = 0;
};

/// The particles that carry a field, at rest. V_i is a partition of the region's volume.
struct Particles {
  Points positions;             ///< [m], n×3
  Eigen::VectorXd volumes;      ///< [m³], n; their sum is the region's volume
  Eigen::VectorXd supports;     ///< support radii h_i [m], n
  std::vector<Mat3> stretches;  ///< of the supports, as MovingLeastSquares takes them; may be none
  double spacing = 0;           ///< mean distance of neighbours s [m]

  Index size() const { return positions.rows(); }
};

}  // namespace supple
