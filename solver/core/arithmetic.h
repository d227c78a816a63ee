#pragma once

#include <cfenv>

#include "solver/core/export.h"

namespace supple {

// Checks for NaN and sums that are the same everywhere need arithmetic as written.
static_assert(__FINITE_MATH_ONLY__ == 0, "Supple cannot be compiled with -ffast-math");

/// Rounding to nearest, and denormal numbers as they are, in this thread as long as it lives,
/// whatever the program that calls us has set; parallel_chunks() takes it along to its threads.
class SUPPLE_API PlainArithmetic {
 public:
  PlainArithmetic();
  ~PlainArithmetic();
  PlainArithmetic(const PlainArithmetic&) = delete;
  PlainArithmetic& operator=(const PlainArithmetic&) = delete;

 private:
  std::fenv_t before_;
};

}  // namespace supple
