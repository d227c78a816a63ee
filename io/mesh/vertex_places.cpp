#include "io/mesh/vertex_places.h"

#include <map>

#include <fmt/format.h>

#include "io/errors.h"
#include "io/mesh/text_scanner.h"

namespace supple {
namespace {

struct Listed {
  Vec3 place;
  int line;
};

int read_vertex(TextScanner& scanner, Index vertex_count) {
  const long long vertex = scanner.integer();
  if (vertex < 0 || vertex >= vertex_count)
    scanner.fail(fmt::format("there is no vertex {}; the shape has vertices 0 to {}", vertex,
                             vertex_count - 1));
  return static_cast<int>(vertex);
}

Vec3 read_place(TextScanner& scanner) {
  Vec3 place;
  for (double& coordinate : place) coordinate = scanner.number();
  scanner.expect_line_end();
  return place;
}

}  // namespace

VertexPlaces read_vertex_places(const std::filesystem::path& path, Index vertex_count) {
  const FileBytes file = read_file_bytes(path);
  require_text(file);
  TextScanner scanner(file, {.comment = '#'});
  std::map<int, Listed> listed;
  while (scanner.next_line()) {
    scanner.set_subject("", 0);
    const int vertex = read_vertex(scanner, vertex_count);
    scanner.set_subject("vertex", vertex);
    const auto [known, is_new] = listed.emplace(vertex, Listed{Vec3::Zero(), scanner.line()});
    if (!is_new)
      scanner.fail(fmt::format("is listed twice; line {} has it already", known->second.line));
    known->second.place = read_place(scanner);
  }
  if (listed.empty())
    throw InputError(
        fmt::format("{}: lists no vertex; allowed: lines \"number x y z\"", file.name));
  VertexPlaces places;
  places.places.resize(static_cast<Index>(listed.size()), 3);
  for (const auto& [vertex, entry] : listed) {
    places.places.row(static_cast<Index>(places.vertices.size())) = entry.place.transpose();
    places.vertices.push_back(vertex);
  }
  return places;
}

}  // namespace supple
