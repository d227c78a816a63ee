#include "solver/core/check.h"

#include <fmt/format.h>

namespace supple {

void fail_check(const char* condition, const char* file, int line, const std::string& detail) {
  throw InternalError(fmt::format("{}:{}: {} does not hold: {}", file, line, condition, detail));
}

}  // namespace supple
