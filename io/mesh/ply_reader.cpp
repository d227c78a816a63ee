#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "io/errors.h"
#include "io/mesh/mesh_checks.h"
#include "io/mesh/mesh_formats.h"
#include "io/mesh/ply_source.h"

namespace supple {
namespace {

/// Where the values of a vertex property go; nowhere where `target` is null.
struct Column {
  double* target = nullptr;  ///< its value for vertex 0
  int stride = 0;
  double unit = 1;  ///< the number of the file that stands for 1
};

/// The first of these lists of properties that `element` has whole; empty where it has none.
std::vector<int> find_columns(const PlyElement& element,
                              const std::vector<std::vector<std::string_view>>& choices) {
  for (const auto& names : choices) {
    std::vector<int> columns;
    for (const std::string_view name : names) {
      const int column = element.find(name);
      if (column >= 0 && !element.properties[column].is_list) columns.push_back(column);
    }
    if (columns.size() == names.size()) return columns;
  }
  return {};
}

/// Colors of bytes run to 255, of shorts to 65535, of floats to 1.
double color_unit(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 255;
    case PlyType::int16:
    case PlyType::uint16:
      return 65535;
    default:
      return 1;
  }
}

class PlyReader {
 public:
  explicit PlyReader(const FileBytes& file)
      : file_(file), scanner_(file, {}), header_(read_ply_header(scanner_)) {
    const PlyElement* vertices = header_.find("vertex");
    if (!vertices) scanner_.fail("the header has no element \"vertex\"");
    if (vertices->count == 0) scanner_.fail("the file has no vertices");
    vertices_ = static_cast<int>(vertices->count);
    source_ = open_ply_body(file, scanner_, header_.format);
  }

  Mesh read() {
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex")
        read_vertices(element);
      else if (element.name == "face")
        read_faces(element);
      else if (element.name == "tristrips")
        read_strips(element);
      else
        skip(element);
    }
    // Triangles of strips have no texture coordinates.
    if (mesh_.texcoords.per_corner())
      mesh_.texcoords.corners.resize(mesh_.face_vertices.size(), -1);
    take_notes();
    finish_mesh(mesh_, file_);
    return std::move(mesh_);
  }

 private:
  void read_vertices(const PlyElement& element) {
    const std::vector<Column> columns = vertex_columns(element);
    for (int row = 0; row < vertices_; ++row) {
      source_->begin_row("vertex", row);
      for (std::size_t c = 0; c < columns.size(); ++c) {
        const PlyProperty& property = element.properties[c];
        if (columns[c].target)
          columns[c].target[row * Index{columns[c].stride}] =
              finite(source_->next(property.type), property.name) / columns[c].unit;
        else
          source_->skip(property);
      }
      source_->end_row();
    }
  }

  std::vector<Column> vertex_columns(const PlyElement& element) {
    std::vector<Column> columns(element.properties.size());
    const auto position = find_columns(element, {{"x", "y", "z"}});
    if (position.empty()) scanner_.fail("element \"vertex\" has no properties x, y and z");
    assign(columns, position, mesh_.positions);
    const auto normal = find_columns(element, {{"nx", "ny", "nz"}});
    if (!normal.empty()) assign(columns, normal, mesh_.normals.values);
    const auto texcoord = find_columns(
        element, {{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}});
    if (!texcoord.empty() && mesh_.texcoords.empty())
      assign(columns, texcoord, mesh_.texcoords.values);
    const auto color =
        find_columns(element, {{"red", "green", "blue", "alpha"}, {"red", "green", "blue"}});
    if (!color.empty()) assign(columns, color, mesh_.colors.values);
    for (const int c : color) columns[c].unit = color_unit(element.properties[c].type);
    const auto radius = find_columns(element, {{"radius"}, {"radii"}});
    if (!radius.empty() && !has_faces()) assign(columns, radius, mesh_.radii);
    for (std::size_t c = 0; c < columns.size(); ++c)
      if (!columns[c].target) leave_out(element, element.properties[c]);
    return columns;
  }

  bool has_faces() const {
    return std::any_of(header_.elements.begin(), header_.elements.end(), [](const PlyElement& e) {
      return (e.name == "face" || e.name == "tristrips") && e.count > 0;
    });
  }

  /// Makes `values` and points the columns of the file at the columns of it.
  template <class Matrix>
  void assign(std::vector<Column>& columns, const std::vector<int>& found, Matrix& values) {
    values = Matrix::Ones(vertices_, values.cols());
    for (std::size_t k = 0; k < found.size(); ++k)
      columns[found[k]] = {.target = values.data() + k, .stride = static_cast<int>(values.cols())};
  }

  double finite(double value, std::string_view name) const {
    if (!std::isfinite(value)) source_->fail(fmt::format("{} is not a finite number", name));
    return value;
  }

