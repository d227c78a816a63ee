#include "modeler/study/knobs.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <fmt/format.h>

#include "io/errors.h"
#include "io/scene/complaint.h"
#include "io/scene/scene_item.h"

namespace supple {
namespace {

template <class T>
concept Struct = requires(T& value) {
  T::describe(value, [](std::string_view, auto&, const Described&) {});
};

/// From coarse to fine, the scene's own value where it belongs.
struct Values {
  std::vector<double> numbers;
  std::size_t own = 0;
};

/// Few digits, whole decades where the range spans many.
double rounded(double value, double ratio) {
  constexpr double many_decades = 1e3;
  const double decade = std::floor(std::log10(value));
  if (ratio > many_decades || ratio < 1 / many_decades)
    return std::pow(10, std::round(std::log10(value)));
  const double digit = std::pow(10, decade - 2);
  return std::round(value / digit) * digit;
}

bool about_equal(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::abs(b);
}

/// Puts the own value into its place; `falls` where fine values are small.
Values with_own(std::vector<double> numbers, double own, bool falls) {
  std::erase_if(numbers, [&](double number) { return about_equal(number, own); });
  const auto later = [&](double number) { return falls ? number < own : number > own; };
  const auto at = std::find_if(numbers.begin(), numbers.end(), later);
  Values values;
  values.own = static_cast<std::size_t>(at - numbers.begin());
  numbers.insert(at, own);
  values.numbers = std::move(numbers);
  return values;
}

Values range_values(const Described& described, double own, int levels) {
  const double from = described.sweep.from, ratio = described.sweep.to / from;
  std::vector<double> numbers;
  for (int k = 0; k < levels; ++k) {
    const double number = rounded(from * std::pow(ratio, k / std::max(1.0, levels - 1.0)), ratio);
    // A power of ten has rounding errors of its own; its text has none.
    numbers.push_back(std::stod(fmt::format("{:.3g}", number)));
  }
  return with_own(std::move(numbers), own, ratio < 1);
}

Values doubled_values(const Described& described, double own, int levels) {
  std::vector<double> numbers;
  for (int k = -1; k < levels - 1; ++k) {
    const double number = std::round(own * std::pow(2, k));
    if (number >= described.min && number <= described.max) numbers.push_back(number);
  }
  return with_own(std::move(numbers), own, false);
}

template <class E>
void fill_names(Knob& knob, E own) {
  for (const auto& [value, name] : enum_names(E{})) {
    if (value == own) knob.own = knob.values.size();
    knob.values.emplace_back(name);
  }
}

template <class Number>
void fill_numbers(Knob& knob, Number own, const Described& described, int levels) {
  knob.converges = described.sweep.kind == Sweep::Kind::doubles;
  Values values = knob.converges ? doubled_values(described, static_cast<double>(own), levels)
                                 : range_values(described, static_cast<double>(own), levels);
  for (const double number : values.numbers)
    knob.values.push_back(fmt::format("{}", static_cast<Number>(number)));
  if (described.sweep.exact != 0)
    knob.exact = fmt::format("{}", static_cast<Number>(described.sweep.exact));
  knob.numbers = std::move(values.numbers);
  knob.own = values.own;
}

/// Visits the members of one struct of the scene and the structs in it.
class KnobCollector {
 public:
  KnobCollector(std::string path, int levels, std::vector<Knob>& knobs)
      : path_(std::move(path)), levels_(levels), knobs_(knobs) {}

  template <class T>
  void operator()(std::string_view name, const T& value, const Described& described) {
    if constexpr (Struct<const T>)
      T::describe(value, KnobCollector(joined_path(path_, name), levels_, knobs_));
    else if constexpr (std::is_enum_v<T> || std::is_arithmetic_v<T>)
      add(name, value, described);
  }

  /// A member that is left open counts with what the program takes for it.
  template <class T>
  void operator()(std::string_view name, const std::optional<T>& value,
                  const Described& described) {
    if (value)
      (*this)(name, *value, described);
    else if constexpr (std::is_arithmetic_v<T>)
      add(name, static_cast<T>(described.sweep.usual), described);
  }

 private:
  template <class T>
  void add(std::string_view name, T value, const Described& described) {
    if (described.sweep.kind == Sweep::Kind::none) return;
    Knob knob;
    knob.name = name;
    knob.key = joined_path(path_, name);
    if constexpr (std::is_enum_v<T>)
      fill_names(knob, value);
    else
      fill_numbers(knob, value, described, levels_);
    knobs_.push_back(std::move(knob));
  }

  std::string path_;
  int levels_;
  std::vector<Knob>& knobs_;
};

}  // namespace

std::vector<Knob> collect_knobs(const Scene& scene, int levels) {
  std::vector<Knob> knobs;
  Scene::describe(scene, KnobCollector("", levels, knobs));
  return knobs;
}

std::vector<Knob> choose_knobs(const std::vector<Knob>& knobs, std::span<const std::string> names,
                               std::string_view option) {
  std::vector<std::string_view> known;
  for (const Knob& knob : knobs) known.push_back(knob.name);
  for (const std::string& name : names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw UsageError(fmt::format("{}: {} is not a knob of this scene{}", option, in_quotes(name),
                                   allowed_names(name, known)));
  if (names.empty()) return knobs;
  std::vector<Knob> chosen;
  for (const Knob& knob : knobs)
    if (std::find(names.begin(), names.end(), knob.name) != names.end()) chosen.push_back(knob);
  return chosen;
}

}  // namespace supple
