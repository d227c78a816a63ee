#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "io/mesh/mesh_checks.h"
#include "io/mesh/text_scanner.h"
#include "io/points/point_formats.h"

namespace supple {
namespace {

using Words = std::vector<std::string_view>;

constexpr std::size_t least_columns = 3;

bool is_comment(std::string_view text) {
  return text.starts_with('#') || text.starts_with("//");
}

/// True where a number begins: a header is told by having none.
bool begins_number(std::string_view word) {
  word.remove_prefix(std::min(word.find_first_not_of("+-."), word.size()));
  const std::string text = lower_case(word);
  return text == "nan" || text == "inf" || text == "infinity" ||
         (!text.empty() && text[0] >= '0' && text[0] <= '9');
}

/// Columns of three that belong together, by the names that headers give them.
struct Triple {
  std::array<std::string_view, 3> names;
  std::array<std::string_view, 3> other_names;
};
constexpr Triple position_names{{"x", "y", "z"}, {"x", "y", "z"}};
constexpr Triple normal_names{{"nx", "ny", "nz"}, {"normal_x", "normal_y", "normal_z"}};
constexpr Triple color_names{{"r", "g", "b"}, {"red", "green", "blue"}};

using Columns = std::array<int, 3>;  ///< −1: there are none
constexpr Columns no_columns{-1, -1, -1};

Columns find_columns(const std::vector<std::string>& names, const Triple& triple) {
  Columns columns = no_columns;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto found = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
      return name == triple.names[k] || name == triple.other_names[k];
    });
    if (found == names.end()) return no_columns;
    columns[k] = static_cast<int>(found - names.begin());
  }
  return columns;
}

class XyzReader {
 public:
  explicit XyzReader(const FileBytes& file) : file_(file), scanner_(file, {}) {}

  Mesh read() {
    while (scanner_.next_line()) read_line(scanner_.rest());
    scanner_.set_subject({}, 0);
    if (count_ && *count_ != points())
      scanner_.fail(fmt::format("the first line says {} points, the file has {}{}", *count_,
                                points(), *count_ > points() ? ": it is cut short" : ""));
    if (points() > 0) take_columns();
    take_notes();
    finish_mesh(mesh_, file_);
    return std::move(mesh_);
  }

 private:
  long long points() const {
    return width_ == 0 ? 0 : static_cast<long long>(values_.size() / width_);
  }

  void read_line(std::string_view line) {
    if (is_comment(line)) {
      line.remove_prefix(std::min(line.find_first_not_of("#/ \t"), line.size()));
      if (points() == 0) take_names(line);
      return;
    }
    scanner_.set_subject("point", points());
    if (points() == 0 && is_header(line)) {
      if (!take_names(line)) ++header_lines_;
      return;
    }
    split(line);
    if (points() == 0 && words_.size() == 1 && !count_)
      read_count();
    else
      read_point();
  }

  /// Words without any number.
  bool is_header(std::string_view line) {
    split_loosely(line);
    return std::none_of(words_.begin(), words_.end(), begins_number);
  }

  /// Takes names of columns, where they say which are x, y and z.
  bool take_names(std::string_view line) {
    split_loosely(line);
    std::vector<std::string> names;
    for (const std::string_view word : words_) names.push_back(lower_case(word));
    if (find_columns(names, position_names) == no_columns) return false;
    names_ = std::move(names);
    return true;
  }

  /// At blanks, commas and semicolons, however they stand; quotes are no part of a word.
  void split_loosely(std::string_view line) {
    constexpr std::string_view between = " \t\r,;\"";
    words_.clear();
    for (std::size_t at = line.find_first_not_of(between); at != std::string_view::npos;) {
      const std::size_t end = std::min(line.find_first_of(between, at), line.size());
      words_.push_back(line.substr(at, end - at));
      at = line.find_first_not_of(between, end);
    }
  }

  /// At blanks, at commas, or at semicolons, but all in one way: "1,5 2,5" may be two numbers or
  /// four.
  void split(std::string_view line) {
    words_.clear();
    char delimiter = '\0';
    while (!line.empty() && !is_comment(line)) {
      const std::size_t end = std::min(line.find_first_of(" \t\r,;"), line.size());
      if (end == 0) scanner_.fail("a number is missing between two separators");
      words_.push_back(line.substr(0, end));
      line.remove_prefix(end);
      skip_blanks(line);
      if (line.empty() || is_comment(line)) return;
      const char found = line[0] == ',' || line[0] == ';' ? line[0] : ' ';
      if (found != ' ') {
        line.remove_prefix(1);
        skip_blanks(line);
      }
      if (line.empty() && words_.size() >= least_columns) return;  // a comma may end the line
      if (delimiter != '\0' && found != delimiter)
        scanner_.fail("numbers are separated in different ways; decimals need a point");
      delimiter = found;
    }
  }

