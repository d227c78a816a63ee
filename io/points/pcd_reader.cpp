#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "io/errors.h"
#include "io/mesh/mesh_checks.h"
#include "io/points/lzf.h"
#include "io/points/pcd_header.h"
#include "io/points/point_formats.h"

namespace supple {
namespace {

static_assert(std::endian::native == std::endian::little, "binary PCD is little-endian");

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// What of a point we take.
enum Value { x, y, z, normal_x, normal_y, normal_z, color, radius, values };
using Row = std::array<double, values>;

template <class Number>
double load(const char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof(Number));
  return static_cast<double>(number);
}

double load(const PcdField& field, const char* bytes) {
  if (field.type == 'F') return field.size == 4 ? load<float>(bytes) : load<double>(bytes);
  const bool is_signed = field.type == 'I';
  switch (field.size) {
    case 1:
      return is_signed ? load<std::int8_t>(bytes) : load<std::uint8_t>(bytes);
    case 2:
      return is_signed ? load<std::int16_t>(bytes) : load<std::uint16_t>(bytes);
    case 4:
      return is_signed ? load<std::int32_t>(bytes) : load<std::uint32_t>(bytes);
    default:
      return is_signed ? load<std::int64_t>(bytes) : load<std::uint64_t>(bytes);
  }
}

/// The bytes alpha, red, green, blue, highest first, that a number in text stands for: an
/// integer, or the float that has these bits.
double packed_color(const PcdField& field, double number) {
  constexpr double most = std::numeric_limits<std::uint32_t>::max();
  if (std::isnan(number)) return 0;
  if (field.type == 'I' && number < 0) number += most + 1;
  if (field.type == 'F' && std::abs(number) < 1)
    return std::bit_cast<std::uint32_t>(static_cast<float>(number));
  return std::floor(std::clamp(number, 0.0, most));
}

class PcdReader {
 public:
  explicit PcdReader(const FileBytes& file)
      : file_(file), scanner_(file, {.comment = '#'}), header_(read_pcd_header(scanner_)) {
    find_fields();
  }

  Mesh read() {
    if (header_.data == PcdData::ascii)
      read_text();
    else
      read_binary();
    take_values();
    take_notes();
    finish_mesh(mesh_, file_);
    return std::move(mesh_);
  }

 private:
  void find_fields() {
    constexpr std::array<std::string_view, values> names = {
        "x", "y", "z", "normal_x", "normal_y", "normal_z", "rgb", "radius"};
    for (std::size_t k = 0; k < values; ++k) found_[k] = header_.find(names[k]);
    if (found_[color] < 0) found_[color] = header_.find("rgba");
    if (found_[x] < 0 || found_[y] < 0 || found_[z] < 0)
      scanner_.fail("the points have no fields x, y and z");
    if (found_[normal_x] < 0 || found_[normal_y] < 0 || found_[normal_z] < 0)
      found_[normal_x] = found_[normal_y] = found_[normal_z] = -1;
    if (found_[color] >= 0 && field(color).size != 4) found_[color] = -1;
    uses_.assign(header_.fields.size(), -1);
    for (int k = 0; k < values; ++k)
      if (has(k)) uses_[static_cast<std::size_t>(found_[k])] = k;
  }

  bool has(int value) const { return found_[value] >= 0; }
  const PcdField& field(int value) const {
    return header_.fields[static_cast<std::size_t>(found_[value])];
  }

  void read_text() {
    for (long long i = 0; i < header_.points; ++i) {
      scanner_.set_subject("point", i);
      scanner_.require_line();
      Row row{};
      for (std::size_t f = 0; f < header_.fields.size(); ++f)
        for (int k = 0; k < header_.fields[f].count; ++k)
          if (uses_[f] >= 0 && k == 0)
            row[static_cast<std::size_t>(uses_[f])] = read_number();
          else
            scanner_.word();
      scanner_.expect_line_end();
      if (has(color)) row[color] = packed_color(field(color), row[color]);
      add(i, row);
    }
  }

  double read_number() {
    const std::string_view word = scanner_.word();
    const std::string lower = lower_case(word);
    return lower == "nan" || lower == "-nan" ? nan : scanner_.to_number(word);
  }

  void read_binary() {
    const std::size_t points = static_cast<std::size_t>(header_.points);
    const std::string unpacked = header_.data == PcdData::compressed ? unpack() : std::string();
    for (std::size_t i = 0; i < points; ++i) {
      Row row{};
      for (int k = 0; k < values; ++k) {
        if (!has(k)) continue;
        // Points one after the other, or, packed, fields one after the other.
        const PcdField& f = field(k);
        const char* bytes = header_.data == PcdData::binary
                                ? body() + i * header_.stride() + f.offset
                                : unpacked.data() + points * f.offset + i * f.bytes();
        row[static_cast<std::size_t>(k)] = k == color ? load<std::uint32_t>(bytes) : load(f, bytes);
      }
      add(static_cast<long long>(i), row);
    }
    if (header_.data == PcdData::binary)
      bytes_behind_ = scanner_.bytes_left() - points * header_.stride();
  }

