#pragma once

#include <optional>

#include "io/scene/shape_spec.h"
#include "modeler/cli/command_line.h"
#include "modeler/cli/inside_picture.h"

namespace supple {

/// --particles and --spacing, and --show, for commands that look inside a shape.
class InsideArguments {
 public:
  /// Declares the options; `*this` must outlive the parsing.
  void declare(CommandLine& line);

  /// Errors: UsageError where both a number and a spacing are given.
  ShapeSpec spec() const;

  const std::optional<Inside>& shown() const { return shown_; }

  /// True where a number or a spacing was given.
  bool has_particles() const { return spec_.particles || spec_.spacing; }

 private:
  void show(const std::string& value);

  ShapeSpec spec_;
  std::optional<Inside> shown_;
};

}  // namespace supple
