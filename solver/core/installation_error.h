#pragma once

#include <stdexcept>

#include "solver/core/export.h"

namespace supple {

/// A part of Supple that is loaded on first use is missing or does not load.
class SUPPLE_API InstallationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace supple
