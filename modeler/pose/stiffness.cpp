#include "modeler/pose/stiffness.h"

#include <algorithm>

namespace supple {

Eigen::VectorXd stiffness_factors(std::span<const StiffnessSpec> parts,
                                  const SelectionContext& context, const SurfaceSamples& surface,
                                  const Points& points) {
  if (parts.empty()) return {};
  Eigen::VectorXd factors = Eigen::VectorXd::Ones(points.rows());
  for (const StiffnessSpec& part : parts) {
    const std::vector<char> inside =
        select_mask(part.select, context, stand_ins(points, surface, part.select));
    if (std::count(inside.begin(), inside.end(), 1) == 0)
      complain_of_nothing(part.select, context.box, "the points where the energy is summed");
    for (Index k = 0; k < points.rows(); ++k)
      if (inside[static_cast<std::size_t>(k)]) factors[k] *= part.times;
  }
  return factors;
}

}  // namespace supple
