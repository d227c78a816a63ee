#pragma once

#include <memory>
#include <optional>

#include "io/mesh/mesh.h"
#include "io/scene/scene.h"
#include "modeler/pose/inversion_guard.h"
#include "modeler/pose/pose_solver.h"
#include "modeler/pose/scene_handles.h"
#include "modeler/pose/solid_field.h"
#include "modeler/surface/vertex_normals.h"

namespace supple {

/// A shape held ready to be posed again and again, as where somebody drags at it: what does not
/// depend on where the handles go is made once, and each pose starts from the one before. After
/// the first time drag() and deform() allocate nothing; hard handles do.
class PoseSession {
 public:
  /// Shape, handles, stiffness, weights and limits as pose() takes them. Errors: as there;
  /// UsageError without handles, and for `from`, `to`, `region` and `mirror`, which a session does
  /// not know.
  PoseSession(const Mesh& mesh, const Scene& scene);
  PoseSession(const PoseSession&) = delete;
  PoseSession& operator=(const PoseSession&) = delete;

  Index particles() const { return u_.rows(); }

  /// Says where a handle with `move`, by its number in the scene, shall go from its place at rest;
  /// points and lengths in the user's coordinates.
  void lead(std::size_t handle, const HandlePath& path);

  /// One step of a drag: from the pose there is to the nearest minimum with the handles led so, by
  /// L-BFGS whatever the scene's solver. With no_inversion the barrier stands where energies are
  /// summed; release() looks at the surface's vertices too.
  Lbfgs::Result drag(const MinimizeOptions& options = {.tolerance = 1e-4});

  /// The pose that counts when the drag is over: minimised as the scene asks from the pose there
  /// is, and once more on the way from rest; the lower one stays, or the one that keeps what the
  /// scene forbids. So it is no worse than pose()'s, whatever the drag went through. The report
  /// says where points are inside out.
  Report release();

  /// The surface in the pose there is [user's coordinates], n×3, in the input's order of vertices.
  void deform(FloatPoints& positions);
  /// With unit normals, the mean of the faces around by area.
  void deform(FloatPoints& positions, FloatPoints& normals);

 private:
  PoseSolveOptions options() const;
  /// Degrades where points are inside out; fails where the scene forbids that.
  void judge_shape(const Points& u, Report& report) const;

  const Scene scene_;
  const Mesh rest_;
  Solid solid_;
  SceneHandles chosen_;
  HandleSamples handles_;
  std::unique_ptr<const SolidField> field_;
  std::unique_ptr<PoseSolver> solver_;
  std::optional<InversionGuard> guard_;
  SurfaceEmbedding::Scratch scratch_;
  VertexNormals normals_;
  PaddedPoints u_;    ///< over the shape's diagonal
  Points displaced_;  ///< the same, for the surface
};

}  // namespace supple
