#pragma once

#include <vector>

#include "io/scene/scene.h"
#include "modeler/plan/effect.h"

namespace supple {

/// Which effects a scene calls for, and why; found without loading or solving anything.
struct Plan {
  std::vector<Effect> effects;
};

/// The effects of `scene` in the order in which they work. Energies have the names that reports
/// give them; what the scene does not ask for is off, with the reason.
Plan make_plan(const Scene& scene);

}  // namespace supple
