#pragma once

#include <filesystem>
#include <vector>

#include "io/mesh/mesh.h"
#include "io/scene/selection.h"
#include "modeler/domain/surface_samples.h"

namespace supple {

/// The shape that selections speak of, at rest.
struct SelectionContext {
  const Mesh& mesh;
  const Triangulation& triangulation;
  Box box;                       ///< of the mesh's positions
  std::filesystem::path folder;  ///< that vertices(file) is relative to
};

/// Indices of the samples inside `selection`, ascending. vertices(file) takes the samples whose
/// nearest corner is listed, group(name) those in faces of that group; nearest(x,y,z) the one
/// sample nearest to that point.
/// Errors: UsageError (an unknown group with the nearest name, a missing or wrong vertex file);
/// UsageError with the bounding box and the selection's text where nothing is selected.
std::vector<int> select(const Selection& selection, const SelectionContext& context,
                        const SurfaceSamples& samples);

}  // namespace supple
