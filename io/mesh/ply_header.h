#pragma once

#include <string>
#include <vector>

#include "io/mesh/text_scanner.h"

namespace supple {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t byte_size(PlyType type);
bool is_integer(PlyType type);
/// Whether an integer type can hold `value`.
bool can_hold(PlyType type, long long value);

enum class PlyFormat { ascii, little_endian, big_endian };

struct PlyProperty {
  std::string name;
  PlyType type;  ///< of the value, or of a list's members
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  ///< of a list's length
};

/// A table of the file: `count` rows with the same properties.
struct PlyElement {
  std::string name;
  long long count = 0;
  std::vector<PlyProperty> properties;

  /// Column of a property by name; −1 where there is none.
  int find(std::string_view property) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;

  /// nullptr where there is none.
  const PlyElement* find(std::string_view element) const;
};

/// Reads from the first line to `end_header`; the body is what the scanner has left. No element
/// has more rows than the body can hold.
/// Errors: InputError with file and line.
PlyHeader read_ply_header(TextScanner& scanner);

}  // namespace supple
