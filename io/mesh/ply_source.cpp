#include "io/mesh/ply_source.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "io/errors.h"

namespace supple {
namespace {

class TextSource final : public PlySource {
 public:
  explicit TextSource(TextScanner& scanner) : scanner_(scanner) {}

  void begin_row(std::string_view name, long long row) override {
    scanner_.set_subject(name, row);
    scanner_.require_line();
  }
  void end_row() override { scanner_.expect_line_end(); }
  double next(PlyType type) override {
    if (!is_integer(type)) return scanner_.number();
    const long long value = scanner_.integer();
    if (!can_hold(type, value)) fail(fmt::format("{} does not fit the type in the header", value));
    return static_cast<double>(value);
  }
  void skip(PlyType) override { scanner_.word(); }
  bool at_end() override { return !scanner_.next_line(); }
  [[noreturn]] void fail(std::string_view message) const override { scanner_.fail(message); }

 private:
  TextScanner& scanner_;
};

class BinarySource final : public PlySource {
 public:
  BinarySource(const FileBytes& file, std::size_t body_bytes, bool swapped)
      : file_(file),
        end_(file.bytes.data() + file.bytes.size()),
        next_(end_ - body_bytes),
        swapped_(swapped) {}

  void begin_row(std::string_view name, long long row) override { name_ = name, row_ = row; }
  void end_row() override {}

  double next(PlyType type) override {
    switch (type) {
      case PlyType::int8:
        return take<std::int8_t>();
      case PlyType::uint8:
        return take<std::uint8_t>();
      case PlyType::int16:
        return take<std::int16_t>();
      case PlyType::uint16:
        return take<std::uint16_t>();
      case PlyType::int32:
        return take<std::int32_t>();
      case PlyType::uint32:
        return take<std::uint32_t>();
      case PlyType::float32:
        return take<float>();
      case PlyType::float64:
        return take<double>();
    }
    return 0;
  }

  void skip(PlyType type) override {
    require(byte_size(type));
    next_ += byte_size(type);
  }

  bool at_end() override { return next_ == end_; }

  [[noreturn]] void fail(std::string_view message) const override {
    throw InputError(fmt::format("{}: byte {}: {} {}: {}", file_.name, number_ - file_.bytes.data(),
                                 name_, row_, message));
  }

 private:
  void require(std::size_t bytes) {
    number_ = next_;
    if (static_cast<std::size_t>(end_ - next_) < bytes) fail("the file is cut short");
  }

  template <class Number>
  double take() {
    require(sizeof(Number));
    char bytes[sizeof(Number)];
    std::memcpy(bytes, next_, sizeof(Number));
    next_ += sizeof(Number);
    if (swapped_) std::reverse(bytes, bytes + sizeof(Number));
    Number number;
    std::memcpy(&number, bytes, sizeof(Number));
    return static_cast<double>(number);
  }

  const FileBytes& file_;
  const char *end_, *next_;
  const char* number_ = next_;  ///< where the last number begins
  bool swapped_;
  std::string_view name_;
  long long row_ = 0;
};

}  // namespace

long long PlySource::next_count(PlyType type) {
  const double count = next(type);
  if (count < 0) fail(fmt::format("a list of {} values", count));
  return static_cast<long long>(count);
}

void PlySource::skip(const PlyProperty& property) {
  if (!property.is_list) return skip(property.type);
  for (long long left = next_count(property.count_type); left > 0; --left) skip(property.type);
}

std::unique_ptr<PlySource> open_ply_body(const FileBytes& file, TextScanner& scanner,
                                         PlyFormat format) {
  if (format == PlyFormat::ascii) return std::make_unique<TextSource>(scanner);
  const auto host =
      std::endian::native == std::endian::little ? PlyFormat::little_endian : PlyFormat::big_endian;
  return std::make_unique<BinarySource>(file, scanner.bytes_left(), format != host);
}

}  // namespace supple
