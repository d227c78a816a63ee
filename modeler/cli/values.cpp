#include "modeler/cli/values.h"

#include <charconv>
#include <filesystem>

#include <fmt/format.h>

#include "io/errors.h"
#include "io/scene/complaint.h"
#include "io/scene/quantity.h"

namespace supple {

double parse_number(const std::string& text, std::string_view option) {
  const std::optional<double> value = to_number(text);
  if (!value)
    throw UsageError(fmt::format("{}: {} is not a finite number", option, in_quotes(text)));
  return *value;
}

int parse_count(const std::string& text, std::string_view option, int least, int greatest) {
  int value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || value < least || value > greatest)
    throw UsageError(fmt::format("{}: {} is not allowed; allowed: a whole number from {} to {}",
                                 option, in_quotes(text), least, greatest));
  return value;
}

std::vector<double> parse_numbers(const std::string& text, std::string_view option,
                                  std::string_view form) {
  std::vector<double> numbers;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    const std::optional<double> number = to_number(text.substr(start, end - start));
    if (!number)
      throw UsageError(fmt::format("{}: {} is not allowed; allowed: finite numbers as {}", option,
                                   in_quotes(text), form));
    numbers.push_back(*number);
    start = end + 1;
  }
  return numbers;
}

std::string absolute_path(const std::string& path) {
  return std::filesystem::absolute(path).string();
}

}  // namespace supple
