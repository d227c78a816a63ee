#pragma once

#include <functional>
#include <optional>
#include <stdexcept>

#include "io/mesh/mesh.h"
#include "io/scene/scene.h"
#include "modeler/plan/effect.h"
#include "modeler/pose/pose_files.h"
#include "solver/core/report.h"
#include "solver/core/rest_shape.h"

namespace supple {

/// How well the handles were met, over all selected surface samples, over the shape's diagonal.
struct HandleResidual {
  Place place;
  std::string selection;
  int samples = 0;
  double max_error = 0, rms_error = 0;
};

struct PoseResult {
  Mesh rest;              ///< the input, scaled where the scene gives a size
  Mesh mesh;              ///< the same with deformed positions and normals
  Particles particles;    ///< at rest
  Points displacements;   ///< u_i [m], n×3
  Points handle_targets;  ///< where the handles were led, for pictures [m]
  Points handle_rest;     ///< where they were at rest [m]
  Points handle_start;    ///< where their way began: at rest, or in pose.from [m]
  std::vector<HandleResidual> handles;
  double handle_max_error = 0, handle_rms_error = 0;  ///< over the diagonal
  double volume_before = 0, volume_after = 0;         ///< of the region [m³]
  double min_det_F = 1;                 ///< over particles, quadrature points and surface vertices
  Vec3 min_det_F_place = Vec3::Zero();  ///< where that is, at rest [m]
  std::vector<Effect> effects;
  Report report;
};

/// Thrown where `Progress` asks for a stop; nothing is returned then.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Told of the run's progress: the stage's name and the share done in [0, 1]; false stops it.
using Progress = std::function<bool(const std::string& stage, double share)>;

/// Deforms `mesh` as `scene.pose` asks: sample, field, solve, deform. See the stages in pose.cpp.
/// Errors: UsageError (a selection that selects nothing ...), ShapeError, Interrupted.
/// `files` holds what those hold that the pose names, if it names any.
PoseResult pose(const Mesh& mesh, const Scene& scene, const Progress& progress = {},
                const PoseFiles& files = {});

}  // namespace supple
