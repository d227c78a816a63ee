#include <algorithm>
#include <charconv>
#include <map>

#include <fmt/format.h>

#include "io/mesh/mesh_checks.h"
#include "io/mesh/mesh_formats.h"
#include "io/mesh/text_scanner.h"

namespace supple {
namespace {

/// A list that faces refer to: v, vt or vn lines.
struct ObjList {
  std::string_view name;
  int columns;
  std::vector<double> values;
  int largest_reference = 0, line_of_largest = 0;

  int size() const { return static_cast<int>(values.size()) / columns; }
};

/// One corner of an f line, counted from 1; 0 where the file says nothing.
struct ObjCorner {
  long long vertex = 0, texcoord = 0, normal = 0;
};

template <int Columns>
auto as_matrix(const std::vector<double>& values) {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Columns, Eigen::RowMajor>;
  const Index rows = static_cast<Index>(values.size()) / Columns;
  return Matrix(Eigen::Map<const Matrix>(values.data(), rows, Columns));
}

class ObjReader {
 public:
  explicit ObjReader(const FileBytes& file)
      : file_(file), scanner_(file, {.comment = '#', .backslash_joins = true}) {}

  Mesh read() {
    while (scanner_.next_line()) read_line();
    check_references(vertices_);
    check_references(texcoords_);
    check_references(normals_);
    mesh_.positions = as_matrix<3>(vertices_.values);
    take_colors();
    take_attribute(mesh_.texcoords, texcoords_, texcoord_corners_);
    take_attribute(mesh_.normals, normals_, normal_corners_);
    take_notes();
    finish_mesh(mesh_, file_);
    return std::move(mesh_);
  }

 private:
  void read_line() {
    const std::string_view keyword = scanner_.word();
    if (keyword == "v") return read_vertex();
    if (keyword == "f") return read_face();
    if (keyword == "vt") return read_texcoord();
    if (keyword == "vn") return read_normal();
    if (keyword == "o") return read_tag(FaceTag::Kind::object);
    if (keyword == "g") return read_tag(FaceTag::Kind::group);
    if (keyword == "s") return read_tag(FaceTag::Kind::smoothing);
    if (keyword == "usemtl") return read_tag(FaceTag::Kind::material);
    if (keyword == "mtllib") {
      mesh_.material_libraries.emplace_back(scanner_.rest());
      return;
    }
    if (!std::all_of(keyword.begin(), keyword.end(), [](char c) { return c > 0x20 && c < 0x7f; }))
      scanner_.fail("this is not an OBJ file: a line begins with bytes that are no keyword");
    ++left_out_[std::string(keyword)];
  }

  /// x y z, then w; or r g b; or r g b a.
  void read_vertex() {
    scanner_.set_subject("vertex", vertices_.size() + 1);
    for (int axis = 0; axis < 3; ++axis) vertices_.values.push_back(scanner_.number());
    const int more = scanner_.words_left();
    if (more == 1) weights_ += scanner_.number() != 1;
    if (more == 3 || more == 4) {
      colors_.resize(4 * static_cast<std::size_t>(vertices_.size() - 1), 1.0);
      for (int channel = 0; channel < more; ++channel) colors_.push_back(scanner_.number());
      if (more == 3) colors_.push_back(1.0);
      ++colored_;
    }
    scanner_.expect_line_end();
  }

  void read_texcoord() {
    scanner_.set_subject("vt", texcoords_.size() + 1);
    texcoords_.values.push_back(scanner_.number());
    texcoords_.values.push_back(scanner_.at_line_end() ? 0.0 : scanner_.number());
    if (!scanner_.at_line_end()) depths_ += scanner_.number() != 0;
    scanner_.expect_line_end();
  }

  void read_normal() {
    scanner_.set_subject("vn", normals_.size() + 1);
    for (int axis = 0; axis < 3; ++axis) normals_.values.push_back(scanner_.number());
    scanner_.expect_line_end();
  }

  void read_tag(FaceTag::Kind kind) {
    mesh_.tags.push_back({kind, std::string(scanner_.rest()), mesh_.face_count()});
  }

  void read_face() {
    scanner_.set_subject("face", mesh_.face_count() + 1);
    const std::size_t first = mesh_.face_vertices.size();
    while (!scanner_.at_line_end()) {
      const ObjCorner corner = read_corner();
      append(texcoord_corners_, resolve(corner.texcoord, texcoords_));
      append(normal_corners_, resolve(corner.normal, normals_));
      mesh_.face_vertices.push_back(resolve(corner.vertex, vertices_));
    }
    const std::size_t size = mesh_.face_vertices.size() - first;
    if (size < 3) scanner_.fail(fmt::format("it has {} vertices, fewer than 3", size));
    mesh_.face_starts.push_back(static_cast<int>(mesh_.face_vertices.size()));
  }

