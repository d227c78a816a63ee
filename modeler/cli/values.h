#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace supple {

// Values of command-line options. All throw UsageError that names `option`, what is wrong and what
// is allowed.

/// One finite number.
double parse_number(const std::string& text, std::string_view option);

/// A whole number in [least, greatest].
int parse_count(const std::string& text, std::string_view option, int least, int greatest);

/// Finite numbers with commas between them; `form` shows what is allowed ("AX,AY,AZ,DEG").
std::vector<double> parse_numbers(const std::string& text, std::string_view option,
                                  std::string_view form);

/// A file of the command line, whatever folder the scene is in: relative to the working folder.
std::string absolute_path(const std::string& path);

}  // namespace supple
