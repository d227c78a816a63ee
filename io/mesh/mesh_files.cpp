#include "io/mesh/mesh_files.h"

#include <array>

#include <fmt/format.h>

#include "io/mesh/mesh_checks.h"
#include "io/mesh/mesh_formats.h"
#include "io/mesh/text_scanner.h"

namespace supple {
namespace {

enum Holds : unsigned {
  kPolygons = 1,
  kTags = 2,
  kCornerNormals = 4,
  kCornerTexcoords = 8,
  kAttributes = 16,  // per vertex
  kAlpha = 32,
};

struct MeshFormat {
  std::string_view name;  ///< the extension
  Mesh (*read)(const FileBytes&);
  void (*write)(const Mesh&, OutputFile&);
  unsigned holds;
};

constexpr std::array<MeshFormat, 4> kFormats = {{
    {"obj", read_obj, write_obj,
     kPolygons | kTags | kCornerNormals | kCornerTexcoords | kAttributes},
    {"off", read_off, write_off, kPolygons | kAttributes | kAlpha},
    {"ply", read_ply, write_ply, kPolygons | kCornerTexcoords | kAttributes | kAlpha},
    {"stl", read_stl, write_stl, 0},
}};

const MeshFormat* format_of(const std::filesystem::path& path) {
  const std::string extension = lower_case(path.extension().string());
  for (const MeshFormat& format : kFormats)
    if (extension == fmt::format(".{}", format.name)) return &format;
  return nullptr;
}

/// By the first word; nullptr where it is none that a mesh file begins with.
const MeshFormat* recognize(const FileBytes& file) {
  TextScanner scanner(file, {.comment = '#'});
  if (!scanner.next_line()) return nullptr;
  const std::string_view word = scanner.word();
  const auto format = [](std::string_view name) { return format_of(fmt::format("x.{}", name)); };
  if (word == "ply") return format("ply");
  if (word.ends_with("OFF")) return format("off");
  if (lower_case(word) == "solid") return format("stl");
  for (const std::string_view keyword : {"v", "vn", "vt", "o", "g", "s", "mtllib", "usemtl"})
    if (word == keyword) return format("obj");
  return nullptr;
}

const MeshFormat& writable_format(const std::filesystem::path& path) {
  if (const MeshFormat* format = format_of(path)) return *format;
  throw OutputError(fmt::format("{}: cannot write: \"{}\" is none of the mesh formats {}",
                                path.string(), path.extension().string(), mesh_formats()));
}

}  // namespace

Mesh read_mesh(const std::filesystem::path& path) {
  const FileBytes file = read_file_bytes(path);
  const MeshFormat* format = format_of(path);
  if (!format) format = recognize(file);
  if (!format)
    throw InputError(
        fmt::format("{}: cannot read: neither its name nor its first word is of a "
                    "mesh format ({})",
                    file.name, mesh_formats()));
  return format->read(file);
}

std::string mesh_formats() {
  std::string names;
  for (const MeshFormat& format : kFormats)
    names += fmt::format("{}{}", names.empty() ? "" : ", ", format.name);
  return names;
}

bool can_write_mesh(const std::filesystem::path& path) {
  return format_of(path) != nullptr;
}

std::vector<std::string> left_out_by(const std::filesystem::path& path, const Mesh& mesh) {
  const MeshFormat& format = writable_format(path);
  std::vector<std::string> sentences;
  const auto add = [&](unsigned needed, bool present, std::string_view what) {
    if (present && (format.holds & needed) == 0)
      sentences.push_back(fmt::format("{} cannot hold {}", format.name, what));
  };
  const bool polygons =
      mesh.face_vertices.size() != 3 * static_cast<std::size_t>(mesh.face_count());
  add(kPolygons, polygons, "polygons: written in triangles");
  add(kPolygons, true, "shared vertices: written thrice for every triangle");
  add(kTags, !mesh.tags.empty() || !mesh.material_libraries.empty(), "groups and materials");
  add(mesh.normals.per_corner() ? kCornerNormals : kAttributes, !mesh.normals.empty(),
      mesh.normals.per_corner() ? "normals per corner" : "normals");
  add(mesh.texcoords.per_corner() ? kCornerTexcoords : kAttributes, !mesh.texcoords.empty(),
      mesh.texcoords.per_corner() ? "texture coordinates per corner" : "texture coordinates");
  add(kAttributes, !mesh.colors.empty(), "colors");
  add(kAlpha, !mesh.colors.empty() && mesh.colors.values.col(3).minCoeff() < 1, "alpha");
  return sentences;
}

void write_mesh(const Mesh& mesh, const std::filesystem::path& path) {
  check_mesh(mesh);
  const MeshFormat& format = writable_format(path);
  OutputFile file(path);
  format.write(mesh, file);
  file.commit();
}

}  // namespace supple