  /// v, v/vt, v//vn or v/vt/vn.
  ObjCorner read_corner() {
    const std::string_view word = scanner_.word();
    const char *c = word.data(), *end = c + word.size();
    ObjCorner corner;
    long long* const parts[] = {&corner.vertex, &corner.texcoord, &corner.normal};
    bool good = true;
    for (int part = 0; part < 3 && good; ++part) {
      if (part > 0 && c < end) good = *c++ == '/';
      if (c == end || (part > 0 && *c == '/')) continue;
      const auto [after, error] = std::from_chars(c, end, *parts[part]);
      good = good && error == std::errc() && *parts[part] != 0;
      c = after;
    }
    if (!good || c != end || corner.vertex == 0)
      scanner_.fail(
          fmt::format("\"{}\" is no corner: v, v/vt, v//vn or v/vt/vn, counted from 1 "
                      "or, from the last one back, from -1",
                      word.substr(0, 40)));
    return corner;
  }

  /// Row of `list` for an index of the file; −1 where there is none.
  int resolve(long long index, ObjList& list) {
    if (index == 0) return -1;
    const long long number = index > 0 ? index : list.size() + 1 + index;
    if (number < 1 || number > std::numeric_limits<int>::max())
      scanner_.fail(fmt::format("{} {} does not exist", list.name, index));
    if (number > list.largest_reference) {
      list.largest_reference = static_cast<int>(number);
      list.line_of_largest = scanner_.line();
    }
    return static_cast<int>(number) - 1;
  }

  /// Corner lists stay empty until a corner refers to something.
  void append(std::vector<int>& corners, int row) {
    if (row < 0 && corners.empty()) return;
    corners.resize(mesh_.face_vertices.size(), -1);
    corners.push_back(row);
  }

  void check_references(const ObjList& list) {
    if (list.largest_reference > list.size())
      scanner_.fail_at(list.line_of_largest,
                       fmt::format("{} {} does not exist, the file has {}", list.name,
                                   list.largest_reference, list.size()));
  }

  void take_colors() {
    if (colored_ == 0) return;
    colors_.resize(4 * static_cast<std::size_t>(vertices_.size()), 1.0);
    mesh_.colors.values = as_matrix<4>(colors_);
    if (colored_ < vertices_.size())
      mesh_.notes.push_back(
          fmt::format("{} vertices have no color: now white", vertices_.size() - colored_));
  }

  template <int Columns>
  void take_attribute(Attribute<Columns>& attribute, const ObjList& list,
                      std::vector<int>& corners) {
    if (list.size() == 0) return;
    const bool per_vertex = mesh_.face_count() == 0 && list.size() == vertices_.size();
    if (mesh_.face_count() == 0 && !per_vertex)
      return note_left_out(mesh_, list.size(),
                           fmt::format("{} lines, no face uses them", list.name));
    attribute.values = as_matrix<Columns>(list.values);
    if (per_vertex) return;
    corners.resize(mesh_.face_vertices.size(), -1);
    attribute.corners = std::move(corners);
  }

  void take_notes() {
    note_left_out(mesh_, weights_, "weights of vertices (a fourth number that is not 1)");
    note_left_out(mesh_, depths_, "third texture coordinates that are not 0");
    for (const auto& [keyword, count] : left_out_)
      note_left_out(mesh_, count, fmt::format("lines \"{}\"", keyword));
    if (scanner_.ends_inside_line()) note_open_end(mesh_);
  }

  const FileBytes& file_;
  TextScanner scanner_;
  Mesh mesh_;
  ObjList vertices_{.name = "vertex", .columns = 3, .values = {}};
  ObjList texcoords_{.name = "vt", .columns = 2, .values = {}};
  ObjList normals_{.name = "vn", .columns = 3, .values = {}};
  std::vector<int> texcoord_corners_, normal_corners_;
  std::vector<double> colors_;
  int colored_ = 0, weights_ = 0, depths_ = 0;
  std::map<std::string, int> left_out_;
};

}  // namespace

Mesh read_obj(const FileBytes& file) {
  require_text(file);
  return ObjReader(file).read();
}

}  // namespace supple
