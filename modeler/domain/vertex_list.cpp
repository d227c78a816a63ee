#include "modeler/domain/vertex_list.h"

#include <charconv>
#include <sstream>
#include <string>

#include <fmt/format.h>

#include "io/errors.h"
#include "io/file_bytes.h"
#include "io/scene/complaint.h"

namespace supple {

namespace {

int to_vertex(const std::string& word, int vertex_count, const Place& place) {
  long long number = 0;
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, number);
  if (stop != end || error == std::errc::invalid_argument)
    complain(place, fmt::format("{} is not a vertex number; allowed: whole numbers from 0 to {}",
                                in_quotes(word), vertex_count - 1));
  if (error == std::errc::result_out_of_range || number < 0 || number >= vertex_count)
    complain(place, fmt::format("there is no vertex {}; the shape has vertices 0 to {}", word,
                                vertex_count - 1));
  return static_cast<int>(number);
}

/// The file's text; where it cannot be read, told with the place that names the file.
std::string read_list(const std::filesystem::path& path, const Place& place) {
  try {
    return read_regular_file(path);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: the vertex list {}", to_string(place), error.what()));
  }
}

}  // namespace

std::vector<char> read_vertex_list(const std::filesystem::path& path, int vertex_count,
                                   const Place& place) {
  std::istringstream file(read_list(path, place));
  std::vector<char> listed(vertex_count, 0);
  constexpr const char* blanks = " \t\r\v\f";
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    line.resize(std::min(line.find('#'), line.size()));
    for (std::size_t at = line.find_first_not_of(blanks); at != std::string::npos;) {
      const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
      const Place word{path.string(), number, static_cast<int>(at) + 1};
      listed[to_vertex(line.substr(at, end - at), vertex_count, word)] = 1;
      at = line.find_first_not_of(blanks, end);
    }
  }
  return listed;
}

}  // namespace supple
