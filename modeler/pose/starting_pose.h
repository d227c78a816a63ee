#pragma once

#include "modeler/pose/handles.h"
#include "modeler/pose/solid_field.h"

namespace supple {

/// A pose that was given by its vertices, as the field takes it.
struct StartingPose {
  Points u;         ///< of the particles, N×3
  double miss = 0;  ///< of a vertex, the greatest
};

/// Fits u to the vertices `posed` [scaled coordinates], least Σ_v |f(x_v) − y_v|², beyond their
/// best-fit rigid motion. What the vertices leave open is as smooth as can be: iterated Tikhonov
/// regularisation by Σ V |∇u|², which leaves no trace where the vertices say enough.
StartingPose fit_pose(const Solid& solid, const SolidField& field, const Points& posed);

/// Where the field with displacements `u` takes points [scaled coordinates], however many.
Points carried(const SolidField& field, const Points& points, const Points& u);

}  // namespace supple
