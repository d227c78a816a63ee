#pragma once

#include "solver/core/deadline.h"
#include "solver/energy/energy_sum.h"
#include "solver/energy/nearest_rotation.h"

namespace supple {

/// Brings destroyed displacements (flattened, mirrored, crumpled, NaN-free) back to a shape:
/// by turns the rotations of `rotations` are fitted to F at `samples` and `energy`, which holds it
/// beside energies of f that are quadratic too, is brought nearer to its minimum.
/// `u` [m] N×3 is the start and the result; ends early at the deadline. Source: Sorkine & Alexa
/// 2007, local/global iteration.
SUPPLE_API void repair(const EnergySum& energy, NearestRotationEnergy& rotations,
                       const Samples& samples, const Deadline& deadline, Points& u);

}  // namespace supple
