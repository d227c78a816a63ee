#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/scene/scene.h"

namespace supple {

/// A member of the scene that a study varies.
struct Knob {
  std::string name;                 ///< "tolerance"
  std::string key;                  ///< "pose.tolerance"
  std::vector<std::string> values;  ///< as --set takes them, from coarse to fine
  std::vector<double> numbers;      ///< the same where they are numbers, else none
  std::size_t own = 0;              ///< which of them is the scene's own
  std::string exact;                ///< the value whose result counts as exact; empty: none
  bool converges = false;           ///< its results converge to the exact ones as it grows

  bool operator==(const Knob&) const = default;
};

/// The knobs of everything that is in the scene, as its members are described with a `sweep`;
/// with as many values, and the scene's own where it is not among them.
std::vector<Knob> collect_knobs(const Scene& scene, int levels);

/// Those with these names, in the order of `knobs`; all where no name is given.
/// Errors: UsageError that names `option`, the unknown name and the nearest.
std::vector<Knob> choose_knobs(const std::vector<Knob>& knobs, std::span<const std::string> names,
                               std::string_view option);

}  // namespace supple
