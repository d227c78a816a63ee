#include <cmath>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "io/errors.h"
#include "io/mesh/mesh_checks.h"
#include "io/mesh/mesh_formats.h"
#include "io/mesh/text_scanner.h"

namespace supple {
namespace {

constexpr std::size_t header_bytes = 84, triangle_bytes = 50, normal_bytes = 12;

/// Makes mesh.positions of `coordinates`, and a triangle of every three vertices.
void take_triangles(Mesh& mesh, const std::vector<double>& coordinates) {
  const Index vertices = static_cast<Index>(coordinates.size() / 3);
  mesh.positions = Eigen::Map<const Points>(coordinates.data(), vertices, 3);
  for (int vertex = 0; vertex < vertices; ++vertex) {
    mesh.face_vertices.push_back(vertex);
    if (vertex % 3 == 2) mesh.face_starts.push_back(vertex + 1);
  }
}

class StlTextReader {
 public:
  explicit StlTextReader(const FileBytes& file) : scanner_(file, {}) {}

  Mesh read() {
    while (scanner_.next_line()) read_solid();
    take_triangles(mesh_, coordinates_);
    return std::move(mesh_);
  }

 private:
  void read_solid() {
    scanner_.expect("solid");
    const std::string_view name = scanner_.rest();
    const int first_face = static_cast<int>(coordinates_.size() / 9);
    if (!name.empty()) mesh_.tags.push_back({FaceTag::Kind::object, std::string(name), first_face});
    for (;;) {
      scanner_.set_subject("triangle", static_cast<long long>(coordinates_.size() / 9));
      scanner_.require_line();
      const std::string keyword = lower_case(scanner_.word());
      if (keyword == "endsolid") return;
      if (keyword != "facet") scanner_.fail("\"facet\" or \"endsolid\" is expected here");
      read_facet();
    }
  }

  void read_facet() {
    scanner_.require_line();
    scanner_.expect("outer");
    scanner_.expect("loop");
    for (int corner = 0; corner < 3; ++corner) {
      scanner_.require_line();
      scanner_.expect("vertex");
      scanner_.set_subject("vertex", static_cast<long long>(coordinates_.size() / 3));
      for (int axis = 0; axis < 3; ++axis) coordinates_.push_back(scanner_.number());
      scanner_.expect_line_end();
    }
    for (const std::string_view keyword : {"endloop", "endfacet"}) {
      scanner_.require_line();
      scanner_.expect(keyword);
    }
  }

  TextScanner scanner_;
  Mesh mesh_;
  std::vector<double> coordinates_;
};

std::uint32_t triangle_count(const FileBytes& file) {
  std::uint32_t count = 0;
  std::memcpy(&count, file.bytes.data() + header_bytes - sizeof(count), sizeof(count));
  return count;
}

bool is_text(const FileBytes& file) {
  if (file.bytes.size() >= header_bytes &&
      file.bytes.size() == header_bytes + triangle_bytes * triangle_count(file))
    return false;
  const std::size_t begin = file.bytes.find_first_not_of(" \t\r\n");
  return begin != std::string::npos && lower_case(file.bytes.substr(begin, 5)) == "solid" &&
         file.bytes.find('\0') == std::string::npos;
}

void read_binary_vertex(const FileBytes& file, std::size_t at, std::vector<double>& coordinates) {
  float corner[3];
  std::memcpy(corner, file.bytes.data() + at, sizeof(corner));
  for (const float value : corner) {
    if (!std::isfinite(value))
      throw InputError(fmt::format("{}: byte {}: vertex {}: {} is not a finite number", file.name,
                                   at, coordinates.size() / 3, value));
    coordinates.push_back(value);
  }
}

Mesh read_binary(const FileBytes& file) {
  const std::size_t size = file.bytes.size();
  if (size < header_bytes)
    throw InputError(
        fmt::format("{}: {} bytes are no STL file: text begins with \"solid\", binary "
                    "has at least {} bytes",
                    file.name, size, header_bytes));
  const std::size_t count = triangle_count(file), needed = header_bytes + triangle_bytes * count;
  if (size < needed)
    throw InputError(fmt::format("{}: the file is cut short: {} triangles need {} bytes, it has {}",
                                 file.name, count, needed, size));
  std::vector<double> coordinates;
  coordinates.reserve(9 * count);
  for (std::size_t triangle = 0; triangle < count; ++triangle)
    for (std::size_t corner = 0; corner < 3; ++corner)
      read_binary_vertex(file,
                         header_bytes + triangle_bytes * triangle + normal_bytes * (corner + 1),
                         coordinates);
  Mesh mesh;
  take_triangles(mesh, coordinates);
  note_left_out(mesh, static_cast<long long>(size - needed), "bytes after the last triangle");
  return mesh;
}

}  // namespace

Mesh read_stl(const FileBytes& file) {
  Mesh mesh = is_text(file) ? StlTextReader(file).read() : read_binary(file);
  finish_mesh(mesh, file);
  return mesh;
}

}  // namespace supple
