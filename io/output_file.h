#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "io/unfinished.h"

namespace supple {

/// A file that appears whole or not at all: bytes go to a temporary beside `path`, which takes
/// its place only in commit(), after every write and the close were checked. Without a commit
/// the temporary is removed and what stood at `path` stays. A link at `path` stays a link, a
/// file keeps its permissions; a device or a pipe is written to as it is. The path "-" stands for
/// standard output.
class OutputFile {
 public:
  /// Errors (here and below): OutputError that names `path` and what the system said.
  explicit OutputFile(std::filesystem::path path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view bytes);
  void commit();

  /// Where the file will stand.
  const std::filesystem::path& path() const { return path_; }

 private:
  void flush();
  [[noreturn]] void fail(std::string_view action);

  std::filesystem::path path_, temporary_;
  std::optional<Unfinished> unfinished_;
  std::string buffer_;
  int descriptor_ = -1;
};

/// Throws OutputError at once where `path` could not be written later: its folder is missing
/// or not writable, or it is itself a folder. Leaves nothing behind.
void check_writable(const std::filesystem::path& path);

}  // namespace supple
