#pragma once

#include <span>

#include "io/scene/pose_spec.h"
#include "modeler/domain/select.h"

namespace supple {

/// Factors on the rigidity and volume of `points` [user's coordinates], n: the product of `times`
/// over the parts that hold a point; empty where there are no parts. `surface` [user's
/// coordinates] stands in for points where a part is named by vertices or groups.
/// Errors: UsageError for a part that holds none of the points.
Eigen::VectorXd stiffness_factors(std::span<const StiffnessSpec> parts,
                                  const SelectionContext& context, const SurfaceSamples& surface,
                                  const Points& points);

}  // namespace supple
