#pragma once

#include <vector>

#include "solver/core/describe.h"

namespace supple {

/// All values of an enumeration that has names.
template <class E>
std::vector<E> all_of() {
  std::vector<E> values;
  for (const auto& [value, name] : enum_names(E{})) values.push_back(value);
  return values;
}

}  // namespace supple
