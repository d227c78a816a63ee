#include "io/file_bytes.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/errors.h"

namespace supple {
namespace {

[[noreturn]] void fail_input(const std::filesystem::path& path, std::string_view why) {
  throw InputError(fmt::format("{}: cannot read: {}", path.string(), why));
}

/// An open file for reading that closes itself.
class InputDescriptor {
 public:
  explicit InputDescriptor(const std::filesystem::path& path) : path_(path) {
    // O_NONBLOCK: a pipe without a writer must not make us wait before it is refused.
    descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor_ < 0) fail(::strerrordesc_np(errno));
  }
  ~InputDescriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  InputDescriptor(const InputDescriptor&) = delete;
  InputDescriptor& operator=(const InputDescriptor&) = delete;

  std::size_t checked_size(std::size_t most_bytes) const {
    struct stat status;
    if (::fstat(descriptor_, &status) != 0) fail(::strerrordesc_np(errno));
    if (S_ISDIR(status.st_mode)) fail("it is a folder");
    if (!S_ISREG(status.st_mode)) fail("it is not a regular file");
    const auto size = static_cast<std::size_t>(status.st_size);
    if (size > most_bytes) fail(fmt::format("it has {} bytes, more than {}", size, most_bytes));
    return size;
  }

  void read(std::string& bytes) const {
    std::size_t have = 0;
    while (have < bytes.size()) {
      const ssize_t got = ::read(descriptor_, bytes.data() + have, bytes.size() - have);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) fail(::strerrordesc_np(errno));
      if (got == 0) fail("it became shorter while it was read");
      have += static_cast<std::size_t>(got);
    }
  }

 private:
  [[noreturn]] void fail(std::string_view why) const { fail_input(path_, why); }

  const std::filesystem::path& path_;
  int descriptor_ = -1;
};

}  // namespace

std::string read_regular_file(const std::filesystem::path& path, std::size_t most_bytes) {
  const InputDescriptor input(path);
  std::string bytes(input.checked_size(most_bytes), '\0');
  input.read(bytes);
  return bytes;
}

FileBytes read_file_bytes(const std::filesystem::path& path) {
  FileBytes file{.name = path.string(), .bytes = read_regular_file(path)};
  if (file.bytes.empty()) fail_input(path, "the file is empty");
  return file;
}

}  // namespace supple
