#pragma once

#include "modeler/pose/handles.h"
#include "modeler/pose/pose.h"
#include "modeler/pose/posed_field.h"
#include "modeler/pose/solid_field.h"
#include "modeler/pose/starting_pose.h"

namespace supple {

// What a pose did. All fill in `result`.

/// Misses of the user's handles over all their surface samples, over the diagonal.
void measure_handles(const PosedField& posed, const HandleSamples& handles, PoseResult& result);

/// Within the region's boundary, at rest and carried along: the mesh itself may be open.
void measure_volume(const Solid& solid, const PosedField& posed, const DeformedSurface& surface,
                    PoseResult& result);

/// The smallest det F over particles and the surface's vertices, and how many are not positive.
InversionCount worst_inversion(const Solid& solid, const SolidField& field, const Points& u,
                               const DeformedSurface& surface);

/// Whether the handles' turns are those that the user means: places alone tell a turn only up to
/// whole turns, and steps of more than half a turn turn the other way, or not at all.
void judge_turns(const HandleSamples& handles, int substeps, Report& report);

/// Points inside out, the worst of them at `place` of the rest shape [user's coordinates]:
/// degraded, or failed where the scene forbids it.
void judge_inversion(const InversionCount& inversion, const Vec3& place, const PoseSpec& spec,
                     Report& report);

/// How well the pose to start from is met.
void judge_start(const StartingPose& from, Report& report);

/// Reasons and notes that follow from what was measured; ends the report.
void judge(const Solid& solid, const SolidField& field, const PoseSpec& spec,
           const InversionCount& inversion, PoseResult& result);

}  // namespace supple
