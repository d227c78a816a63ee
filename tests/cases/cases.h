#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>

namespace supple {

/// What a case measured, by the figures' names.
using Figures = std::map<std::string, double, std::less<>>;

/// A hard case; its set-up stands beside its function, its limits in limits.cpp.
struct Case {
  std::string_view id;
  void (*measure)(Figures& figures);
};

/// A14 in concave shapes, whose detours must be as smooth as all else.
void measure_concave_gradients(Figures& figures);

std::span<const Case> moment_matrix_cases();     ///< A: moving least squares
std::span<const Case> degenerate_cloud_cases();  ///< A: over particles as they should not lie
std::span<const Case> coupling_cases();          ///< B: parts that nearly touch, thin parts
std::span<const Case> geometry_cases();          ///< B: shapes as they come
std::span<const Case> point_cloud_cases();       ///< B: scans
std::span<const Case> pose_cases();              ///< C: poses
std::span<const Case> extreme_pose_cases();      ///< C: whole turns, reflections, wild weights
std::span<const Case> destroyed_start_cases();   ///< C: solves from states without a shape
std::span<const Case> input_cases();             ///< K: inputs and outputs
std::span<const Case> hostile_file_cases();      ///< K: files that lie
std::span<const Case> cut_file_cases();          ///< K: files that end too early
std::span<const Case> odd_input_cases();         ///< K: names, scenes and files that are none
std::span<const Case> short_memory_cases();      ///< K: allocations that fail
std::span<const Case> fault_cases();             ///< K: disks and processes that give out
std::span<const Case> circumstance_cases();      ///< K: locales, other runs, units
std::span<const Case> importer_cases();          ///< K: foreign formats
std::span<const Case> solver_cases();            ///< L: what minimisers meet
std::span<const Case> repeated_pose_cases();     ///< L: the same pose in other circumstances

}  // namespace supple
