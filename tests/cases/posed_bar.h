#pragma once

#include <string>

#include "io/scene/scene_reader.h"
#include "modeler/pose/pose.h"
#include "tests/support/shapes.h"

namespace supple {

/// The bar 1:1:4 along z from the origin; its coordinates are multiples of 1/8.
inline Mesh case_bar() {
  return make_bar({1, 1, 4}, {8, 8, 32});
}

inline double diagonal_of(const Mesh& mesh) {
  return bounding_box(mesh.positions).diagonal();
}

/// A scene of defaults with `handles`, entries of a YAML list from the line's start; they begin
/// in line 4.
inline std::string scene_text(const std::string& handles) {
  return "shape: {mesh: bar.obj}\npose:\n  handles:\n" + handles;
}

inline PoseResult pose_with(const Mesh& mesh, const std::string& handles) {
  return pose(mesh, read_scene_text(scene_text(handles), "scene.yaml", ""));
}

/// The longest row of a − b.
inline double greatest_distance(const Points& a, const Points& b) {
  return (a - b).rowwise().norm().maxCoeff();
}

}  // namespace supple
