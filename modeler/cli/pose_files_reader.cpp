#include "modeler/cli/pose_files_reader.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "io/mesh/mesh_files.h"
#include "io/scene/complaint.h"

namespace supple {
namespace {

/// What `read` gives; where it cannot, with the place in the scene that names the file.
template <class Read>
auto read_named(const NamedFile& file, const Read& read) {
  try {
    return read();
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", to_string(file.place), error.what()));
  }
}

/// The positions in a mesh or a cloud that has as many vertices as the shape.
Points read_positions(const NamedFile& file, std::string_view key, const Scene& scene,
                      Index vertices) {
  Points positions =
      read_named(file, [&] { return read_mesh(scene.folder / file.path).positions; });
  if (positions.rows() != vertices)
    complain(file.place, fmt::format("{}: {} has {} vertices, the shape {}; allowed: another pose "
                                     "of the same vertices",
                                     key, file.path, positions.rows(), vertices));
  return positions;
}

VertexPlaces read_targets(const HandleSpec& handle, const Scene& scene, Index vertices) {
  if (!handle.to) return {};
  const NamedFile& file = *handle.to;
  if (!can_write_mesh(file.path))
    return read_named(file, [&] { return read_vertex_places(scene.folder / file.path, vertices); });
  if (!handle.move)
    complain(file.place, fmt::format("move is missing beside to: {}: which of its vertices count; "
                                     "allowed without it: text with lines \"number x y z\"",
                                     file.path));
  VertexPlaces all{std::vector<int>(static_cast<std::size_t>(vertices)),
                   read_positions(file, "to", scene, vertices)};
  std::iota(all.vertices.begin(), all.vertices.end(), 0);
  return all;
}

}  // namespace

PoseFiles read_pose_files(const Scene& scene, Index vertices) {
  PoseFiles files;
  const PoseSpec& pose = *scene.pose;
  if (pose.from) files.from = read_positions(*pose.from, "pose.from", scene, vertices);
  const auto has_targets = [](const HandleSpec& handle) { return handle.to.has_value(); };
  if (std::none_of(pose.handles.begin(), pose.handles.end(), has_targets)) return files;
  for (const HandleSpec& handle : pose.handles)
    files.targets.push_back(read_targets(handle, scene, vertices));
  return files;
}

}  // namespace supple
