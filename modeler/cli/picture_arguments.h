#pragma once

#include "io/picture/picture.h"
#include "modeler/cli/command_line.h"

namespace supple {

/// --camera, --up and --size, for every command that draws.
class PictureArguments {
 public:
  /// Declares the options; `*this` must outlive the parsing.
  void declare(CommandLine& line);

  const PictureOptions& options() const { return options_; }

 private:
  void set_camera(const std::string& value);
  void set_up(const std::string& value);
  void set_size(const std::string& value);

  PictureOptions options_;
};

/// Errors: UsageError where `path`, given for `option`, does not end in .png.
void check_picture_name(const std::string& path, std::string_view option);

}  // namespace supple
