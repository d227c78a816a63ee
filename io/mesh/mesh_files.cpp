#include "io/mesh/mesh_files.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "io/gltf/gltf_formats.h"
#include "io/gltf/gltf_parts.h"
#include "io/import/import_mesh.h"
#include "io/mesh/mesh_checks.h"
#include "io/mesh/mesh_formats.h"
#include "io/mesh/number_types.h"
#include "io/mesh/plain_name.h"
#include "io/mesh/text_scanner.h"
#include "io/points/point_formats.h"

namespace supple {

namespace fs = std::filesystem;

namespace {

enum Holds : unsigned {
  holds_faces = 1,
  holds_polygons = 2,
  holds_tags = 4,
  holds_normals = 8,
  holds_corner_normals = 16,
  holds_texcoords = 32,
  holds_corner_texcoords = 64,
  holds_colors = 128,
  holds_fine_colors = 256,
  holds_alpha = 512,
  holds_radii = 1024,
  holds_objects = 2048,    ///< objects and materials, of all the tags
  holds_materials = 4096,  ///< what the materials of glTF are, not their names alone
  doubles_corners = 8192,  ///< holds values per corner at the price of more vertices
  holds_vertex_values = holds_normals | holds_texcoords | holds_colors | holds_fine_colors,
  gltf_holds = holds_faces | holds_vertex_values | holds_alpha | holds_objects | holds_materials |
               doubles_corners,
};

struct MeshFormat {
  std::string_view name;  ///< the extension
  Mesh (*read)(const FileBytes&);
  void (*write)(const Mesh&, OutputFile&);
  unsigned holds;
};

constexpr std::array<MeshFormat, 9> known_formats = {{
    {"obj", read_obj, write_obj,
     holds_faces | holds_polygons | holds_tags | holds_corner_normals | holds_corner_texcoords |
         holds_vertex_values},
    {"off", read_off, write_off, holds_faces | holds_polygons | holds_vertex_values | holds_alpha},
    {"ply", read_ply, write_ply,
     holds_faces | holds_polygons | holds_corner_texcoords | holds_vertex_values | holds_alpha |
         holds_radii},
    {"stl", read_stl, write_stl, holds_faces},
    {"glb", read_gltf, write_glb, gltf_holds},
    {"gltf", read_gltf, write_gltf, gltf_holds},
    {"pcd", read_pcd, write_pcd, holds_normals | holds_colors | holds_alpha | holds_radii},
    {"pwn", read_pwn, write_pwn, holds_normals},
    {"xyz", read_xyz, write_xyz, holds_normals | holds_colors | holds_fine_colors},
}};

const MeshFormat* format_of(const fs::path& path) {
  const std::string extension = lower_case(path.extension().string());
  for (const MeshFormat& format : known_formats)
    if (extension == fmt::format(".{}", format.name)) return &format;
  return nullptr;
}

/// By the first word; nullptr where it is none that a mesh file begins with.
const MeshFormat* recognize(const FileBytes& file) {
  const auto format = [](std::string_view name) { return format_of(fmt::format("x.{}", name)); };
  if (file.bytes.starts_with("glTF")) return format("glb");
  TextScanner scanner(file, {.comment = '#'});
  if (!scanner.next_line()) return nullptr;
  const std::string_view word = scanner.word();
  if (word.starts_with('{')) return format("gltf");
  if (word == "ply") return format("ply");
  if (word == "VERSION" || word == "FIELDS") return format("pcd");
  if (word.ends_with("OFF")) return format("off");
  if (lower_case(word) == "solid") return format("stl");
  for (const std::string_view keyword : {"v", "vn", "vt", "o", "g", "s", "mtllib", "usemtl"})
    if (word == keyword) return format("obj");
  return nullptr;
}

const MeshFormat& writable_format(const fs::path& path, std::string_view name) {
  const MeshFormat* format = format_of(name.empty() ? path : fs::path(fmt::format("x.{}", name)));
  if (format) return *format;
  throw OutputError(fmt::format("{}: cannot write: \"{}\" is none of the mesh formats {}",
                                path.string(), path.extension().string(), mesh_formats()));
}

bool has_tags(const Mesh& mesh, std::initializer_list<FaceTag::Kind> kinds) {
  return std::any_of(mesh.tags.begin(), mesh.tags.end(), [&](const FaceTag& tag) {
    return std::find(kinds.begin(), kinds.end(), tag.kind) != kinds.end();
  });
}

}  // namespace

Mesh read_mesh(const fs::path& path) {
  const FileBytes file = read_file_bytes(path);
  const MeshFormat* format = format_of(path);
  if (!format) format = recognize(file);
  if (!format) return import_mesh(file);
  return format->read(file);
}

std::string mesh_formats() {
  std::string names;
  for (const MeshFormat& format : known_formats)
    names += fmt::format("{}{}", names.empty() ? "" : ", ", format.name);
  return names;
}

bool can_write_mesh(const fs::path& path) {
  return format_of(path) != nullptr;
}

std::vector<std::string> left_out_by(const fs::path& path, const Mesh& mesh,
                                     std::string_view format_name) {
  const MeshFormat& format = writable_format(path, format_name);
  std::vector<std::string> sentences;
  const auto add = [&](unsigned needed, bool present, std::string_view what) {
    if (present && (format.holds & needed) == 0)
      sentences.push_back(fmt::format("{} cannot hold {}", format.name, what));
  };
  const bool polygons =
      mesh.face_vertices.size() != 3 * static_cast<std::size_t>(mesh.face_count());
  if ((format.holds & holds_faces) == 0) {
    add(holds_faces, mesh.face_count() > 0, "faces: only the vertices are written");
  } else {
    add(holds_polygons, polygons, "polygons: written in triangles");
    add(holds_polygons | doubles_corners, true,
        "shared vertices: written thrice for every triangle");
  }
  const bool names = has_tags(mesh, {FaceTag::Kind::object, FaceTag::Kind::material});
  const bool groups = has_tags(mesh, {FaceTag::Kind::group, FaceTag::Kind::smoothing});
  add(holds_tags | holds_objects, names, "the names of objects and materials");
  add(holds_tags, groups, "groups");
  add(holds_tags, !mesh.material_libraries.empty(), "material libraries");
  if ((format.holds & (holds_tags | holds_objects)) == holds_objects && !objects_are_apart(mesh))
    sentences.push_back(fmt::format(
        "{} holds objects with vertices of their own: these share some, and are written as one",
        format.name));
  if ((format.holds & holds_tags) != 0 && !names_are_plain(mesh))
    sentences.push_back(
        fmt::format("{} cannot hold line ends, # and \\ where they stand in names", format.name));
  add(holds_materials, mesh.gltf_materials != nullptr, "the materials of glTF and their images");
  const bool doubles = (format.holds & doubles_corners) != 0 &&
                       (mesh.normals.per_corner() || mesh.texcoords.per_corner());
  if (doubles)
    sentences.push_back(fmt::format(
        "{} holds normals and texture coordinates by vertices: those that have several are "
        "written several times",
        format.name));
  add(mesh.normals.per_corner() ? holds_corner_normals | doubles_corners : holds_normals,
      !mesh.normals.empty(), mesh.normals.per_corner() ? "normals per corner" : "normals");
  add(mesh.texcoords.per_corner() ? holds_corner_texcoords | doubles_corners : holds_texcoords,
      !mesh.texcoords.empty(),
      mesh.texcoords.per_corner() ? "texture coordinates per corner" : "texture coordinates");
  add(holds_colors, !mesh.colors.empty(), "colors");
  if ((format.holds & holds_colors) != 0)
    add(holds_fine_colors, !mesh.colors.empty() && !are_bytes(mesh.colors),
        "colors finer than bytes: rounded");
  add(holds_alpha, !mesh.colors.empty() && mesh.colors.values.col(3).minCoeff() < 1, "alpha");
  add(holds_radii, mesh.radii.size() > 0, "radii");
  return sentences;
}

void write_mesh(const Mesh& mesh, const fs::path& path, std::string_view format_name) {
  check_mesh(mesh);
  const MeshFormat& format = writable_format(path, format_name);
  OutputFile file(path);
  format.write(mesh, file);
  file.commit();
}

}  // namespace supple
