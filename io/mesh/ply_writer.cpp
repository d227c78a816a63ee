#include <algorithm>
#include <cmath>
#include <cstdint>

#include "io/mesh/binary_output.h"
#include "io/mesh/mesh_formats.h"
#include "io/mesh/number_types.h"
#include "io/mesh/text_output.h"

namespace supple {
namespace {

class PlyWriter {
 public:
  PlyWriter(const Mesh& mesh, OutputFile& file)
      : mesh_(mesh),
        file_(file),
        doubles_(needs_double(mesh.positions) ||
                 (mesh.face_count() == 0 && !are_floats(mesh.positions))),
        normals_(!mesh.normals.empty() && !mesh.normals.per_corner()),
        texcoords_(!mesh.texcoords.empty() && !mesh.texcoords.per_corner()),
        corner_texcoords_(!mesh.texcoords.empty() && mesh.texcoords.per_corner()),
        colors_(!mesh.colors.empty()),
        alpha_(colors_ && mesh.colors.values.col(3).minCoeff() < 1),
        color_bytes_(colors_ && are_bytes(mesh.colors)),
        wide_counts_(largest_face() > 255 / 2) {}

  void write() {
    write_header();
    for (Index i = 0; i < mesh_.positions.rows(); ++i) write_vertex(i);
    for (int face = 0; face < mesh_.face_count(); ++face) write_face(face);
  }

 private:
  int largest_face() const {
    int largest = 0;
    for (int face = 0; face < mesh_.face_count(); ++face)
      largest = std::max(largest, mesh_.face_size(face));
    return largest;
  }

  void write_header() {
    print(file_, "ply\nformat binary_little_endian 1.0\nelement vertex {}\n",
          mesh_.positions.rows());
    declare(doubles_ ? "double" : "float", {"x", "y", "z"});
    if (normals_) declare("float", {"nx", "ny", "nz"});
    if (texcoords_) declare("float", {"s", "t"});
    if (colors_) declare(color_bytes_ ? "uchar" : "float", {"red", "green", "blue"});
    if (alpha_) declare(color_bytes_ ? "uchar" : "float", {"alpha"});
    if (mesh_.radii.size() > 0) declare("float", {"radius"});
    if (mesh_.face_count() > 0) {
      const std::string_view count = wide_counts_ ? "int" : "uchar";
      print(file_, "element face {}\nproperty list {} int vertex_indices\n", mesh_.face_count(),
            count);
      if (corner_texcoords_) print(file_, "property list {} float texcoord\n", count);
    }
    file_.write("end_header\n");
  }

  void declare(std::string_view type, std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names) print(file_, "property {} {}\n", type, name);
  }

  void write_vertex(Index i) {
    row_.clear();
    for (int axis = 0; axis < 3; ++axis) append_real(mesh_.positions(i, axis), doubles_);
    if (normals_) append_floats(mesh_.normals.values.row(i));
    if (texcoords_) append_floats(mesh_.texcoords.values.row(i));
    for (int channel = 0; channel < (alpha_ ? 4 : colors_ ? 3 : 0); ++channel)
      append_color(mesh_.colors.values(i, channel));
    if (mesh_.radii.size() > 0) append_real(mesh_.radii[i], false);
    file_.write(row_);
  }

  void write_face(int face) {
    const int begin = mesh_.face_starts[face], end = mesh_.face_starts[face + 1];
    row_.clear();
    append_count(end - begin);
    for (int corner = begin; corner < end; ++corner)
      append_binary<std::int32_t>(row_, mesh_.face_vertices[corner]);
    if (corner_texcoords_) {
      append_count(2 * (end - begin));
      for (int corner = begin; corner < end; ++corner) {
        const int value = mesh_.texcoords.corners[corner];
        append_floats(value < 0 ? Eigen::RowVector2d(0, 0)
                                : Eigen::RowVector2d(mesh_.texcoords.values.row(value)));
      }
    }
    file_.write(row_);
  }

  void append_real(double value, bool as_double) {
    if (as_double)
      append_binary(row_, value);
    else
      append_binary(row_, checked_float(value, file_));
  }

  template <class Row>
  void append_floats(const Row& values) {
    for (Index column = 0; column < values.size(); ++column)
      append_binary(row_, checked_float(values[column], file_));
  }

  void append_color(double value) {
    if (color_bytes_)
      append_binary(row_, static_cast<std::uint8_t>(std::lround(255 * value)));
    else
      append_binary(row_, checked_float(value, file_));
  }

  void append_count(int count) {
    if (wide_counts_)
      append_binary<std::int32_t>(row_, count);
    else
      append_binary(row_, static_cast<std::uint8_t>(count));
  }

  const Mesh& mesh_;
  OutputFile& file_;
  bool doubles_, normals_, texcoords_, corner_texcoords_, colors_, alpha_, color_bytes_;
  bool wide_counts_;  ///< uchar cannot count the largest face's texture coordinates
  std::string row_;
};

}  // namespace

void write_ply(const Mesh& mesh, OutputFile& file) {
  PlyWriter(mesh, file).write();
}

}  // namespace supple
