#include "tests/bench/references/as_rigid_as_possible.h"

#include <stdexcept>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_deformation.h>

namespace supple::bench {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Deformation = CGAL::Surface_mesh_deformation<CgalMesh>;

CgalMesh cgal_mesh(const Points& vertices, const Triangles& triangles) {
  CgalMesh mesh;
  std::vector<CgalMesh::Vertex_index> index;
  for (Index i = 0; i < vertices.rows(); ++i)
    index.push_back(mesh.add_vertex({vertices(i, 0), vertices(i, 1), vertices(i, 2)}));
  for (Index f = 0; f < triangles.rows(); ++f)
    mesh.add_face(index[static_cast<std::size_t>(triangles(f, 0))],
                  index[static_cast<std::size_t>(triangles(f, 1))],
                  index[static_cast<std::size_t>(triangles(f, 2))]);
  return mesh;
}

}  // namespace

struct AsRigidAsPossible::Implementation {
  CgalMesh mesh;
  Deformation deformation;
  std::vector<CgalMesh::Vertex_index> controls;

  Implementation(const Points& vertices, const Triangles& triangles)
      : mesh(cgal_mesh(vertices, triangles)), deformation(mesh) {}
};

AsRigidAsPossible::AsRigidAsPossible(const Points& vertices, const Triangles& triangles,
                                     const std::vector<int>& controls)
    : implementation_(std::make_unique<Implementation>(vertices, triangles)) {
  Implementation& here = *implementation_;
  for (const auto vertex : here.mesh.vertices()) here.deformation.insert_roi_vertex(vertex);
  for (const int control : controls) {
    here.controls.emplace_back(static_cast<CgalMesh::size_type>(control));
    here.deformation.insert_control_vertex(here.controls.back());
  }
  if (!here.deformation.preprocess()) throw std::runtime_error("CGAL cannot factor this mesh");
}

AsRigidAsPossible::~AsRigidAsPossible() = default;

void AsRigidAsPossible::deform(const Points& targets, int iterations) {
  Implementation& here = *implementation_;
  for (std::size_t k = 0; k < here.controls.size(); ++k) {
    const auto row = targets.row(static_cast<Index>(k));
    here.deformation.set_target_position(here.controls[k], {row[0], row[1], row[2]});
  }
  here.deformation.deform(static_cast<unsigned>(iterations), 0);
}

Points AsRigidAsPossible::positions() const {
  const CgalMesh& mesh = implementation_->mesh;
  Points positions(static_cast<Index>(mesh.number_of_vertices()), 3);
  Index row = 0;
  for (const auto vertex : mesh.vertices()) {
    const auto& at = mesh.point(vertex);
    positions.row(row++) << at.x(), at.y(), at.z();
  }
  return positions;
}

}  // namespace supple::bench
