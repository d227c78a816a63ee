#pragma once

#include <filesystem>
#include <string>

namespace supple {

/// A folder for outputs, made where there is none. One that was made goes again with the object
/// where nothing came into it.
class OutputFolder {
 public:
  /// Errors: OutputError where it cannot be made, or is a file.
  explicit OutputFolder(std::filesystem::path path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
  bool made_ = false;
};

}  // namespace supple
