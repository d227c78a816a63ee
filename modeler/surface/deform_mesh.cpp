#include "modeler/surface/deform_mesh.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <map>

namespace supple {
namespace {

/// Two normals nearer than this are one: beyond what a file in single precision can tell apart.
constexpr double same_normal = 1e-7;

/// Carries normals that face corners share. A normal keeps its row for the first vertex that
/// uses it; other vertices get rows of their own where they turn it differently.
class CornerNormals {
 public:
  CornerNormals(const Attribute<3>& rest, const std::vector<Mat3>& gradients)
      : gradients_(gradients) {
    values_.reserve(static_cast<std::size_t>(rest.values.rows()));
    for (Index i = 0; i < rest.values.rows(); ++i)
      values_.push_back(rest.values.row(i).transpose());
    rest_ = values_;
    taken_.resize(values_.size(), false);
  }

  int carry(int vertex, int normal) {
    const auto [known, is_new] = rows_.try_emplace({vertex, normal}, normal);
    if (!is_new) return known->second;
    const auto at = static_cast<std::size_t>(normal);
    const Vec3 carried = carry_normal(gradients_[static_cast<std::size_t>(vertex)], rest_[at]);
    if (!taken_[at]) {
      taken_[at] = true;
      values_[at] = carried;
    } else if ((values_[at] - carried).norm() > same_normal * rest_[at].norm()) {
      known->second = static_cast<int>(values_.size());
      values_.push_back(carried);
    }
    return known->second;
  }

  Points values() const {
    Points points(static_cast<Index>(values_.size()), 3);
    for (std::size_t i = 0; i < values_.size(); ++i)
      points.row(static_cast<Index>(i)) = values_[i].transpose();
    return points;
  }

 private:
  const std::vector<Mat3>& gradients_;
  std::vector<Vec3> rest_, values_;
  std::vector<bool> taken_;
  std::map<std::pair<int, int>, int> rows_;
};

Mat3 cofactor(const Mat3& F) {
  Mat3 result;
  result.col(0) = F.col(1).cross(F.col(2));
  result.col(1) = F.col(2).cross(F.col(0));
  result.col(2) = F.col(0).cross(F.col(1));
  return result;
}

/// Zero where the mesh has none of its vertices.
Vec3 vertex_normal(const Mesh& mesh, Index vertex) {
  if (mesh.normals.empty() || mesh.normals.per_corner()) return Vec3::Zero();
  return mesh.normals.values.row(vertex).transpose();
}

}  // namespace

Vec3 carry_normal(const Mat3& F, const Vec3& normal) {
  const Vec3 carried = cofactor(F) * normal;
  const double length = carried.norm();
  return length > 0 ? Vec3(carried * (normal.norm() / length)) : Vec3(Vec3::Zero());
}

double carry_radius(const Mat3& F, const Vec3& normal, double radius) {
  const double length = normal.norm();
  if (length == 0) return radius * std::cbrt(std::abs(F.determinant()));
  return radius * std::sqrt((cofactor(F) * normal).norm() / length);
}

Mesh deform_mesh(const Mesh& mesh, const DeformedSurface& surface) {
  Mesh deformed = mesh;
  deformed.positions = surface.positions;
  for (Index i = 0; i < mesh.radii.size(); ++i)
    deformed.radii[i] = carry_radius(surface.gradients[static_cast<std::size_t>(i)],
                                     vertex_normal(mesh, i), mesh.radii[i]);
  if (mesh.normals.empty()) return deformed;
  if (!mesh.normals.per_corner()) {
    for (Index i = 0; i < mesh.normals.values.rows(); ++i)
      deformed.normals.values.row(i) = carry_normal(surface.gradients[static_cast<std::size_t>(i)],
                                                    mesh.normals.values.row(i).transpose())
                                           .transpose();
    return deformed;
  }
  CornerNormals normals(mesh.normals, surface.gradients);
  for (std::size_t corner = 0; corner < mesh.face_vertices.size(); ++corner)
    if (mesh.normals.corners[corner] >= 0)
      deformed.normals.corners[corner] =
          normals.carry(mesh.face_vertices[corner], mesh.normals.corners[corner]);
  deformed.normals.values = normals.values();
  return deformed;
}

}  // namespace supple
