#pragma once

#include <gtest/gtest.h>

#include "io/mesh/mesh.h"

namespace supple {

/// Largest difference of two matrices over the largest entry; infinite where the shapes differ.
template <class A, class B>
double relative_difference(const A& a, const B& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols()) return std::numeric_limits<double>::infinity();
  if (a.size() == 0) return 0;
  const double size = a.cwiseAbs().maxCoeff();
  return (a - b).cwiseAbs().maxCoeff() / (size > 0 ? size : 1);
}

/// The value that every corner takes (NaN-free: a corner without one has `none`), or, for a
/// point cloud, every vertex.
template <int Columns>
auto corner_values(const Mesh& mesh, const Attribute<Columns>& attribute) {
  constexpr double none = -12345;
  auto values = attribute.values;
  if (mesh.face_count() == 0 || attribute.empty()) return values;
  const auto& rows = attribute.per_corner() ? attribute.corners : mesh.face_vertices;
  values.setConstant(static_cast<Index>(rows.size()), Columns, none);
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (rows[k] >= 0) values.row(static_cast<Index>(k)) = attribute.values.row(rows[k]);
  return values;
}

/// Same vertices and faces in the same order, to a relative `tolerance` in positions.
inline void expect_same_shape(const Mesh& a, const Mesh& b, double tolerance) {
  EXPECT_LE(relative_difference(a.positions, b.positions), tolerance);
  EXPECT_EQ(a.face_starts, b.face_starts);
  EXPECT_EQ(a.face_vertices, b.face_vertices);
}

inline void expect_same_tags(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.material_libraries, b.material_libraries);
  ASSERT_EQ(a.tags.size(), b.tags.size());
  for (std::size_t i = 0; i < a.tags.size(); ++i) {
    EXPECT_EQ(a.tags[i].kind, b.tags[i].kind) << i;
    EXPECT_EQ(a.tags[i].name, b.tags[i].name) << i;
    EXPECT_EQ(a.tags[i].first_face, b.tags[i].first_face) << i;
  }
}

inline void expect_same_values(const Mesh& a, const Mesh& b, double tolerance) {
  EXPECT_LE(relative_difference(corner_values(a, a.normals), corner_values(b, b.normals)),
            tolerance);
  EXPECT_LE(relative_difference(corner_values(a, a.texcoords), corner_values(b, b.texcoords)),
            tolerance);
  EXPECT_LE(relative_difference(a.colors.values, b.colors.values), tolerance);
  EXPECT_LE(relative_difference(a.radii, b.radii), tolerance);
}

/// Equal in all that a mesh has but its notes.
inline void expect_same_mesh(const Mesh& a, const Mesh& b, double tolerance) {
  expect_same_shape(a, b, tolerance);
  expect_same_values(a, b, tolerance);
  expect_same_tags(a, b);
}

}  // namespace supple
