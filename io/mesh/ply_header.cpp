#include "io/mesh/ply_header.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace supple {
namespace {

struct NamedType {
  std::string_view name, other_name;
  PlyType type;
  std::size_t bytes;
};

constexpr std::array<NamedType, 8> known_types = {{
    {"char", "int8", PlyType::int8, 1},
    {"uchar", "uint8", PlyType::uint8, 1},
    {"short", "int16", PlyType::int16, 2},
    {"ushort", "uint16", PlyType::uint16, 2},
    {"int", "int32", PlyType::int32, 4},
    {"uint", "uint32", PlyType::uint32, 4},
    {"float", "float32", PlyType::float32, 4},
    {"double", "float64", PlyType::float64, 8},
}};

PlyType type_named(std::string_view name, const TextScanner& scanner) {
  for (const NamedType& known : known_types)
    if (name == known.name || name == known.other_name) return known.type;
  scanner.fail(
      fmt::format("\"{}\" is no type of PLY: char uchar short ushort int uint float double",
                  name.substr(0, 40)));
}

PlyFormat read_format(TextScanner& scanner) {
  constexpr std::pair<std::string_view, PlyFormat> known_formats[] = {
      {"ascii", PlyFormat::ascii},
      {"binary_little_endian", PlyFormat::little_endian},
      {"binary_big_endian", PlyFormat::big_endian}};
  const std::string_view name = scanner.word();
  scanner.expect("1.0");
  for (const auto& [known, format] : known_formats)
    if (name == known) return format;
  scanner.fail("the format is not ascii, binary_little_endian or binary_big_endian");
}

PlyProperty read_property(TextScanner& scanner, const PlyElement& element) {
  PlyProperty property;
  std::string_view type = scanner.word();
  property.is_list = type == "list";
  if (property.is_list) {
    property.count_type = type_named(scanner.word(), scanner);
    type = scanner.word();
  }
  property.type = type_named(type, scanner);
  property.name = scanner.word();
  if (property.is_list && !is_integer(property.count_type))
    scanner.fail("the length of a list is not an integer type");
  if (element.find(property.name) >= 0)
    scanner.fail(fmt::format("property \"{}\" stands twice", property.name));
  return property;
}

PlyElement read_element(TextScanner& scanner, const PlyHeader& header) {
  PlyElement element;
  element.name = scanner.word();
  element.count = scanner.integer();
  if (header.find(element.name))
    scanner.fail(fmt::format("element \"{}\" stands twice", element.name));
  if (element.count < 0) scanner.fail("the count is negative");
  return element;
}

/// The least bytes that a row can have.
std::size_t least_row_bytes(const PlyElement& element, PlyFormat format) {
  std::size_t bytes = 0;
  for (const PlyProperty& property : element.properties)
    bytes += format == PlyFormat::ascii ? 2  // a digit and a blank
             : property.is_list         ? byte_size(property.count_type)
                                        : byte_size(property.type);
  return bytes;
}

void check_counts(const PlyHeader& header, const TextScanner& scanner) {
  // The last number of a text needs no blank after it.
  std::size_t left = scanner.bytes_left() + (header.format == PlyFormat::ascii ? 1 : 0);
  for (const PlyElement& element : header.elements) {
    const std::size_t row = least_row_bytes(element, header.format);
    const auto count = static_cast<std::size_t>(element.count);
    if (row == 0 && count > 0)
      scanner.fail(fmt::format("element \"{}\" has no properties", element.name));
    if (count == 0) continue;
    if (count > left / row || element.count > std::numeric_limits<int>::max())
      scanner.fail(
          fmt::format("the file is cut short: element \"{}\" has {} rows of at least {} "
                      "bytes, the file has {} bytes for them",
                      element.name, count, row, left));
    left -= count * row;
  }
}

}  // namespace

std::size_t byte_size(PlyType type) {
  return known_types[static_cast<std::size_t>(type)].bytes;
}

bool is_integer(PlyType type) {
  return type != PlyType::float32 && type != PlyType::float64;
}

bool can_hold(PlyType type, long long value) {
  const bool is_signed = type == PlyType::int8 || type == PlyType::int16 || type == PlyType::int32;
  const long long values = 1ll << (8 * byte_size(type));
  const long long least = is_signed ? -values / 2 : 0;
  return value >= least && value < least + values;
}

int PlyElement::find(std::string_view property) const {
  const auto found = std::find_if(properties.begin(), properties.end(),
                                  [&](const PlyProperty& p) { return p.name == property; });
  return found == properties.end() ? -1 : static_cast<int>(found - properties.begin());
}

const PlyElement* PlyHeader::find(std::string_view element) const {
  const auto found = std::find_if(elements.begin(), elements.end(),
                                  [&](const PlyElement& e) { return e.name == element; });
  return found == elements.end() ? nullptr : &*found;
}

PlyHeader read_ply_header(TextScanner& scanner) {
  PlyHeader header;
  bool has_format = false;
  scanner.require_line();
  if (scanner.rest() != "ply") scanner.fail("the first line is not \"ply\"");
  for (;;) {
    scanner.require_line();
    const std::string_view keyword = scanner.word();
    if (keyword == "end_header") break;
    if (keyword == "comment" || keyword == "obj_info") continue;
    if (keyword == "format") {
      header.format = read_format(scanner);
      has_format = true;
    } else if (keyword == "element") {
      header.elements.push_back(read_element(scanner, header));
    } else if (keyword == "property" && !header.elements.empty()) {
      PlyElement& element = header.elements.back();
      element.properties.push_back(read_property(scanner, element));
    } else {
      scanner.fail(fmt::format("\"{}\" does not belong here in the header", keyword.substr(0, 40)));
    }
    scanner.expect_line_end();
  }
  scanner.expect_line_end();
  if (!has_format) scanner.fail("the header has no line \"format\"");
  check_counts(header, scanner);
  return header;
}

}  // namespace supple
