#pragma once

#include <algorithm>

#include "solver/core/stopwatch.h"

namespace supple {

/// A span of time that begins with its birth.
class Deadline {
 public:
  /// `seconds` ≥ 0; infinity: never over.
  explicit Deadline(double seconds) : seconds_(seconds) {}

  double left() const { return std::max(0.0, seconds_ - watch_.seconds()); }  ///< [s]
  bool over() const { return left() == 0; }

 private:
  Stopwatch watch_;
  double seconds_;
};

}  // namespace supple
