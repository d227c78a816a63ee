#include "io/points/pcd_header.h"

#include <algorithm>
#include <limits>
#include <optional>

#include <fmt/format.h>

namespace supple {
namespace {

constexpr int most_numbers = 1 << 20;  // of one field; feature histograms have hundreds

class PcdHeaderReader {
 public:
  explicit PcdHeaderReader(TextScanner& scanner) : scanner_(scanner) {}

  PcdHeader read() {
    std::string_view key;
    do {
      scanner_.require_line();
      key = scanner_.word();
      read_entry(key);
    } while (key != "DATA");
    lay_out();
    count_points();
    return std::move(header_);
  }

 private:
  void read_entry(std::string_view key) {
    if (key == "FIELDS" || key == "COLUMNS")
      take(names_);
    else if (key == "SIZE")
      take(sizes_);
    else if (key == "TYPE")
      take(types_);
    else if (key == "COUNT")
      take(counts_);
    else if (key == "WIDTH")
      width_ = read_count();
    else if (key == "HEIGHT")
      height_ = read_count();
    else if (key == "POINTS")
      points_ = read_count();
    else if (key == "VIEWPOINT")
      read_viewpoint();
    else if (key == "DATA")
      read_data();
    else if (key == "VERSION")
      scanner_.rest();
    else
      scanner_.fail(fmt::format("\"{}\" is no entry of a PCD header", key.substr(0, 40)));
    scanner_.expect_line_end();
  }

  void take(std::vector<std::string>& words) {
    words.clear();
    while (!scanner_.at_line_end()) words.emplace_back(scanner_.word());
  }

  long long read_count() {
    const long long count = scanner_.integer();
    if (count < 0 || count > std::numeric_limits<int>::max())
      scanner_.fail(fmt::format("{} points", count));
    return count;
  }

  void read_viewpoint() {
    for (const double at_origin : {0, 0, 0, 1, 0, 0, 0})
      if (scanner_.number() != at_origin) header_.has_viewpoint = true;
  }

  void read_data() {
    const std::string_view name = scanner_.word();
    if (name == "ascii")
      header_.data = PcdData::ascii;
    else if (name == "binary")
      header_.data = PcdData::binary;
    else if (name == "binary_compressed")
      header_.data = PcdData::compressed;
    else
      scanner_.fail("the data are not ascii, binary or binary_compressed");
  }

  void lay_out() {
    if (names_.empty()) scanner_.fail("the header has no FIELDS");
    if (counts_.empty()) counts_.assign(names_.size(), "1");
    for (const auto& [entry, words] :
         {std::pair{"SIZE", &sizes_}, {"TYPE", &types_}, {"COUNT", &counts_}})
      if (words->size() != names_.size())
        scanner_.fail(
            fmt::format("{} has {} entries for {} fields", entry, words->size(), names_.size()));
    std::size_t offset = 0;
    for (std::size_t k = 0; k < names_.size(); ++k) {
      PcdField field{.name = names_[k], .offset = offset};
      field.size = read_size(sizes_[k], types_[k]);
      field.type = types_[k][0];
      field.count = read_repetitions(counts_[k]);
      offset += field.bytes();
      header_.fields.push_back(std::move(field));
    }
  }

  int read_size(const std::string& size, const std::string& type) const {
    const bool is_float = type == "F" && (size == "4" || size == "8");
    const bool is_integer =
        (type == "I" || type == "U") && (size == "1" || size == "2" || size == "4" || size == "8");
    if (!is_float && !is_integer)
      scanner_.fail(fmt::format("SIZE {} with TYPE {} is no number of PCD", size.substr(0, 20),
                                type.substr(0, 20)));
    return size[0] - '0';
  }

  int read_repetitions(const std::string& count) const {
    const double value = scanner_.to_number(count);
    if (!(value >= 1 && value <= most_numbers) || value != static_cast<int>(value))
      scanner_.fail(fmt::format("COUNT {}: must be 1 to {}", value, most_numbers));
    return static_cast<int>(value);
  }

  /// Compares with WIDTH and HEIGHT, and with what the body can hold.
  void count_points() {
    if (!points_ && !width_) scanner_.fail("the header has neither POINTS nor WIDTH");
    header_.points = points_ ? *points_ : *width_ * height_;
    if (width_ && header_.points != *width_ * height_)
      scanner_.fail(fmt::format("POINTS {} is not WIDTH {} times HEIGHT {}", header_.points,
                                *width_, height_));
    if (header_.points == 0) scanner_.fail("the file has no points");
    if (header_.points > std::numeric_limits<int>::max())
      scanner_.fail(fmt::format("{} points", header_.points));
    if (header_.data == PcdData::compressed) return;  // their size stands before the data
    // In text a number takes a digit and a blank; the last one needs no blank.
    const bool text = header_.data == PcdData::ascii;
    const std::size_t row =
        text ? 2 * static_cast<std::size_t>(header_.numbers()) : header_.stride();
    const std::size_t left = scanner_.bytes_left() + (text ? 1 : 0);
    if (static_cast<std::size_t>(header_.points) > left / row)
      scanner_.fail(
          fmt::format("the file is cut short: {} points need at least {} bytes each, "
                      "the file has {} bytes for them",
                      header_.points, row, left));
  }

  TextScanner& scanner_;
  PcdHeader header_;
  std::vector<std::string> names_, sizes_, types_, counts_;
  std::optional<long long> points_, width_;
  long long height_ = 1;
};

}  // namespace

int PcdHeader::find(std::string_view name) const {
  const auto found = std::find_if(fields.begin(), fields.end(),
                                  [&](const PcdField& field) { return field.name == name; });
  return found == fields.end() ? -1 : static_cast<int>(found - fields.begin());
}

long long PcdHeader::numbers() const {
  long long sum = 0;
  for (const PcdField& field : fields) sum += field.count;
  return sum;
}

PcdHeader read_pcd_header(TextScanner& scanner) {
  return PcdHeaderReader(scanner).read();
}

}  // namespace supple
