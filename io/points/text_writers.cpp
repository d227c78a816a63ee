#include <cmath>

#include "io/errors.h"
#include "io/mesh/number_types.h"
#include "io/mesh/text_output.h"
#include "io/points/point_formats.h"

namespace supple {
namespace {

bool has_normals(const Mesh& mesh) {
  return !mesh.normals.empty() && !mesh.normals.per_corner();
}

/// Readers take three whole numbers, one of them above 1, for a color of bytes.
bool colors_as_bytes(const Mesh& mesh) {
  return are_bytes(mesh.colors) && mesh.colors.values.leftCols<3>().maxCoeff() * 255 > 1.5;
}

void print_position(OutputFile& file, const Mesh& mesh, Index point) {
  const auto p = mesh.positions.row(point);
  print(file, "{} {} {}", p[0], p[1], p[2]);
}

}  // namespace

void write_xyz(const Mesh& mesh, OutputFile& file) {
  const bool normals = has_normals(mesh), colors = !mesh.colors.empty();
  const bool bytes = colors && colors_as_bytes(mesh);
  if (normals || colors)
    print(file, "# x y z{}{}\n", normals ? " nx ny nz" : "", colors ? " r g b" : "");
  for (Index i = 0; i < mesh.positions.rows(); ++i) {
    print_position(file, mesh, i);
    if (normals) print_numbers(file, mesh.normals.values.row(i));
    if (bytes)
      print_numbers(file, (255 * mesh.colors.values.row(i).head<3>()).array().round().matrix());
    else if (colors)
      print_numbers(file, mesh.colors.values.row(i).head<3>());
    file.write("\n");
  }
}

void write_pwn(const Mesh& mesh, OutputFile& file) {
  if (!has_normals(mesh))
    throw OutputError(
        fmt::format("{}: cannot write: PWN needs a normal for every point; allowed: "
                    "ply, pcd, xyz",
                    file.path().string()));
  print(file, "{}\n", mesh.positions.rows());
  for (Index i = 0; i < mesh.positions.rows(); ++i) {
    print_position(file, mesh, i);
    print_numbers(file, mesh.normals.values.row(i));
    file.write("\n");
  }
}

}  // namespace supple
