#pragma once

namespace supple {

/// How many derivatives are wanted.
enum class Derivatives { none, first, second };

}  // namespace supple
