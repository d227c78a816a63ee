#include "io/scene/scene_rules.h"

#include <array>

#include <fmt/format.h>

#include "io/scene/complaint.h"

namespace supple {
std::span<const std::string_view> later_keys(const Scene&) {
  static constexpr std::array<std::string_view, 4> keys{"motion", "simulate", "fracture", "shell"};
  return keys;
}

std::span<const std::string_view> later_keys(const ShapeSpec&) {
  static constexpr std::array<std::string_view, 2> keys{"box", "target_error"};
  return keys;
}

namespace {

/// Where a key is given; the whole map's place where the value was there before.
Place place_of(const SceneItem& item, std::string_view key) {
  const auto given = find_item(item, key);
  return given ? given->place : item.place;
}

[[noreturn]] void complain_beside_fix(const SceneItem& movement) {
  complain(movement.place, fmt::format("{} stands beside fix, which holds its part in place; "
                                       "allowed: only with move",
                                       movement.path));
}

}  // namespace

void check_rules(const Scene& scene, const SceneItem&) {
  if (scene.pose && scene.shape.file().empty())
    complain(scene.pose->place,
             "shape is missing: a pose needs shape: {mesh: file} or {points: file}");
}

void check_rules(const ShapeSpec& shape, const SceneItem& item) {
  if (shape.file().empty())
    complain(shape.place, "shape.mesh is missing: the file with the mesh, or shape.points");
  if (!shape.mesh.empty() && !shape.points.empty())
    complain(place_of(item, "points"),
             "shape.points: shape.mesh is given too; allowed: one of them");
  if (shape.particles && shape.spacing)
    complain(place_of(item, "spacing"),
             "shape.spacing: shape.particles is given too; allowed: one of them");
}

void check_rules(const PoseSpec& pose, const SceneItem& item) {
  if (pose.hard_handles && pose.solver == MinimizerKind::trust_region)
    complain(place_of(item, "hard_handles"),
             "pose.hard_handles: true, with solver: trust_region; allowed: with lbfgs, nlopt");
  if (pose.no_inversion && pose.surface != SurfaceKind::field)
    complain(place_of(item, "no_inversion"),
             "pose.no_inversion: true, with surface: particle_gradients; allowed: with field");
  if (pose.region_blend && !pose.region)
    complain(place_of(item, "region_blend"),
             "pose.region_blend: pose.region is missing; allowed: only with it");
}

void check_rules(const HandleSpec& handle, const SceneItem& item) {
  if (!handle.fix && !handle.move && !handle.to)
    complain(item.place,
             fmt::format("{}: fix or move is missing; allowed: one of them", item.path));
  if (handle.fix && handle.move)
    complain(find_item(item, "move")->place,
             fmt::format("{}: fix and move are both given; allowed: one of them", item.path));
  if (handle.to && handle.fix) complain_beside_fix(*find_item(item, "to"));
  for (const std::string_view key : {"by", "turn", "scale"}) {
    const auto movement = find_item(item, key);
    if (movement && handle.fix) complain_beside_fix(*movement);
    if (movement && handle.to)
      complain(movement->place,
               fmt::format("{} stands beside to, which says where each vertex goes; allowed: one "
                           "of them",
                           movement->path));
  }
}

void check_rules(const TurnSpec& turn, const SceneItem& item) {
  if (!find_item(item, "degrees"))
    complain(item.place, fmt::format("{}.degrees is missing", item.path));
  if (turn.axis.squaredNorm() == 0)
    complain(find_item(item, "axis")->place,
             fmt::format("{}.axis = 0, must have a length", item.path));
}

void check_rules(const StiffnessSpec&, const SceneItem& item) {
  for (const std::string_view key : {"select", "times"})
    if (!find_item(item, key))
      complain(item.place, fmt::format("{}.{} is missing", item.path, key));
}

void check_rules(const MirrorSpec& mirror, const SceneItem& item) {
  if (!find_item(item, "normal"))
    complain(item.place, fmt::format("{}.normal is missing", item.path));
  if (mirror.normal.squaredNorm() == 0)
    complain(find_item(item, "normal")->place,
             fmt::format("{}.normal = 0, must have a length", item.path));
}

}  // namespace supple
