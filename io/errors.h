#pragma once

#include <stdexcept>
#include <string>

namespace supple {

/// The command line or the scene is wrong (exit code 2). The message begins with
/// file:line:column where there is one, and names what is allowed.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An input cannot be read (exit code 3).
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The importer of foreign formats crashed, hung or asked for too much memory (exit code 4).
class ImporterError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An output cannot be written (exit code 3).
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace supple
