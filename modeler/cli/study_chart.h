#pragma once

#include "io/chart/sketch.h"
#include "modeler/cli/study_run.h"

namespace supple {

/// Time over error, a curve a knob, beside the share of each stage in the time of each setting.
Sketch study_chart(const StudyRun& run);

}  // namespace supple
