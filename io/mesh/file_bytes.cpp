#include "io/mesh/file_bytes.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/errors.h"

namespace supple {
namespace {

constexpr off_t largest_file = off_t{1} << 32;

/// An open file for reading that closes itself.
class InputDescriptor {
 public:
  explicit InputDescriptor(const std::filesystem::path& path) : name_(path.string()) {
    // O_NONBLOCK: a pipe without a writer must not make us wait before it is refused.
    descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor_ < 0) fail(::strerrordesc_np(errno));
  }
  ~InputDescriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  InputDescriptor(const InputDescriptor&) = delete;
  InputDescriptor& operator=(const InputDescriptor&) = delete;

  std::size_t checked_size() const {
    struct stat status;
    if (::fstat(descriptor_, &status) != 0) fail(::strerrordesc_np(errno));
    if (S_ISDIR(status.st_mode)) fail("it is a folder");
    if (!S_ISREG(status.st_mode)) fail("it is not a regular file");
    if (status.st_size == 0) fail("the file is empty");
    if (status.st_size > largest_file)
      fail(fmt::format("it has {} bytes, more than {}", status.st_size, largest_file));
    return static_cast<std::size_t>(status.st_size);
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
  [[noreturn]] void fail(std::string_view why) const {
    throw InputError(fmt::format("{}: cannot read: {}", name_, why));
  }

  std::string name_;
  int descriptor_ = -1;
};

}  // namespace

FileBytes read_file_bytes(const std::filesystem::path& path) {
  const InputDescriptor input(path);
  FileBytes file{.name = path.string(), .bytes = {}};
  file.bytes.resize(input.checked_size());
  input.read(file.bytes);
  return file;
}

}  // namespace supple
