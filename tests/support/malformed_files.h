#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "io/mesh/mesh_files.h"
#include "tests/support/temporary_folder.h"

namespace supple {

struct Malformed {
  std::string file;
  std::string bytes;
  std::string words;  ///< what the message must say after the file's name
};

/// Each is refused with a message that begins with its path.
inline void expect_refused(const std::vector<Malformed>& cases) {
  const TemporaryFolder folder;
  for (const Malformed& malformed : cases) {
    SCOPED_TRACE(malformed.file + ": " + malformed.words);
    const std::filesystem::path path = folder.put(malformed.file, malformed.bytes);
    const std::string message = message_of<InputError>([&] { read_mesh(path); });
    EXPECT_EQ(message.rfind(path.string(), 0), 0u) << message;
    EXPECT_NE(message.find(malformed.words), std::string::npos) << message;
  }
}

}  // namespace supple
