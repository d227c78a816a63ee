#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "io/mesh/binary_output.h"
#include "io/mesh/number_types.h"
#include "io/mesh/text_output.h"
#include "io/points/point_formats.h"

namespace supple {
namespace {

/// A column of the header.
struct Field {
  std::string_view name;
  int size;  ///< [bytes]
  char type;
};

class PcdWriter {
 public:
  PcdWriter(const Mesh& mesh, OutputFile& file)
      : mesh_(mesh),
        file_(file),
        doubles_(needs_double(mesh.positions)),
        normals_(!mesh.normals.empty() && !mesh.normals.per_corner()),
        colors_(!mesh.colors.empty()),
        alpha_(colors_ && mesh.colors.values.col(3).minCoeff() < 1) {}

  void write() {
    write_header();
    for (Index i = 0; i < mesh_.positions.rows(); ++i) write_point(i);
  }

 private:
  std::vector<Field> fields() const {
    std::vector<Field> fields;
    for (const char* name : {"x", "y", "z"}) fields.push_back({name, doubles_ ? 8 : 4, 'F'});
    if (normals_)
      for (const char* name : {"normal_x", "normal_y", "normal_z"})
        fields.push_back({name, 4, 'F'});
    // PCL gives rgb the type of a float whose bits it is.
    if (colors_) fields.push_back(alpha_ ? Field{"rgba", 4, 'U'} : Field{"rgb", 4, 'F'});
    if (mesh_.radii.size() > 0) fields.push_back({"radius", 4, 'F'});
    return fields;
  }

  void write_header() {
    const std::vector<Field> columns = fields();
    const auto row = [&](std::string_view key, const auto& value) {
      print(file_, "{}", key);
      for (const Field& field : columns) print(file_, " {}", value(field));
      file_.write("\n");
    };
    file_.write("# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n");
    row("FIELDS", [](const Field& field) { return field.name; });
    row("SIZE", [](const Field& field) { return field.size; });
    row("TYPE", [](const Field& field) { return field.type; });
    row("COUNT", [](const Field&) { return 1; });
    print(file_, "WIDTH {0}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {0}\nDATA binary\n",
          mesh_.positions.rows());
  }

  void write_point(Index i) {
    row_.clear();
    for (int axis = 0; axis < 3; ++axis) {
      if (doubles_)
        append_binary(row_, mesh_.positions(i, axis));
      else
        append_binary(row_, checked_float(mesh_.positions(i, axis), file_));
    }
    if (normals_)
      for (int axis = 0; axis < 3; ++axis)
        append_binary(row_, checked_float(mesh_.normals.values(i, axis), file_));
    if (colors_) append_binary(row_, packed_color(i));
    if (mesh_.radii.size() > 0) append_binary(row_, checked_float(mesh_.radii[i], file_));
    file_.write(row_);
  }

  /// Alpha, red, green, blue, highest byte first.
  std::uint32_t packed_color(Index i) const {
    std::uint32_t bits = 0;
    for (const int channel : {3, 0, 1, 2}) {
      const double value = channel == 3 && !alpha_ ? 0 : mesh_.colors.values(i, channel);
      bits = bits << 8 | static_cast<std::uint32_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
    }
    return bits;
  }

  const Mesh& mesh_;
  OutputFile& file_;
  bool doubles_, normals_, colors_, alpha_;
  std::string row_;
};

}  // namespace

void write_pcd(const Mesh& mesh, OutputFile& file) {
  PcdWriter(mesh, file).write();
}

}  // namespace supple