  const char* body() const {
    return file_.bytes.data() + file_.bytes.size() - scanner_.bytes_left();
  }

  std::string unpack() {
    std::array<std::uint32_t, 2> sizes{};  // packed, unpacked [bytes]
    if (scanner_.bytes_left() < sizeof(sizes)) scanner_.fail("the file is cut short");
    std::memcpy(sizes.data(), body(), sizeof(sizes));
    const std::size_t left = scanner_.bytes_left() - sizeof(sizes);
    const std::size_t needed = static_cast<std::size_t>(header_.points) * header_.stride();
    if (sizes[0] > left)
      scanner_.fail(fmt::format("the file is cut short: {} packed bytes are promised, it has {}",
                                sizes[0], left));
    if (sizes[1] != needed)
      scanner_.fail(
          fmt::format("{} points need {} bytes, {} are packed", header_.points, needed, sizes[1]));
    bytes_behind_ = left - sizes[0];
    auto unpacked = unpack_lzf({body() + sizeof(sizes), sizes[0]}, needed);
    if (!unpacked) scanner_.fail("the packed data are damaged");
    return std::move(*unpacked);
  }

  void add(long long point, Row& row) {
    if (std::isnan(row[x]) || std::isnan(row[y]) || std::isnan(row[z])) {
      ++missing_;
      return;
    }
    if (std::isnan(row[normal_x]) || std::isnan(row[normal_y]) || std::isnan(row[normal_z])) {
      row[normal_x] = row[normal_y] = row[normal_z] = 0;
      ++missing_normals_;
    }
    for (int k = 0; k < values; ++k)
      if (!std::isfinite(row[static_cast<std::size_t>(k)]))
        throw InputError(fmt::format("{}: point {}: {} is not a finite number", file_.name, point,
                                     field(k).name));
    rows_.insert(rows_.end(), row.begin(), row.end());
  }

  void take_values() {
    if (rows_.empty()) return;
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, values, Eigen::RowMajor>> rows(
        rows_.data(), static_cast<Index>(rows_.size() / values), values);
    mesh_.positions = rows.middleCols<3>(x);
    if (has(normal_x)) mesh_.normals.values = rows.middleCols<3>(normal_x);
    if (has(radius)) mesh_.radii = rows.col(radius);
    if (has(color)) take_colors(rows.col(color));
  }

  void take_colors(const Eigen::VectorXd& packed) {
    auto& colors = mesh_.colors.values;
    colors.resize(packed.size(), 4);
    for (Index i = 0; i < packed.size(); ++i) {
      const auto bits = static_cast<std::uint32_t>(packed[i]);
      for (int channel = 0; channel < 4; ++channel)
        colors(i, channel) = (bits >> (channel == 3 ? 24 : 16 - 8 * channel) & 255u) / 255.0;
    }
    // Many programs leave the alpha of all points at 0.
    if (field(color).name == "rgb" || colors.col(3).isZero(0)) colors.col(3).setOnes();
  }

  void take_notes() {
    note_left_out(mesh_, missing_, "points that are nan: pixels that saw nothing");
    if (missing_normals_ > 0)
      mesh_.notes.push_back(
          fmt::format("{} normals are nan: read as zero vectors", missing_normals_));
    for (std::size_t f = 0; f < uses_.size(); ++f)
      if (uses_[f] < 0 && header_.fields[f].name != "_")  // padding
        mesh_.notes.push_back(fmt::format("left out: field \"{}\"", header_.fields[f].name));
    if (header_.has_viewpoint) mesh_.notes.push_back("left out: where the sensor stood");
    note_left_out(mesh_, static_cast<long long>(bytes_behind_), "bytes after the last point");
    if (header_.data != PcdData::ascii) return;
    if (scanner_.ends_inside_line()) note_open_end(mesh_);
    if (scanner_.next_line())
      mesh_.notes.push_back(
          fmt::format("left out: what follows the last point, from line {}", scanner_.line()));
  }

  const FileBytes& file_;
  TextScanner scanner_;
  PcdHeader header_;
  std::array<int, values> found_{};  ///< the field of each value, −1: none
  std::vector<int> uses_;            ///< the value that each field gives, −1: none
  std::vector<double> rows_;
  Mesh mesh_;
  long long missing_ = 0, missing_normals_ = 0;
  std::size_t bytes_behind_ = 0;
};

}  // namespace

Mesh read_pcd(const FileBytes& file) {
  return PcdReader(file).read();
}

}  // namespace supple
