#include "io/mesh/mesh_formats.h"
#include "io/mesh/text_output.h"

namespace supple {

void write_off(const Mesh& mesh, OutputFile& file) {
  const bool texcoords = !mesh.texcoords.empty() && !mesh.texcoords.per_corner();
  const bool normals = !mesh.normals.empty() && !mesh.normals.per_corner();
  const bool colors = !mesh.colors.empty();
  print(file, "{}{}{}OFF\n{} {} 0\n", texcoords ? "ST" : "", colors ? "C" : "", normals ? "N" : "",
        mesh.positions.rows(), mesh.face_count());
  for (Index i = 0; i < mesh.positions.rows(); ++i) {
    const auto x = mesh.positions.row(i);
    print(file, "{} {} {}", x[0], x[1], x[2]);
    if (normals) print_numbers(file, mesh.normals.values.row(i));
    if (colors) print_numbers(file, mesh.colors.values.row(i));
    if (texcoords) print_numbers(file, mesh.texcoords.values.row(i));
    file.write("\n");
  }
  for (int face = 0; face < mesh.face_count(); ++face) {
    print(file, "{}", mesh.face_size(face));
    for (int corner = mesh.face_starts[face]; corner < mesh.face_starts[face + 1]; ++corner)
      print(file, " {}", mesh.face_vertices[corner]);
    file.write("\n");
  }
}

}  // namespace supple
