#include "io/output_file.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/errors.h"
#include "solver/core/check.h"

namespace supple {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t buffer_size = 1 << 18;
constexpr mode_t new_file_mode = 0666;
constexpr const char* standard_output = "-";

[[noreturn]] void fail_output(const fs::path& path, std::string_view why) {
  throw OutputError(fmt::format("{}: cannot write: {}", path.string(), why));
}

/// What stands at `path`; a device or a pipe is written to, never replaced.
enum class Target { file, stream };

Target inspect_target(const fs::path& path) {
  if (path.empty()) throw OutputError("cannot write: the file has no name");
  if (path == standard_output) return Target::stream;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) fail_output(path, "it is a folder");
  if (!path.has_filename()) fail_output(path, "it names a folder, not a file");
  if (!fs::exists(status)) return Target::file;
  if (::faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) != 0)
    fail_output(path, ::strerrordesc_np(errno));
  return fs::is_regular_file(status) ? Target::file : Target::stream;
}

/// Never more open than the file that it will replace.
mode_t mode_of(const fs::path& path) {
  struct stat old;
  return ::stat(path.c_str(), &old) == 0 ? old.st_mode & new_file_mode : new_file_mode;
}

/// The file that `path` stands for: a link is followed, so that it stays a link.
fs::path follow_link(const fs::path& path) {
  std::error_code error;
  if (!fs::is_symlink(fs::symlink_status(path, error))) return path;
  const fs::path target = fs::weakly_canonical(path, error);
  return error ? path : target;
}

}  // namespace

OutputFile::OutputFile(fs::path path) : path_(std::move(path)) {
  if (inspect_target(path_) == Target::stream) {
    descriptor_ = path_ == standard_output ? ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0)
                                           : ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail("open");
    return;
  }
  path_ = follow_link(path_);
  for (int attempt = 0; descriptor_ < 0; ++attempt) {
    temporary_ = path_.parent_path() / fmt::format(".supple-{}-{}.tmp", ::getpid(), attempt);
    descriptor_ =
        ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode_of(path_));
    if (descriptor_ < 0 && errno != EEXIST) {
      temporary_.clear();
      fail("make a file in its folder");
    }
  }
  unfinished_.emplace(temporary_.c_str());
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void OutputFile::write(std::string_view bytes) {
  SUPPLE_CHECK(descriptor_ >= 0, "write after commit");
  buffer_.append(bytes);
  if (buffer_.size() >= buffer_size) flush();
}

void OutputFile::commit() {
  SUPPLE_CHECK(descriptor_ >= 0, "second commit");
  flush();
  if (!temporary_.empty()) {
    struct stat old;
    if (::stat(path_.c_str(), &old) == 0 && ::fchmod(descriptor_, old.st_mode & 07777) != 0)
      fail("keep the permissions");
    if (::fsync(descriptor_) != 0) fail("write");
  }
  if (::close(std::exchange(descriptor_, -1)) != 0) fail("close");
  if (temporary_.empty()) return;
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail("replace");
  unfinished_.reset();
  temporary_.clear();
}

void OutputFile::flush() {
  std::string_view rest = buffer_;
  while (!rest.empty()) {
    const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
    const bool is_stream = temporary_.empty();  // which may wait for ever; a signal ends that
    if (written < 0 && errno == EINTR && !is_stream) continue;
    if (written < 0) fail("write");
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  buffer_.clear();
}

void OutputFile::fail(std::string_view action) {
  const int code = errno;
  const char* name = ::strerrorname_np(code);
  const std::string file = path_ == standard_output ? "standard output" : path_.string();
  throw OutputError(fmt::format("{}: cannot {}: {} ({})", file, action, ::strerrordesc_np(code),
                                name ? name : "?"));
}

void check_writable(const fs::path& path) {
  if (inspect_target(path) == Target::file) OutputFile probe(path);
}

}  // namespace supple
