#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "io/unfinished.h"

namespace supple {

/// A folder for outputs, made where there is none, and held so that no two runs mix their files in
/// it. One that was made goes again with the object where nothing came into it.
class OutputFolder {
 public:
  /// Errors: OutputError where it cannot be made, is a file, or is held by another run.
  explicit OutputFolder(std::filesystem::path path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

 private:
  void hold();

  std::filesystem::path path_;
  int descriptor_ = -1;  ///< whose lock the system takes back however the run ends
  std::optional<Unfinished> made_;
};

}  // namespace supple
