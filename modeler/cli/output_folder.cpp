#include "modeler/cli/output_folder.h"

#include <system_error>

#include <fmt/format.h>

#include "io/errors.h"

namespace supple {

namespace fs = std::filesystem;

OutputFolder::OutputFolder(fs::path path) : path_(std::move(path)) {
  std::error_code error;
  if (fs::exists(path_, error) && !fs::is_directory(path_, error))
    throw OutputError(fmt::format("{}: cannot write: it is a file, not a folder", path_.string()));
  made_ = fs::create_directory(path_, error);
  if (error)
    throw OutputError(
        fmt::format("{}: cannot make the folder: {}", path_.string(), error.message()));
}

OutputFolder::~OutputFolder() {
  std::error_code not_empty;
  if (made_) fs::remove(path_, not_empty);
}

}  // namespace supple
