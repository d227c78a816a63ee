#pragma once

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace supple {

/// The libraries that a program loaded, by what the loader said under LD_DEBUG=libs.
inline std::vector<std::filesystem::path> loaded_libraries(const std::string& messages) {
  const std::string before = "calling init: ";
  std::vector<std::filesystem::path> libraries;
  std::istringstream lines(messages);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(before);
    if (at != std::string::npos) libraries.emplace_back(line.substr(at + before.size()));
  }
  return libraries;
}

}  // namespace supple
