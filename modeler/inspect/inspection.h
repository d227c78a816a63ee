#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/mesh/mesh.h"
#include "io/scene/selection.h"
#include "io/scene/shape_spec.h"
#include "modeler/domain/mesh_defects.h"
#include "modeler/domain/point_spacing.h"
#include "modeler/domain/thickness.h"
#include "modeler/pose/solid.h"

namespace supple {

/// Whether a shape can be posed, tried as a pose does it.
struct SolidVerdict {
  std::unique_ptr<Solid> solid;  ///< null where it cannot
  std::string reason;            ///< why it cannot, and what would help

  bool poses() const { return solid != nullptr; }
};

/// How many particles follow a shape's thin parts. Lengths in file units.
struct ThinParts {
  Thickness thickness;
  long particles = 0;         ///< as asked for
  double spacing = 0;         ///< theirs
  double thinner_share = 0;   ///< of the surface whose thickness is below the spacing
  double wanted_spacing = 0;  ///< leaves all but `most_thin_share` no thinner
  double wanted_particles = 0;
};

/// What of a surface may be thinner than the particles' spacing without harm.
inline constexpr double most_thin_share = 0.05;

/// What an inspection finds. Lengths in file units.
struct Inspection {
  std::optional<MeshSurvey> mesh;      ///< of a mesh
  std::optional<PointSpacing> points;  ///< of a point cloud
  Box box;                             ///< of what faces use, of a cloud's points; as poses see it
  SolidVerdict verdict;
  std::optional<ThinParts> thin;                        ///< where there is a solid
  std::vector<std::pair<std::string, double>> seconds;  ///< by stage
};

/// Told of each stage before it begins; may throw to stop.
using OnStage = std::function<void(const std::string& stage)>;

Inspection inspect(const Mesh& mesh, const ShapeSpec& spec, const OnStage& on_stage = {});

/// The part of a shape that a selection names.
struct SelectedPart {
  long vertices = 0;
  double area = 0, area_share = 0;  ///< of a point cloud: counts each point by its neighbours
  Box box;
  Points samples;  ///< evenly over the part, for pictures
};

/// Errors: UsageError where nothing is selected.
SelectedPart select_part(const Mesh& mesh, const Inspection& inspection, const Selection& selection,
                         const std::filesystem::path& folder);

}  // namespace supple
