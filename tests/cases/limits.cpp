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
    {"B4", "random_faces_inside_percent", at_most, 2, "of the inside, 5 % of a torus's faces gone"},
    {"B4", "random_faces_volume_percent", at_most, 2, "|V/V0 − 1|"},
    {"B4", "one_hole_inside_percent", at_most, 2, "of the inside, 5 % of a ball's area gone"},
    {"B4", "one_hole_volume_percent", at_most, 2, "|V/V0 − 1|"},
    {"B5", "all_particles_percent", at_most, 1, "change of their number, all faces turned"},
    {"B5", "all_notes", at_least, 1, "that say so"},
    {"B5", "half_particles_percent", at_most, 1, "the same, half of the faces turned at random"},
    {"B5", "half_notes", at_least, 1, "that say so"},
    {"B5", "all_open_volume_percent", at_most, 1, "|V/V0 − 1|, an open surface all turned"},
    {"B6", "shared_edge_percent", at_most, 3, "|V/V0 − 1|, two cubes that share an edge"},
    {"B6", "shared_vertex_percent", at_most, 3, "the same, a vertex"},
    {"B6", "shared_face_percent", at_most, 3, "the same, a face"},
    {"B6", "overlap_percent", at_most, 3, "the same, two cubes that overlap"},
    {"B6", "t_junctions_percent", at_most, 3, "the same, a lid of finer triangles"},
    {"B6", "duplicate_faces_percent", at_most, 3, "the same, a side twice"},
    {"B6", "turned_duplicates_percent", at_most, 3, "the same, a side twice, once turned"},
    {"B6", "doubled_percent", at_most, 3, "the same, every face twice"},
    {"B7", "hemisphere_refused", equal, 1, "as an open surface"},
    {"B7", "flat_sheet_refused", equal, 1, "the same"},
    {"B7", "bumpy_sheet_refused", equal, 1, "the same"},
    {"B7", "moebius_strip_refused", equal, 1, "the same"},
    {"B8", "doubled_quad_refused", equal, 1, "for zero volume"},
    {"B8", "one_triangle_refused", equal, 1, "the same"},
    {"B8", "one_place_refused", equal, 1, "the same"},
    {"B9", "counted_share", equal, 1, "of faces without area, twice a vertex, 1e8 long to 1 high"},
    {"B9", "volume_change", at_most, 1e-6, "|V/V0 − 1| against the mesh without them"},
    {"B9", "particles_moved", at_most, 1e-6, "max distance over L; 1: not as many"},
    {"B10", "bodies_without_particles", equal, 0, "of two, among 1000 crumbs"},
    {"B10", "crumbs_listed", equal, 1, "a note counts the parts without a particle"},
    {"B10", "particles_in_the_cavity", equal, 0, "of a hollow ball"},
    {"B10", "hollow_volume_percent", at_most, 3, "|ΣV_i/V − 1|"},
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
    {"K6", "read", equal, 1, "share of 9 point clouds: PLY without faces; XYZ with commas, header"},
    {"K6", "positions", equal, 0, "max difference of a coordinate from what was written"},
    {"K6", "normals", equal, 0, "the same, of a normal"},
    {"K6", "faces", equal, 0, "made up"},
    {"K6", "exit_code", equal, 0, "of supple render, the largest"},
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
