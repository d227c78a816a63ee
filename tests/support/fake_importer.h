#pragma once

#include "tests/support/temporary_folder.h"

namespace supple {

/// A program that stands in for `supple-import`: a shell script of these lines.
inline std::filesystem::path fake_importer(const TemporaryFolder& folder, std::string_view lines) {
  const std::filesystem::path path =
      folder.put("supple-import", "#!/bin/sh\n" + std::string(lines) + "\n");
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path;
}

}  // namespace supple
