#pragma once

#include <optional>

#include "io/scene/scene.h"
#include "modeler/pose/handles.h"
#include "modeler/pose/pose_files.h"
#include "modeler/pose/region_blend.h"
#include "modeler/pose/solid_field.h"

namespace supple {

/// The handles that a scene's pose asks for on a solid, and the region that it leaves to them.
/// Keeps references to all that it is made of.
class SceneHandles {
 public:
  /// Errors: UsageError for a selection that selects nothing, a handle outside the region ...
  SceneHandles(const Mesh& rest, const Solid& solid, const Scene& scene, const PoseFiles& files);
  SceneHandles(const SceneHandles&) = delete;
  SceneHandles& operator=(const SceneHandles&) = delete;

  const HandleContext& context() const { return context_; }
  /// None where all may move.
  const std::optional<RegionBlend>& region() const { return region_; }

  /// None where handles act where they are alone; in scaled coordinates.
  const std::optional<MirrorPlane>& mirror() const { return mirror_; }

  /// Lets the handles' ways begin where the field with displacements `u` has them.
  void begin_at(const SolidField& field, const Points& u);

  /// All handles in a row, what the region holds among them; once.
  HandleSamples take() { return HandleSamples(std::move(handles_)); }

 private:
  void add_mirrored();
  void leave_to_region(const PoseSpec& spec);
  void check_within_region(const PoseSpec& spec) const;

  SurfaceSamples vertices_;  ///< where a handle speaks of them
  HandleContext context_;
  std::vector<PoseHandle> handles_;
  std::optional<MirrorPlane> mirror_;
  std::optional<RegionBlend> region_;
  HandleSpec hold_;  ///< of what lies outside the region
};

}  // namespace supple
