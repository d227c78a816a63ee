// Poses a tetrahedron by its tip, by two minimisers, and says what came of it.
#include <cstdio>
#include <string>

#include "io/scene/scene_reader.h"
#include "modeler/pose/pose.h"

int main() {
  supple::Mesh mesh;
  mesh.positions.resize(4, 3);
  mesh.positions << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  mesh.face_vertices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  mesh.face_starts = {0, 3, 6, 9, 12};
  // The trust region is in a library that is loaded when it is asked for.
  for (const std::string solver : {"lbfgs", "trust_region"}) {
    const supple::Scene scene = supple::read_scene_text(
        "shape: {mesh: tetrahedron.obj}\n"
        "pose: {handles: [{fix: z<10%}, {move: z>90%, by: [10%, 0, 0]}], solver: " +
            solver + "}\n",
        "scene.yaml", "");
    const supple::PoseResult result = supple::pose(mesh, scene);
    std::printf("%s: moved by %.3f\n", solver.c_str(),
                (result.mesh.positions - mesh.positions).row(3).norm());
    if (!result.report.usable()) return 1;
  }
}
