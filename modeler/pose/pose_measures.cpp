#include "modeler/pose/pose_measures.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "io/scene/complaint.h"

namespace supple {
namespace {

/// How far each of a handle's surface samples is from where it was led.
std::vector<double> misses(const PosedField& posed, const PoseHandle& handle) {
  const Points reached = posed.positions(handle.rest());
  std::vector<double> misses;
  for (Index row = 0; row < reached.rows(); ++row)
    misses.push_back((reached.row(row).transpose() - handle.target(row, 1)).norm());
  return misses;
}

std::string shown_part(const PoseHandle& handle) {
  const std::string& part = handle.spec->part();
  return handle.origin == HandleOrigin::mirror ? part + ", mirrored" : part;
}

}  // namespace

void measure_handles(const PosedField& posed, const HandleSamples& handles, PoseResult& result) {
  double all_squares = 0;
  std::size_t all_samples = 0;
  for (const PoseHandle& handle : handles.handles()) {
    if (handle.origin == HandleOrigin::region) continue;
    HandleResidual residual{handle.spec->place, shown_part(handle),
                            static_cast<int>(handle.selected.size()), 0, 0};
    double squares = 0;
    for (const double miss : misses(posed, handle)) {
      residual.max_error = std::max(residual.max_error, miss);
      squares += miss * miss;
    }
    residual.rms_error = std::sqrt(squares / residual.samples);
    result.handle_max_error = std::max(result.handle_max_error, residual.max_error);
    all_squares += squares;
    all_samples += handle.selected.size();
    result.handles.push_back(std::move(residual));
  }
  if (all_samples > 0)
    result.handle_rms_error = std::sqrt(all_squares / static_cast<double>(all_samples));
}

void measure_volume(const Solid& solid, const PosedField& posed, const DeformedSurface& surface,
                    PoseResult& result) {
  const CarriedBoundary& boundary = solid.boundary();
  const Points extra = posed.positions(boundary.extra);
  const double unit = std::pow(solid.unit(), 3);
  result.volume_before = unit * enclosed_volume(boundary, solid.vertices(), boundary.extra);
  const Points moved = solid.vertices() + surface.positions - solid.inner_vertices();
  result.volume_after = unit * enclosed_volume(boundary, moved, extra);
}

InversionCount worst_inversion(const Solid& solid, const SolidField& field, const Points& u,
                               const DeformedSurface& surface) {
  InversionCount worst = count_inversions(field.quadrature, u);
  for (std::size_t i = 0; i < surface.gradients.size(); ++i) {
    if (!solid.used_vertices()[i]) continue;
    const double J = surface.gradients[i].determinant();
    if (J < worst.min_det_F) {
      worst.min_det_F = J;
      worst.worst = solid.inner_vertices().row(static_cast<Index>(i)).transpose();
    }
    if (!(J > 0)) ++worst.inverted;
  }
  return worst;
}

namespace {

/// Hard handles that miss by more than this share of the diagonal contradict each other.
constexpr double hard_miss = 1e-6;

void judge_handles(const PoseSpec& spec, PoseResult& result) {
  if (result.report.status == Status::failed) return;
  const double limit = spec.hard_handles ? hard_miss : reason_limit(ReasonCode::handle_miss);
  if (!(result.handle_max_error > limit)) return;
  const long missed =
      std::count_if(result.handles.begin(), result.handles.end(),
                    [&](const HandleResidual& handle) { return handle.max_error > limit; });
  result.report.degrade(
      {ReasonCode::handle_miss, missed, result.handle_max_error,
       fmt::format("a handle misses its place by {:.2g} % of the diagonal{}",
                   100 * result.handle_max_error,
                   spec.hard_handles ? ": the particles cannot meet all of them at once" : "")});
}

/// Points of the field that no particle reaches, or that too few span.
void judge_cover(const Solid& solid, const SolidField& field, Report& report) {
  const double sampled = static_cast<double>(field.quadrature.size() + solid.vertices().rows());
  const long lost = field.quadrature.rank_lost + field.surface.rank_lost();
  if (static_cast<double>(lost) > reason_limit(ReasonCode::rank_lost) * sampled)
    report.degrade({ReasonCode::rank_lost, lost, static_cast<double>(lost) / sampled,
                    fmt::format("at {} points the particles near do not span the field's basis; "
                                "more particles help",
                                lost)});
  // Vertices that no face uses may lie anywhere; the solid notes them.
  const long unused = std::count(solid.used_vertices().begin(), solid.used_vertices().end(), false);
  const long uncovered =
      field.quadrature.uncovered + std::max(0L, field.surface.uncovered() - unused);
  if (static_cast<double>(uncovered) > reason_limit(ReasonCode::uncovered))
    report.degrade({ReasonCode::uncovered, uncovered, static_cast<double>(uncovered),
                    fmt::format("{} points lie outside all supports and follow the nearest "
                                "particle",
                                uncovered)});
}

/// Beyond this a change of volume is worth a word: the volume weight is a preference.
constexpr double notable_volume_change = 0.05;

/// From here on a turn that places alone tell may as well be meant the other way round.
constexpr double notable_turn = EIGEN_PI / 2;

constexpr double rounding = 1e-9;

}  // namespace

void judge_turns(const HandleSamples& handles, int substeps, Report& report) {
  double most = 0;
  for (const PoseHandle& handle : handles.handles()) {
    const double turn = std::abs(handle.path.radians), degrees = turn * 180 / EIGEN_PI;
    if (handle.spec->to && turn > notable_turn)
      report.notes.push_back(fmt::format(
          "{} turns by {:.0f}°, the shorter way to its places, which tell no whole turns: a longer "
          "way needs turn instead of to",
          in_quotes(handle.spec->part()), degrees));
    else
      most = std::max(most, turn);
  }
  if (most > (1 + rounding) * EIGEN_PI * substeps)
    report.degrade({ReasonCode::turn_lost, 1, 1,
                    fmt::format("a handle turns by {:.0f}° in {} step{}: more than half a turn in "
                                "a step is lost; allowed: {} substeps at least",
                                most * 180 / EIGEN_PI, substeps, substeps == 1 ? "" : "s",
                                std::ceil((1 - rounding) * most / EIGEN_PI))});
}

void judge_inversion(const InversionCount& inversion, const Vec3& place, const PoseSpec& spec,
                     Report& report) {
  if (inversion.inverted == 0) return;
  const std::string what = fmt::format(
      "{} points are turned inside out, the worst with det F = {:.3g} at ({:.6g}, "
      "{:.6g}, {:.6g}) of the rest shape",
      inversion.inverted, inversion.min_det_F, place[0], place[1], place[2]);
  if (spec.no_inversion)
    report.fail({ReasonCode::inverted, inversion.inverted, inversion.min_det_F,
                 what + ", which no_inversion forbids"});
  else
    report.degrade({ReasonCode::inverted, inversion.inverted, inversion.min_det_F,
                    what + "; no_inversion may keep them in"});
}

void judge_start(const StartingPose& from, Report& report) {
  const double percent = 100 * from.miss;
  report.notes.push_back(
      fmt::format("pose.from is met to {:.2g} % of the diagonal at its vertices", percent));
  if (from.miss > reason_limit(ReasonCode::from_miss))
    report.degrade({ReasonCode::from_miss, 1, from.miss,
                    fmt::format("the particles cannot take pose.from: a vertex of it is missed by "
                                "{:.2g} % of the diagonal; more particles may help",
                                percent)});
}

void judge(const Solid& solid, const SolidField& field, const PoseSpec& spec,
           const InversionCount& inversion, PoseResult& result) {
  Report& report = result.report;
  for (const Reason& reason : solid.reasons()) report.degrade(reason);
  judge_inversion(inversion, result.min_det_F_place, spec, report);
  judge_handles(spec, result);
  judge_cover(solid, field, report);
  const double change = result.volume_after / result.volume_before - 1;
  if (std::abs(change) > notable_volume_change && report.status != Status::failed)
    report.notes.push_back(fmt::format(
        "the volume changed by {:+.1f} %: a greater weights.volume keeps it better", 100 * change));
  if (!result.mesh.positions.allFinite())
    report.fail({ReasonCode::not_finite, 1, 0, "a deformed vertex is not finite"});
  report.finish();
}

}  // namespace supple
