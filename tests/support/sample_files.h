#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/mesh/mesh_files.h"
#include "solver/core/random.h"
#include "tests/support/shapes.h"
#include "tests/support/temporary_folder.h"

/// Small files of every format that is read, for tests of all of them.
namespace supple {

struct SampleFile {
  std::string name, bytes;
  bool tells_its_length = true;  ///< false: what ends with a line may be all there is
};

/// A box with all that a mesh may carry at its vertices and corners.
inline Mesh colored_box() {
  Mesh mesh = make_box({1.25, 2, 3});
  mesh.colors.values.setConstant(8, 4, 0.4);
  mesh.texcoords.values = Eigen::VectorXd::LinSpaced(10, -0.7, 1.3).reshaped(5, 2);
  for (int corner = 0; corner < 24; ++corner) mesh.texcoords.corners.push_back(corner % 5);
  return mesh;
}

/// The same with groups and materials.
inline Mesh tagged_box() {
  Mesh mesh = colored_box();
  mesh.tags = {{FaceTag::Kind::group, "g", 0}, {FaceTag::Kind::material, "m", 3}};
  mesh.material_libraries = {"a.mtl"};
  return mesh;
}

inline Mesh cloud_with_all() {
  Mesh cloud;
  cloud.positions.resize(9, 3);
  Random random(9);
  for (double& coordinate : cloud.positions.reshaped()) coordinate = random.uniform(-1, 1);
  cloud.normals.values = cloud.positions.rowwise().normalized();
  cloud.colors.values.setConstant(9, 4, 0.4);
  cloud.colors.values.col(3).setOnes();
  cloud.radii = Eigen::VectorXd::LinSpaced(9, 0.5, 1);
  return cloud;
}

/// The bytes that write_mesh makes of `mesh`.
inline std::string written(const Mesh& mesh, std::string_view name) {
  const TemporaryFolder folder;
  write_mesh(mesh, folder / name);
  return bytes_of(folder / name);
}

/// A format is in the suite where it has its lines here.
inline std::vector<SampleFile> sample_files() {
  constexpr bool by_lines = false;
  const Mesh box = colored_box(), cloud = cloud_with_all();
  return {
      {"a.obj", written(tagged_box(), "a.obj"), by_lines},
      {"a.off", written(box, "a.off") + "\n"},
      {"a.ply", written(box, "a.ply")},
      {"ascii.ply",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
       "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
       "0 0 0\n1.25 0 0\n0 1 0\n3 0 1 2\n\n \n"},
      {"a.stl", written(box, "a.stl")},
      {"ascii.stl",
       "solid box\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
       "vertex 0 1 0\nendloop\nendfacet\nendsolid box\n\n"},
      {"a.glb", written(tagged_box(), "a.glb")},
      {"a.gltf", written(tagged_box(), "a.gltf")},
      {"cloud.ply", written(cloud, "a.ply")},
      {"a.pcd", written(cloud, "a.pcd")},
      {"ascii.pcd",
       "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2\nPOINTS 2\nDATA ascii\n"
       "0.5 0.25 0.125\n1.25 2.5 nan\n\n \n"},
      {"a.pwn", written(cloud, "a.pwn") + "\n"},
      {"a.xyz", written(cloud, "a.xyz"), by_lines},
  };
}

}  // namespace supple
