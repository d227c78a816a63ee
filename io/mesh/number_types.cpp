#include "io/mesh/number_types.h"

namespace supple {

bool needs_double(const Mesh& mesh) {
  const Points& x = mesh.positions;
  if (x.rows() == 0) return false;
  const double diagonal = bounding_box(x).diagonal(), largest = x.cwiseAbs().maxCoeff();
  // The bounds also keep float32 away from its overflow and its denormals.
  if (largest * 0x1p-24 > diagonal * 0x1p-22 || largest > 0x1p100 || diagonal < 0x1p-80)
    return true;
  return mesh.face_count() == 0 && x.cast<float>().cast<double>() != x;
}

bool are_bytes(const Attribute<4>& colors) {
  const auto scaled = colors.values.array() * 255;
  return ((scaled - scaled.round()).abs() < 1e-4).all();
}

}  // namespace supple
