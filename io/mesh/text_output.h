#pragma once

#include <utility>

#include <fmt/format.h>

#include "io/output_file.h"
#include "solver/core/types.h"

namespace supple {

/// Formats straight into a file. A double gets the fewest digits that read back as itself.
template <class... Values>
void print(OutputFile& file, fmt::format_string<Values...> format, Values&&... values) {
  fmt::memory_buffer line;
  fmt::format_to(fmt::appender(line), format, std::forward<Values>(values)...);
  file.write({line.data(), line.size()});
}

/// The numbers of a row, with a blank before each.
template <class Row>
void print_numbers(OutputFile& file, const Row& row) {
  for (Index column = 0; column < row.size(); ++column) print(file, " {}", row[column]);
}

}  // namespace supple
