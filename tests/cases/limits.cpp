#include "tests/cases/limits.h"

namespace supple {
namespace {

using enum Relation;

// L: diagonal of the bounding box; h: support radius; J: det F.
// clang-format off
constexpr Limit table[] = {
    {"A1", "partition_of_unity", at_most, 1e-12, "max |Σφ − 1|, 60 particles in a plane, a line"},
    {"A1", "linear_reproduction", at_most, 1e-12, "max |Σφ(x_i − x)|/h"},
    {"A1", "sum_of_absolutes", at_most, 10, "max Σ|φ|"},
    {"A1", "not_finite", equal, 0, "numbers among φ, ∇φ, ∂²φ that are not finite"},
    {"A1", "rank_plane_linear", equal, 3, "of 4, at every point"},
    {"A1", "rank_plane_quadratic", equal, 6, "of 10, at every point"},
    {"A1", "rank_line_linear", equal, 2, "of 4, at every point"},
    {"A1", "rank_line_quadratic", equal, 3, "of 10, at every point"},
    {"A2", "partition_of_unity", at_most, 1e-12, "max |Σφ − 1| with 1, 2, 3 neighbours"},
    {"A2", "one_neighbor_value", at_most, 1e-12, "max |φ − 1|"},
    {"A2", "one_neighbor_slope", at_most, 1e-12, "max h|∇φ|"},
    {"A2", "not_finite", equal, 0, "numbers among φ, ∇φ, ∂²φ that are not finite"},
    {"A2", "counted", equal, 1, "share of the points that samples count as of lost rank"},
    {"A10", "values", at_most, 1e-12, "max change of φ at scales 1e-9, 1e9, over max |φ|"},
    {"A10", "gradients", at_most, 1e-12, "the same for ∇φ, rescaled"},
    {"A10", "second_derivatives", at_most, 1e-12, "the same for ∂²φ, rescaled"},
    {"A11", "partition_of_unity", at_most, 1e-12, "max |Σφ − 1| of particles 1e3, 1e6, 1e7 L away"},
    {"A11", "pose_at_1e3_L", at_most, 1e-9, "max difference of the bent bar, moved back, over L"},
    {"A11", "pose_at_1e6_L", at_most, 1e-9, "the same"},
    {"A11", "pose_at_1e7_L", at_most, 1e-9, "the same"},
    {"A14", "constant_field", at_most, 1e-10, "max h|Σ∇φ|, all orders"},
    {"A14", "affine_field", at_most, 1e-10, "max |Σ f(x_i)∇φ − ∇f|/|∇f|, linear and quadratic"},
    {"A14", "finite_differences", at_most, 1e-6, "max h|∇φ − central difference|, all orders"},
    {"B11", "clean", at_most, 5, "% of the volume inside the cloud or the mesh only, no normals"},
    {"B11", "noise", at_most, 5, "the same with noise of 1 % L in each coordinate"},
    {"B11", "outliers", at_most, 5, "the same with 10 % more points at random in the box"},
    {"B11", "both", at_most, 5, "the same with both"},
    {"B11", "one_point_refused", equal, 1, "1: with a ShapeError"},
    {"B11", "three_points_refused", equal, 1, "the same"},
    {"C1", "moved", at_most, 1e-10, "max way of a vertex over L, handles at rest"},
    {"C1", "iterations", at_least, 0, "of the minimiser"},
    {"C1", "iterations", at_most, 1, "of the minimiser"},
    {"C2", "turned_90", at_most, 1e-6, "max miss of a vertex over L, all handles under one motion"},
    {"C2", "turned_180", at_most, 1e-6, "the same"},
    {"C2", "moved_1000_L", at_most, 1e-6, "the same"},
    {"C2", "turned_180_moved_1000_L", at_most, 1e-6, "the same"},
    {"C3", "min_J", at_least, 0.1, "bar 1:1:4 twisted by 180°, volume weight 10"},
    {"C3", "volume_change_percent", at_most, 3, "|V/V0 − 1|"},
    {"C3", "twist_off_linear_degrees", at_most, 5, "max over slices of the surface"},
    {"C7", "one_handle", at_most, 1e-6, "max difference from a pure translation over L"},
    {"C7", "no_handles", equal, 0, "max way of a vertex over L"},
    {"C7", "no_handles_message", equal, 1, "notes that say so"},
    {"C7", "collinear_handles_off_line", at_most, 1e-12, "of the set-up, over L"},
    {"C7", "collinear_spin", at_most, 1e-6, "rad about the line of three handles"},
    {"C17", "nan_rejected_in_line", equal, 6, "that the message names; 0: accepted, or no place"},
    {"C17", "inf_rejected_in_line", equal, 6, "the same"},
    {"C17", "minus_inf_rejected_in_line", equal, 6, "the same"},
    {"C17", "overflow_rejected_in_line", equal, 6, "the same, for 1e400"},
    {"C17", "weight_rejected_in_line", equal, 7, "the same, for weight −1"},
    {"C17", "nan_weight_rejected_in_line", equal, 7, "the same"},
    {"C17", "empty_region_rejected_in_line", equal, 5, "the same"},
    {"K9", "misspelt_placed", equal, 1, "share of misspelt keys told with their line"},
    {"K9", "misspelt_named", equal, 1, "share of them told with the nearest key"},
    {"K9", "unknown_placed", equal, 1, "share of keys like no other told with their line"},
    {"K9", "unknown_named", equal, 1, "share of them told with the keys that are allowed"},
    {"K9", "wrong_type_placed", equal, 1, "share of values of a wrong type told with their line"},
    {"K9", "wrong_type_named", equal, 1, "share of them told with their key"},
    {"K9", "exit_code", equal, 2, "of the program for a misspelt key"},
    {"K11", "missing_seconds", at_most, 1, "until the program ends, output in a missing folder"},
    {"K11", "missing_exit_code", equal, 3, "of the program"},
    {"K11", "read_only_seconds", at_most, 1, "the same, in a read-only folder"},
    {"K11", "read_only_exit_code", equal, 3, "the same"},
    {"K11", "is_file_seconds", at_most, 1, "the same, in a \"folder\" that is a file"},
    {"K11", "is_file_exit_code", equal, 3, "the same"},
    {"K11", "left_behind", equal, 0, "files that were not there before"},
    {"K11", "found_by_check_writable", equal, 1, "share of these paths"},
    {"K11", "control_exit_code", equal, 143, "a good path: still solving when stopped after 1 s"},
};
// clang-format on

}  // namespace

bool Limit::holds_for(double measured) const {
  switch (relation) {
    case at_most:
      return measured <= value;
    case at_least:
      return measured >= value;
    case equal:
      return measured == value;
  }
  return false;
}

std::string_view symbol(Relation relation) {
  switch (relation) {
    case at_most:
      return "≤";
    case at_least:
      return "≥";
    case equal:
      return "=";
  }
  return "?";
}

std::span<const Limit> limits() {
  return table;
}

}  // namespace supple
