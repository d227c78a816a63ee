#pragma once

#include <filesystem>
#include <string_view>
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

/// The bound of a half-space along its axis; percents are of `box` along it.
double resolve_bound(const Selection& half_space, const Box& box);

/// Indices of the samples inside `selection`, ascending. vertices(file) takes the samples whose
/// nearest corner is listed, group(name) those in faces of that group; nearest(x,y,z) the one
/// sample nearest to that point.
/// Errors: UsageError (an unknown group with the nearest name, a missing or wrong vertex file);
/// UsageError with the bounding box and the selection's text where nothing is selected.
std::vector<int> select(const Selection& selection, const SelectionContext& context,
                        const SurfaceSamples& samples);

/// For each sample whether it is inside `selection`; none may be. Errors: as select().
std::vector<char> select_mask(const Selection& selection, const SelectionContext& context,
                              const SurfaceSamples& samples);

/// Points anywhere in a shape as select_mask() takes them: half-spaces, boxes and spheres speak of
/// the points, vertices and groups of the surface sample nearest to each. Areas are left out.
SurfaceSamples stand_ins(const Points& points, const SurfaceSamples& surface);
/// The same for `selection`: the nearest samples are sought only where it speaks of them.
SurfaceSamples stand_ins(const Points& points, const SurfaceSamples& surface,
                         const Selection& selection);

/// Throws UsageError: the selection holds nothing of what `of` names.
[[noreturn]] void complain_of_nothing(const Selection& selection, const Box& box,
                                      std::string_view of);

}  // namespace supple
