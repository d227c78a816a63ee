#include "io/scene/quantity.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "io/scene/complaint.h"

namespace supple {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string prefix(std::string_view what) {
  return what.empty() ? std::string() : fmt::format("{}: ", what);
}

}  // namespace

std::string to_string(const Place& place) {
  if (place.line <= 0) return place.file;
  return fmt::format("{}:{}:{}", place.file, place.line, place.column);
}

std::string to_string(const Length& length) {
  return fmt::format("{}{}", length.value, length.unit == Length::Unit::percent ? "%" : "");
}

double resolve(const Length& length, double diagonal) {
  return length.unit == Length::Unit::percent ? length.value / 100 * diagonal : length.value;
}

Vec3 resolve_vector(const LengthVector& vector, double diagonal) {
  return {resolve(vector[0], diagonal), resolve(vector[1], diagonal), resolve(vector[2], diagonal)};
}

Vec3 resolve_point(const LengthVector& point, const Box& box) {
  const Vec3 offset = resolve_vector(point, box.diagonal());
  return has_percent(point) ? Vec3(box.center() + offset) : offset;
}

bool has_percent(const LengthVector& vector) {
  return std::any_of(vector.begin(), vector.end(), [](const Length& component) {
    return component.unit == Length::Unit::percent;
  });
}

std::optional<double> to_number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<Length> to_length(std::string_view text) {
  Length length;
  if (!text.empty() && text.back() == '%') {
    length.unit = Length::Unit::percent;
    text.remove_suffix(1);
  }
  const std::optional<double> value = to_number(text);
  if (!value) return std::nullopt;
  length.value = *value;
  return length;
}

Length parse_length(const std::string& text, const Place& place, std::string_view what) {
  const std::optional<Length> length = to_length(trimmed(text));
  if (!length)
    complain(place, fmt::format("{}{} is not a length; allowed: a finite number in the file's "
                                "units (0.3) or in percent of the diagonal (30%)",
                                prefix(what), in_quotes(text)));
  return *length;
}

LengthVector parse_length_vector(const std::string& text, const Place& place,
                                 std::string_view what) {
  if (std::count(text.begin(), text.end(), ',') != 2)
    complain(place, fmt::format("{}{} is not a vector; allowed: three lengths with commas "
                                "between them (0.3,0,5%)",
                                prefix(what), in_quotes(text)));
  LengthVector vector;
  std::size_t start = 0;
  for (Length& component : vector) {
    const std::size_t comma = text.find(',', start);
    component = parse_length(text.substr(start, comma - start), place, what);
    start = comma + 1;
  }
  check_units(vector, place, what);
  return vector;
}

void check_units(const LengthVector& vector, const Place& place, std::string_view what) {
  if (!has_percent(vector)) return;
  for (const Length& component : vector)
    if (component.unit == Length::Unit::file && component.value != 0)
      complain(place, fmt::format("{}{} stands beside a percent; allowed: all three in percent, "
                                  "or 0 beside percents, or none in percent",
                                  prefix(what), to_string(component)));
}

}  // namespace supple
