#include "io/mesh/number_types.h"

namespace supple {

bool needs_double(const Points& points) {
  if (points.rows() == 0) return false;
  const double diagonal = bounding_box(points).diagonal();
  const double largest = points.cwiseAbs().maxCoeff();
  // The bounds also keep float32 away from its overflow and its denormals.
  return largest * 0x1p-24 > diagonal * 0x1p-22 || largest > 0x1p100 || diagonal < 0x1p-80;
}

bool are_floats(const Points& points) {
  return points.cast<float>().cast<double>() == points;
}

bool are_bytes(const Attribute<4>& colors) {
  const auto scaled = colors.values.array() * 255;
  return ((scaled - scaled.round()).abs() < 1e-4).all();
}

}  // namespace supple
