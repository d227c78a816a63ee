#include "modeler/cli/read_shape.h"

#include <fmt/format.h>

#include "io/mesh/mesh_files.h"

namespace supple {

Mesh read_shape(const Scene& scene) {
  Mesh shape = read_mesh(scene.folder / scene.shape.file());
  if (scene.shape.points.empty() || shape.face_count() == 0) return shape;
  shape.notes.push_back(
      fmt::format("{} faces are left out: shape.points takes vertices alone", shape.face_count()));
  return points_of(std::move(shape));
}

}  // namespace supple
