#pragma once

#include <vector>

#include "solver/core/rest_shape.h"

namespace supple {

/// How thick a region is below its surface: from points of the boundary straight inward to where
/// the way leaves the region again (the shape diameter along the normal).
class Thickness {
 public:
  /// Thicknesses [m] and the area that each stands for [m²].
  Thickness(const std::vector<double>& values, const std::vector<double>& areas);

  /// All lengths times `factor`.
  Thickness scaled(double factor) const;

  bool empty() const { return sorted_.empty(); }

  /// The thickness that `share` of the area stays below [m].
  double quantile(double share) const;

  /// Share of the area that is thinner than `length` [m].
  double share_below(double length) const;

 private:
  struct Entry {
    double value, area_up_to;  ///< of this and all thinner ones, over the whole
  };
  std::vector<Entry> sorted_;
};

/// At `places` [m] n×3 on or near the region's boundary, each standing for one of `areas` [m²].
/// Places that have the inside on both sides, or on none, do not count.
Thickness measure_thickness(const Region& region, const Points& places,
                            const Eigen::VectorXd& areas);

}  // namespace supple
