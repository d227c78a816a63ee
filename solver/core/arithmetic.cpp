#include "solver/core/arithmetic.h"

namespace supple {

PlainArithmetic::PlainArithmetic() {
  std::fegetenv(&before_);
  std::fesetenv(FE_DFL_ENV);
}

PlainArithmetic::~PlainArithmetic() {
  std::fesetenv(&before_);
}

}  // namespace supple
