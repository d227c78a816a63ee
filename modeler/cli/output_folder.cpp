#include "modeler/cli/output_folder.h"

#include <cerrno>
#include <fstream>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/errors.h"

namespace supple {

namespace fs = std::filesystem;

namespace {

/// " (process 1234)" that holds the lock of the open folder, where the system tells.
std::string holder(int descriptor) {
  struct stat folder;
  if (::fstat(descriptor, &folder) != 0) return {};
  const std::string inode = fmt::format(":{}", folder.st_ino);
  std::ifstream locks("/proc/locks");
  std::string number, kind, advisory, access, process, file, rest;
  while (locks >> number >> kind >> advisory >> access >> process >> file) {
    if (kind == "FLOCK" && file.ends_with(inode)) return fmt::format(" (process {})", process);
    std::getline(locks, rest);
  }
  return {};
}

}  // namespace

OutputFolder::OutputFolder(fs::path path) : path_(std::move(path)) {
  std::error_code error;
  if (fs::exists(path_, error) && !fs::is_directory(path_, error))
    throw OutputError(fmt::format("{}: cannot write: it is a file, not a folder", path_.string()));
  if (fs::create_directory(path_, error)) made_.emplace(path_.c_str());
  if (error)
    throw OutputError(
        fmt::format("{}: cannot make the folder: {}", path_.string(), error.message()));
  hold();
}

OutputFolder::~OutputFolder() {
  std::error_code not_empty;
  if (made_) fs::remove(path_, not_empty);
  if (descriptor_ >= 0) ::close(descriptor_);
}

void OutputFolder::hold() {
  descriptor_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ < 0 || ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  if (errno != EWOULDBLOCK) return;  // a file system without locks
  const std::string who = holder(descriptor_);
  ::close(descriptor_);
  throw OutputError(
      fmt::format("{}: cannot write: another run{} writes into this folder; wait for it, or name "
                  "another folder",
                  path_.string(), who));
}

}  // namespace supple
