#pragma once

#include <string>
#include <vector>

#include "io/mesh/text_scanner.h"

namespace supple {

/// A number, or `count` of them, that every point has.
struct PcdField {
  std::string name;
  char type = 'F';  ///< F: float, I: signed, U: unsigned
  int size = 4;     ///< [bytes] of one number
  int count = 1;
  std::size_t offset = 0;  ///< [bytes] of the fields before it

  std::size_t bytes() const { return static_cast<std::size_t>(size) * count; }
};

enum class PcdData { ascii, binary, compressed };

struct PcdHeader {
  std::vector<PcdField> fields;
  long long points = 0;
  PcdData data = PcdData::ascii;
  bool has_viewpoint = false;  ///< other than the origin

  /// −1 where there is none.
  int find(std::string_view name) const;
  /// [bytes] of one point in binary
  std::size_t stride() const { return fields.back().offset + fields.back().bytes(); }
  /// Numbers of one point.
  long long numbers() const;
};

/// Reads from the first line to DATA; the body is what the scanner has left.
/// Errors: InputError with file and line.
PcdHeader read_pcd_header(TextScanner& scanner);

}  // namespace supple
