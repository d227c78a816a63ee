#include "io/mesh/mesh_formats.h"
#include "io/mesh/plain_name.h"
#include "io/mesh/text_output.h"

namespace supple {
namespace {

std::string_view keyword(FaceTag::Kind kind) {
  switch (kind) {
    case FaceTag::Kind::object:
      return "o";
    case FaceTag::Kind::group:
      return "g";
    case FaceTag::Kind::smoothing:
      return "s";
    case FaceTag::Kind::material:
      return "usemtl";
  }
  return "g";
}

/// The number of an attribute's value at a corner, counted from 1; 0: none.
template <int Columns>
int value_number(const Attribute<Columns>& attribute, const Mesh& mesh, int corner) {
  if (attribute.empty()) return 0;
  return 1 + (attribute.per_corner() ? attribute.corners[corner] : mesh.face_vertices[corner]);
}

void write_corner(const Mesh& mesh, int corner, OutputFile& file) {
  const int vertex = mesh.face_vertices[corner] + 1;
  const int texcoord = value_number(mesh.texcoords, mesh, corner);
  const int normal = value_number(mesh.normals, mesh, corner);
  if (texcoord && normal)
    print(file, " {}/{}/{}", vertex, texcoord, normal);
  else if (texcoord)
    print(file, " {}/{}", vertex, texcoord);
  else if (normal)
    print(file, " {}//{}", vertex, normal);
  else
    print(file, " {}", vertex);
}

void write_vertices(const Mesh& mesh, OutputFile& file) {
  for (Index i = 0; i < mesh.positions.rows(); ++i) {
    file.write("v");
    print_numbers(file, mesh.positions.row(i));
    if (!mesh.colors.empty()) print_numbers(file, mesh.colors.values.row(i).head<3>());
    file.write("\n");
  }
}

template <int Columns>
void write_values(std::string_view keyword, const Attribute<Columns>& attribute, OutputFile& file) {
  for (Index i = 0; i < attribute.values.rows(); ++i) {
    file.write(keyword);
    print_numbers(file, attribute.values.row(i));
    file.write("\n");
  }
}

}  // namespace

void write_obj(const Mesh& mesh, OutputFile& file) {
  for (const std::string& library : mesh.material_libraries)
    print(file, "mtllib {}\n", plain_name(library));
  write_vertices(mesh, file);
  write_values("vt", mesh.texcoords, file);
  write_values("vn", mesh.normals, file);
  auto tag = mesh.tags.begin();
  for (int face = 0; face <= mesh.face_count(); ++face) {
    for (; tag != mesh.tags.end() && tag->first_face == face; ++tag)
      print(file, "{} {}\n", keyword(tag->kind), plain_name(tag->name));
    if (face == mesh.face_count()) break;
    file.write("f");
    for (int corner = mesh.face_starts[face]; corner < mesh.face_starts[face + 1]; ++corner)
      write_corner(mesh, corner, file);
    file.write("\n");
  }
}

}  // namespace supple
