#pragma once

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "io/errors.h"
#include "io/output_file.h"

namespace supple {

static_assert(std::endian::native == std::endian::little,
              "the binary formats that we write are little-endian");

/// Appends the bytes of a number, little-endian.
template <class Number>
void append_binary(std::string& bytes, Number number) {
  char copy[sizeof(Number)];
  std::memcpy(copy, &number, sizeof(Number));
  bytes.append(copy, sizeof(Number));
}

/// `value` as float32.
/// Errors: OutputError where it is too large for that.
inline float checked_float(double value, const OutputFile& file) {
  if (std::abs(value) > std::numeric_limits<float>::max())
    throw OutputError(
        fmt::format("{}: cannot write: {} is too large for float32", file.path().string(), value));
  return static_cast<float>(value);
}

}  // namespace supple
