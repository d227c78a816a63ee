#pragma once

#include <stdexcept>
#include <string>

#include "solver/core/export.h"

namespace supple {

/// A broken promise inside Supple itself: never the user's fault.
class SUPPLE_API InternalError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// Throws InternalError that names the broken condition and where it stands.
[[noreturn]] SUPPLE_API void fail_check(const char* condition, const char* file, int line,
                                        const std::string& detail);

}  // namespace supple

/// Holds in every build; stands where our own code hands values over.
#define SUPPLE_CHECK(condition, detail) \
  ((condition) ? void(0) : ::supple::fail_check(#condition, __FILE__, __LINE__, (detail)))
