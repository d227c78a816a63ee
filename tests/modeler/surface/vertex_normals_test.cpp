#include "modeler/surface/vertex_normals.h"

#include <gtest/gtest.h>

#include "modeler/domain/surface_measures.h"
#include "tests/support/shapes.h"

namespace supple {
namespace {

TEST(VertexNormals, AreTheMeanOfTheFacesByArea) {
  const Mesh mesh = make_torus(1, 0.4, 24, 16);
  const Triangles triangles = triangulate(mesh).triangles;
  Points expected = Points::Zero(mesh.positions.rows(), 3);
  for (Index t = 0; t < triangles.rows(); ++t)
    for (const int vertex : triangles.row(t))
      expected.row(vertex) += double_area_normal(mesh.positions, triangles, t).transpose();
  expected.rowwise().normalize();
  FloatPoints normals;
  VertexNormals(triangles, mesh.positions.rows()).compute(mesh.positions.cast<float>(), normals);
  EXPECT_LT((normals.cast<double>() - expected).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(VertexNormals, AreZeroWhereNoFaceIs) {
  const Triangles triangles = Triangles::Zero(1, 3);  // without area, too
  FloatPoints positions = FloatPoints::Random(2, 3), normals;
  VertexNormals(triangles, 2).compute(positions, normals);
  EXPECT_EQ(normals.norm(), 0);
}

}  // namespace
}  // namespace supple
