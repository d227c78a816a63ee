#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "solver/core/types.h"

namespace supple {

/// Where a value stands in what the user wrote; `file` is "command line" for arguments.
struct Place {
  std::string file;
  int line = 0, column = 0;  ///< from 1, in bytes; 0 where there is none
};

/// "scene.yaml:3:7", or "command line".
std::string to_string(const Place& place);

/// A length as the user gave it: in the file's units, or in percent of the shape's bounding-box
/// diagonal. Stays so until the plan knows the shape.
struct Length {
  enum class Unit { file, percent };
  double value = 0;
  Unit unit = Unit::file;
};

/// A vector (percents without the centre) or a point (percents from the box's centre).
using LengthVector = std::array<Length, 3>;

/// The Described::unit of vectors of factors, where one number stands for all three.
inline constexpr std::string_view factor_unit = "×";

/// "0.3", "-5%".
std::string to_string(const Length& length);

/// `length` in the file's units, for a shape of that diagonal.
double resolve(const Length& length, double diagonal);
Vec3 resolve_vector(const LengthVector& vector, double diagonal);

/// A point that has a percent in it is measured from the box's centre, else from the origin.
Vec3 resolve_point(const LengthVector& point, const Box& box);

bool has_percent(const LengthVector& vector);

/// The finite number that all of `text` is, with '.' for the decimal point whatever the locale.
std::optional<double> to_number(std::string_view text);

/// The length that all of `text` is.
std::optional<Length> to_length(std::string_view text);

/// Reads "0.3", "-5%"; throws UsageError that names `place`, `what` (an option or a key, may be
/// empty), what is wrong and what is allowed.
Length parse_length(const std::string& text, const Place& place, std::string_view what = {});

/// Reads "0.3,0,5%"; errors as parse_length and check_units.
LengthVector parse_length_vector(const std::string& text, const Place& place,
                                 std::string_view what = {});

/// Throws UsageError where a vector mixes percents with other numbers that are not 0.
void check_units(const LengthVector& vector, const Place& place, std::string_view what = {});

}  // namespace supple