  static void skip_blanks(std::string_view& line) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
  }

  void read_count() {
    const double count = scanner_.to_number(words_[0]);
    if (count < 0 || count != std::floor(count) || count > double(file_.bytes.size()))
      scanner_.fail(fmt::format("one number; a point has at least {}", least_columns));
    count_ = static_cast<long long>(count);
  }

  void read_point() {
    if (width_ == 0) begin_points();
    if (words_.size() != width_)
      scanner_.fail(
          fmt::format("the line has {} numbers, those before have {}", words_.size(), width_));
    for (const std::string_view word : words_) values_.push_back(scanner_.to_number(word));
  }

  void begin_points() {
    if (!names_.empty() && names_.size() != words_.size()) {
      mesh_.notes.push_back(fmt::format("left out: a header with {} names for {} columns",
                                        names_.size(), words_.size()));
      names_.clear();
    }
    const std::size_t spare = words_.size() % 3;
    if (names_.empty() && (words_.size() < least_columns || words_.size() > 10 || spare == 2))
      scanner_.fail(
          fmt::format("the line has {} numbers; 3, 6 or 9, and one more, can be read "
                      "without a header that names them",
                      words_.size()));
    width_ = words_.size();
  }

  auto column(int index) const {
    using Column = Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<>>;
    return Column(values_.data() + index, points(),
                  Eigen::InnerStride<>(static_cast<Index>(width_)));
  }

  void take_columns() {
    Columns positions{0, 1, 2}, normals = no_columns, colors = no_columns;
    if (!names_.empty()) {
      positions = find_columns(names_, position_names);
      normals = find_columns(names_, normal_names);
      colors = find_columns(names_, color_names);
    } else {
      for (int first = 3; first + 3 <= static_cast<int>(width_); first += 3) {
        const bool color = colors == no_columns && looks_like_color(first);
        if (!color && normals != no_columns) continue;
        (color ? colors : normals) = {first, first + 1, first + 2};
      }
    }
    take(positions, mesh_.positions);
    if (normals != no_columns) take(normals, mesh_.normals.values);
    if (colors != no_columns) take(colors, mesh_.colors.values);
    note_columns_left(positions, normals, colors);
  }

  bool looks_like_color(int first) const {
    double largest = 0;
    for (int k = first; k < first + 3; ++k) {
      const auto values = column(k);
      if (values.minCoeff() < 0 || (values.array() != values.array().floor()).any()) return false;
      largest = std::max(largest, values.maxCoeff());
    }
    return largest > 1 && largest <= 255;
  }

  template <class Matrix>
  void take(const Columns& columns, Matrix& matrix) {
    matrix.setOnes(points(), matrix.cols());
    for (int k = 0; k < 3; ++k) matrix.col(k) = column(columns[static_cast<std::size_t>(k)]);
  }

  void note_columns_left(const Columns& positions, const Columns& normals, const Columns& colors) {
    for (int c = 0; c < static_cast<int>(width_); ++c) {
      const auto has = [c](const Columns& columns) {
        return std::find(columns.begin(), columns.end(), c) != columns.end();
      };
      if (has(positions) || has(normals) || has(colors)) continue;
      const std::string name = names_.empty()
                                   ? fmt::format("{}", c + 1)
                                   : fmt::format("\"{}\"", names_[static_cast<std::size_t>(c)]);
      mesh_.notes.push_back("left out: column " + name);
    }
  }

  void take_notes() {
    note_left_out(mesh_, header_lines_, "lines before the first point");
    if (scanner_.ends_inside_line()) note_open_end(mesh_);
  }

  const FileBytes& file_;
  TextScanner scanner_;
  Mesh mesh_;
  Words words_;                     ///< of the line
  std::vector<std::string> names_;  ///< of the columns; empty: not told
  std::vector<double> values_;      ///< point by point
  std::size_t width_ = 0;           ///< numbers a point
  std::optional<long long> count_;
  int header_lines_ = 0;
};

}  // namespace

Mesh read_xyz(const FileBytes& file) {
  require_text(file);
  return XyzReader(file).read();
}

}  // namespace supple
