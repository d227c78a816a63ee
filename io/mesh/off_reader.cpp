#include <limits>

#include <fmt/format.h>

#include "io/mesh/mesh_checks.h"
#include "io/mesh/mesh_formats.h"
#include "io/mesh/text_scanner.h"

namespace supple {
namespace {

// The shortest lines there can be: "0 0 0\n" and "1 0\n".
constexpr std::size_t vertex_bytes = 6, face_bytes = 4;

class OffReader {
 public:
  explicit OffReader(const FileBytes& file) : file_(file), scanner_(file, {.comment = '#'}) {}

  Mesh read() {
    read_header();
    read_vertices();
    read_faces();
    take_notes();
    finish_mesh(mesh_, file_);
    return std::move(mesh_);
  }

 private:
  /// [ST][C][N]OFF, then the counts on the same line or the next.
  void read_header() {
    scanner_.require_line();
    std::string_view letters = scanner_.word();
    const auto take = [&](std::string_view prefix) {
      if (!letters.starts_with(prefix)) return false;
      letters.remove_prefix(prefix.size());
      return true;
    };
    has_texcoords_ = take("ST");
    needs_colors_ = take("C");
    has_normals_ = take("N");
    if (letters != "OFF")
      scanner_.fail("the first word is not OFF, COFF, NOFF, CNOFF or one of these after ST");
    if (scanner_.at_line_end()) scanner_.require_line();
    vertices_ = read_count("vertices", vertex_bytes);
    faces_ = read_count("faces", face_bytes);
    if (!scanner_.at_line_end()) scanner_.integer();  // edges: of no use
    scanner_.expect_line_end();
  }

  int read_count(std::string_view what, std::size_t least_bytes) {
    const long long count = scanner_.integer();
    const auto most = static_cast<long long>(scanner_.bytes_left() / least_bytes + 1);
    if (count < 0 || count > most || count > std::numeric_limits<int>::max())
      scanner_.fail(
          fmt::format("{} {} cannot be in a file of {} bytes", count, what, file_.bytes.size()));
    return static_cast<int>(count);
  }

  void read_vertices() {
    mesh_.positions.resize(vertices_, 3);
    if (has_normals_) mesh_.normals.values.resize(vertices_, 3);
    if (has_texcoords_) mesh_.texcoords.values.resize(vertices_, 2);
    for (int i = 0; i < vertices_; ++i) {
      scanner_.set_subject("vertex", i);
      scanner_.require_line();
      if (i == 0) find_colors();
      read_row(mesh_.positions, i);
      if (has_normals_) read_row(mesh_.normals.values, i);
      for (int channel = 0; channel < color_channels_; ++channel)
        mesh_.colors.values(i, channel) = scanner_.number();
      if (has_texcoords_) read_row(mesh_.texcoords.values, i);
      scanner_.expect_line_end();
    }
  }

  /// Files have colors with and without a C in their first word, of three or four channels.
  void find_colors() {
    const int columns = 3 + (has_normals_ ? 3 : 0) + (has_texcoords_ ? 2 : 0);
    color_channels_ = scanner_.words_left() - columns;
    const bool allowed =
        color_channels_ == 3 || color_channels_ == 4 || (color_channels_ == 0 && !needs_colors_);
    if (!allowed)
      scanner_.fail(
          fmt::format("the line has {} numbers; {}{} or {} are right", scanner_.words_left(),
                      needs_colors_ ? "" : fmt::format("{}, ", columns), columns + 3, columns + 4));
    if (color_channels_ > 0) mesh_.colors.values.setOnes(vertices_, 4);
  }

  template <class Matrix>
  void read_row(Matrix& matrix, Index row) {
    for (Index column = 0; column < matrix.cols(); ++column)
      matrix(row, column) = scanner_.number();
  }

  void read_faces() {
    for (int i = 0; i < faces_; ++i) {
      scanner_.set_subject("face", i);
      scanner_.require_line();
      read_face(scanner_.integer());
      if (!scanner_.at_line_end()) ++colored_faces_;
    }
  }

  void read_face(long long size) {
    if (size < 1) scanner_.fail(fmt::format("{} vertices", size));
    const std::size_t first = mesh_.face_vertices.size();
    for (long long k = 0; k < size; ++k) {
      const long long vertex = scanner_.integer();
      if (vertex < 0 || vertex >= vertices_)
        scanner_.fail(fmt::format("vertex {} does not exist, the file has {}, counted from 0",
                                  vertex, vertices_));
      mesh_.face_vertices.push_back(static_cast<int>(vertex));
    }
    if (size >= 3) {
      mesh_.face_starts.push_back(static_cast<int>(mesh_.face_vertices.size()));
    } else {
      mesh_.face_vertices.resize(first);
      ++short_faces_;
    }
  }

  void take_notes() {
    note_left_out(mesh_, short_faces_, "faces of fewer than 3 vertices");
    note_left_out(mesh_, colored_faces_, "colors of faces");
    if (scanner_.ends_inside_line()) note_open_end(mesh_);
    if (scanner_.next_line())
      mesh_.notes.push_back(
          fmt::format("left out: what follows the last face, from line {}", scanner_.line()));
  }

  const FileBytes& file_;
  TextScanner scanner_;
  Mesh mesh_;
  bool has_texcoords_ = false, needs_colors_ = false, has_normals_ = false;
  int vertices_ = 0, faces_ = 0, color_channels_ = 0;
  int short_faces_ = 0, colored_faces_ = 0;
};

}  // namespace

Mesh read_off(const FileBytes& file) {
  require_text(file);
  return OffReader(file).read();
}

}  // namespace supple
