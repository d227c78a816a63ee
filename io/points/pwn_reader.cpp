#include <algorithm>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "io/mesh/mesh_checks.h"
#include "io/mesh/text_scanner.h"
#include "io/points/point_formats.h"

namespace supple {
namespace {

constexpr std::size_t least_point_bytes = 12;  // "0 0 0 0 0 1\n"

class PwnReader {
 public:
  explicit PwnReader(const FileBytes& file) : file_(file), scanner_(file, {.comment = '#'}) {}

  Mesh read() {
    scanner_.require_line();
    if (scanner_.words_left() == 1) read_count();
    const int width = scanner_.words_left();
    if (width == 6)
      read_lines_of_six();
    else if (width == 3 && count_)
      read_one_after_the_other();
    else
      scanner_.fail(
          fmt::format("the line has {} numbers; allowed: 6, or 3 behind a first line "
                      "with the count",
                      width));
    if (scanner_.ends_inside_line()) note_open_end(mesh_);
    finish_mesh(mesh_, file_);
    return std::move(mesh_);
  }

 private:
  void read_count() {
    count_ = scanner_.integer();
    // The last number needs no blank after it.
    const auto most = static_cast<long long>((scanner_.bytes_left() + 1) / least_point_bytes);
    if (*count_ < 0 || *count_ > most || *count_ > std::numeric_limits<int>::max())
      scanner_.fail(
          fmt::format("{} points cannot be in a file of {} bytes", *count_, file_.bytes.size()));
    if (*count_ == 0) scanner_.fail("the file has no points");
    scanner_.set_subject("point", 0);
    scanner_.require_line();
  }

  void read_lines_of_six() {
    std::vector<double> values;
    long long points = 0;
    do {
      scanner_.set_subject("point", points);
      if (count_ && points == *count_)
        scanner_.fail(fmt::format("the first line says {} points", *count_));
      for (int k = 0; k < 6; ++k) values.push_back(scanner_.number());
      scanner_.expect_line_end();
      ++points;
    } while (scanner_.next_line());
    if (count_ && points < *count_)
      scanner_.fail(fmt::format("the file is cut short: the first line says {} points, it has {}",
                                *count_, points));
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>> rows(
        values.data(), points, 6);
    mesh_.positions = rows.leftCols<3>();
    mesh_.normals.values = rows.rightCols<3>();
  }

  void read_one_after_the_other() {
    mesh_.positions.resize(*count_, 3);
    mesh_.normals.values.resize(*count_, 3);
    read_rows("point", mesh_.positions);
    scanner_.set_subject("normal", 0);
    scanner_.require_line();
    read_rows("normal", mesh_.normals.values);
    scanner_.set_subject({}, 0);
    if (scanner_.next_line()) scanner_.fail(fmt::format("more than {} points", *count_));
  }

  /// From the line on that the scanner stands at.
  void read_rows(std::string_view kind, Points& rows) {
    for (Index i = 0; i < rows.rows(); ++i) {
      scanner_.set_subject(kind, i);
      if (i > 0) scanner_.require_line();
      for (int axis = 0; axis < 3; ++axis) rows(i, axis) = scanner_.number();
      scanner_.expect_line_end();
    }
  }

  const FileBytes& file_;
  TextScanner scanner_;
  Mesh mesh_;
  std::optional<long long> count_;
};

}  // namespace

Mesh read_pwn(const FileBytes& file) {
  require_text(file);
  return PwnReader(file).read();
}

}  // namespace supple
