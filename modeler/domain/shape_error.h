#pragma once

#include <stdexcept>

namespace supple {

/// A shape that cannot be what the scene asks of it (exit code 1): open, without volume ...
/// The message says what is wrong, where, and what would help.
class ShapeError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace supple