  void read_faces(const PlyElement& element) {
    const int vertices = index_list(element);
    const int texcoords = element.find("texcoord");
    const bool has_texcoords =
        texcoords >= 0 && element.properties[texcoords].is_list && mesh_.texcoords.empty();
    for (int c = 0; c < static_cast<int>(element.properties.size()); ++c)
      if (c != vertices && !(has_texcoords && c == texcoords))
        leave_out(element, element.properties[c]);

    mesh_.face_starts.reserve(static_cast<std::size_t>(element.count) + 1);
    mesh_.face_vertices.reserve(3 * static_cast<std::size_t>(element.count));
    std::vector<int> corners;
    std::vector<double> uv, all_uv;
    for (long long row = 0; row < element.count; ++row) {
      source_->begin_row("face", row);
      for (int c = 0; c < static_cast<int>(element.properties.size()); ++c) {
        if (c == vertices)
          read_corners(element.properties[c], corners);
        else if (has_texcoords && c == texcoords)
          read_list(element.properties[c], uv);
        else
          source_->skip(element.properties[c]);
      }
      source_->end_row();
      if (has_texcoords && uv.size() != 2 * corners.size())
        source_->fail(
            fmt::format("{} texture coordinates for {} corners", uv.size(), corners.size()));
      if (corners.size() < 3) {
        ++short_faces_;
        continue;
      }
      add_face(corners.data(), corners.size());
      all_uv.insert(all_uv.end(), uv.begin(), uv.end());
    }
    if (has_texcoords) take_corner_texcoords(all_uv);
  }

  int index_list(const PlyElement& element) const {
    for (const std::string_view name : {"vertex_indices", "vertex_index"}) {
      const int column = element.find(name);
      if (column >= 0 && element.properties[column].is_list) return column;
    }
    scanner_.fail(fmt::format("element \"{}\" has no list \"vertex_indices\" or \"vertex_index\"",
                              element.name));
  }

  void read_corners(const PlyProperty& list, std::vector<int>& corners) {
    corners.clear();
    for (long long left = source_->next_count(list.count_type); left > 0; --left)
      corners.push_back(vertex_index(source_->next(list.type)));
  }

  void read_list(const PlyProperty& list, std::vector<double>& values) {
    values.clear();
    for (long long left = source_->next_count(list.count_type); left > 0; --left)
      values.push_back(finite(source_->next(list.type), list.name));
  }

  int vertex_index(double value) const {
    if (!(value >= 0 && value < vertices_ && value == std::floor(value)))
      source_->fail(fmt::format("vertex {} does not exist, the file has {}, counted from 0", value,
                                vertices_));
    return static_cast<int>(value);
  }

  void add_face(const int* corners, std::size_t count) {
    if (mesh_.face_vertices.size() + count > std::numeric_limits<int>::max())
      source_->fail("the faces have more than 2147483647 corners");
    mesh_.face_vertices.insert(mesh_.face_vertices.end(), corners, corners + count);
    mesh_.face_starts.push_back(static_cast<int>(mesh_.face_vertices.size()));
  }

  void take_corner_texcoords(const std::vector<double>& uv) {
    using Values = decltype(mesh_.texcoords.values);
    mesh_.texcoords.values =
        Eigen::Map<const Values>(uv.data(), static_cast<Index>(uv.size() / 2), 2);
    std::vector<int>& corners = mesh_.texcoords.corners;
    corners.assign(mesh_.face_vertices.size() - uv.size() / 2, -1);
    for (std::size_t k = 0; k < uv.size() / 2; ++k) corners.push_back(static_cast<int>(k));
  }

  void read_strips(const PlyElement& element) {
    const int indices = index_list(element);
    for (long long row = 0; row < element.count; ++row) {
      source_->begin_row("tristrips", row);
      for (int c = 0; c < static_cast<int>(element.properties.size()); ++c) {
        if (c == indices)
          read_strip(element.properties[c]);
        else
          source_->skip(element.properties[c]);
      }
      source_->end_row();
    }
  }

  /// Every vertex after the second makes a triangle with the two before it, every other one
  /// turned round; −1 begins a new strip. A vertex twice in a triangle only joins strips.
  void read_strip(const PlyProperty& list) {
    int length = 0, before = 0, last = 0;
    for (long long left = source_->next_count(list.count_type); left > 0; --left) {
      const double value = source_->next(list.type);
      if (value == -1) {
        length = 0;
        continue;
      }
      const int vertex = vertex_index(value);
      const bool joins = before == last || last == vertex || vertex == before;
      if (++length >= 3 && !joins) {
        const int even[] = {before, last, vertex}, odd[] = {last, before, vertex};
        add_face(length % 2 == 1 ? even : odd, 3);
      }
      before = last;
      last = vertex;
    }
  }

  void skip(const PlyElement& element) {
    note_left_out(mesh_, element.count, fmt::format("rows of element \"{}\"", element.name));
    for (long long row = 0; row < element.count; ++row) {
      source_->begin_row(element.name, row);
      for (const PlyProperty& property : element.properties) source_->skip(property);
      source_->end_row();
    }
  }

  void leave_out(const PlyElement& element, const PlyProperty& property) {
    mesh_.notes.push_back(
        fmt::format("left out: property \"{}\" of element \"{}\"", property.name, element.name));
  }

  void take_notes() {
    note_left_out(mesh_, short_faces_, "faces of fewer than 3 vertices");
    if (!source_->at_end()) mesh_.notes.push_back("left out: what follows the last element");
    if (header_.format == PlyFormat::ascii && scanner_.ends_inside_line()) note_open_end(mesh_);
  }

  const FileBytes& file_;
  TextScanner scanner_;
  PlyHeader header_;
  std::unique_ptr<PlySource> source_;
  Mesh mesh_;
  int vertices_ = 0;
  int short_faces_ = 0;
};

}  // namespace

Mesh read_ply(const FileBytes& file) {
  return PlyReader(file).read();
}

}  // namespace supple
