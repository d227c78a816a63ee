#include "io/mesh/mesh_checks.h"

#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "io/errors.h"
#include "solver/core/check.h"

namespace supple {
namespace {

void scale_colors(Mesh& mesh, const FileBytes& file) {
  if (mesh.colors.empty()) return;
  auto& values = mesh.colors.values;
  Index row = 0, column = 0;
  if (values.minCoeff(&row, &column) < 0 || values.maxCoeff(&row, &column) > 255)
    throw InputError(
        fmt::format("{}: the color {} of vertex {} (counted from 0) is outside [0, 1] "
                    "and [0, 255]",
                    file.name, values(row, column), row));
  if (values.maxCoeff() <= 1) return;
  // An alpha that the file does not have is 1 in either scale.
  const bool opaque = values.col(3).maxCoeff() <= 1;
  values.leftCols(opaque ? 3 : 4) /= 255;
  mesh.notes.push_back("the colors run to 255 and were divided by 255");
}

void check_radii(const Mesh& mesh, const FileBytes& file) {
  Index row = 0;
  if (mesh.radii.size() > 0 && mesh.radii.minCoeff(&row) < 0)
    throw InputError(fmt::format("{}: the radius {} of point {} (counted from 0) is negative",
                                 file.name, mesh.radii[row], row));
}

template <int Columns>
void simplify_corners(Attribute<Columns>& attribute, const Mesh& mesh) {
  if (attribute.values.rows() == mesh.positions.rows() && attribute.corners == mesh.face_vertices)
    attribute.corners.clear();
}

bool repeats_vertex(std::span<const int> corners, std::vector<int>& sorted) {
  if (corners.size() == 3)
    return corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
  sorted.assign(corners.begin(), corners.end());
  std::sort(sorted.begin(), sorted.end());
  return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

void note_repeated_vertices(Mesh& mesh) {
  int count = 0;
  std::vector<int> sorted;
  for (int face = 0; face < mesh.face_count(); ++face) {
    const auto size = static_cast<std::size_t>(mesh.face_size(face));
    const auto corners = std::span(mesh.face_vertices).subspan(mesh.face_starts[face], size);
    count += repeats_vertex(corners, sorted);
  }
  if (count > 0) mesh.notes.push_back(fmt::format("{} faces use a vertex twice", count));
}

template <int Columns>
void check_attribute(const Attribute<Columns>& attribute, const Mesh& mesh, const char* name) {
  const Index rows = attribute.values.rows();
  SUPPLE_CHECK(attribute.values.allFinite(), name);
  if (attribute.per_corner())
    SUPPLE_CHECK(attribute.corners.size() == mesh.face_vertices.size() &&
                     std::all_of(attribute.corners.begin(), attribute.corners.end(),
                                 [&](int row) { return row >= -1 && row < rows; }),
                 name);
  else
    SUPPLE_CHECK(rows == 0 || rows == mesh.positions.rows(), name);
}

}  // namespace

void finish_mesh(Mesh& mesh, const FileBytes& file) {
  if (mesh.positions.rows() == 0)
    throw InputError(fmt::format("{}: the file has no vertices", file.name));
  scale_colors(mesh, file);
  check_radii(mesh, file);
  simplify_corners(mesh.normals, mesh);
  simplify_corners(mesh.texcoords, mesh);
  note_repeated_vertices(mesh);
}

void note_left_out(Mesh& mesh, long long count, std::string_view what) {
  if (count > 0) mesh.notes.push_back(fmt::format("left out: {} {}", count, what));
}

void note_open_end(Mesh& mesh) {
  mesh.notes.push_back("the last line has no end: the file may be cut short there");
}

void check_mesh(const Mesh& mesh) {
  const Index vertices = mesh.positions.rows();
  SUPPLE_CHECK(mesh.positions.allFinite(), "positions");
  SUPPLE_CHECK(mesh.face_starts.front() == 0 &&
                   mesh.face_starts.back() == static_cast<int>(mesh.face_vertices.size()) &&
                   std::is_sorted(mesh.face_starts.begin(), mesh.face_starts.end()),
               "face_starts");
  SUPPLE_CHECK(std::all_of(mesh.face_vertices.begin(), mesh.face_vertices.end(),
                           [&](int vertex) { return vertex >= 0 && vertex < vertices; }),
               "face_vertices");
  check_attribute(mesh.normals, mesh, "normals");
  check_attribute(mesh.texcoords, mesh, "texcoords");
  check_attribute(mesh.colors, mesh, "colors");
  SUPPLE_CHECK(mesh.radii.size() == 0 || (mesh.radii.size() == vertices && mesh.radii.allFinite() &&
                                          mesh.radii.minCoeff() >= 0),
               "radii");
}

}  // namespace supple
