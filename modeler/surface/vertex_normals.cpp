#include "modeler/surface/vertex_normals.h"

#include <Eigen/Geometry>
#include <functional>
#include <numeric>

#include "solver/core/parallel.h"

namespace supple {
namespace {

constexpr Index rows_per_chunk = 8192;

}  // namespace

VertexNormals::VertexNormals(const Triangles& triangles, Index vertices)
    : triangles_(triangles),
      starts_(static_cast<std::size_t>(vertices) + 1, 0),
      around_(static_cast<std::size_t>(triangles.size())),
      face_normals_(triangles.rows(), 3) {
  for (Index corner = 0; corner < triangles.size(); ++corner)
    ++starts_[static_cast<std::size_t>(triangles.data()[corner]) + 1];
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  std::vector<int> next(starts_.begin(), starts_.end() - 1);
  for (Index face = 0; face < triangles.rows(); ++face)
    for (const int vertex : triangles.row(face)) {
      int& at = next[static_cast<std::size_t>(vertex)];
      around_[static_cast<std::size_t>(at++)] = static_cast<int>(face);
    }
}

void VertexNormals::compute(const FloatPoints& positions, FloatPoints& normals) {
  const auto derive_faces = [&](Index begin, Index end) {
    for (Index face = begin; face < end; ++face) {
      const Eigen::Vector3f a = positions.row(triangles_(face, 0)),
                            b = positions.row(triangles_(face, 1)),
                            c = positions.row(triangles_(face, 2));
      face_normals_.row(face) = (b - a).cross(c - a).transpose();
    }
  };
  parallel_chunks(triangles_.rows(), rows_per_chunk, std::cref(derive_faces));

  normals.resize(positions.rows(), 3);
  const auto sum_vertices = [&](Index begin, Index end) {
    for (Index vertex = begin; vertex < end; ++vertex) {
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      const auto at = static_cast<std::size_t>(vertex);
      for (int k = starts_[at]; k < starts_[at + 1]; ++k)
        sum += face_normals_.row(around_[static_cast<std::size_t>(k)]).transpose();
      const float length = sum.norm();
      normals.row(vertex) = length > 0 ? Eigen::RowVector3f(sum.transpose() / length)
                                       : Eigen::RowVector3f(Eigen::RowVector3f::Zero());
    }
  };
  parallel_chunks(positions.rows(), rows_per_chunk, std::cref(sum_vertices));
}

}  // namespace supple
