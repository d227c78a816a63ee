#include "modeler/plan/plan.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace supple {
namespace {

Effect on(std::string name, std::string why) {
  return {std::move(name), true, std::move(why)};
}
Effect off(std::string name, std::string why) {
  return {std::move(name), false, std::move(why)};
}

/// "pose.yaml:9:3: weights.volume is 10", or "weights.volume is 1, the default".
template <class T>
std::string setting(const Place& place, std::string_view key, const T& value, const T& standard) {
  if (value == standard) return fmt::format("{} is {}, the default", key, value);
  return fmt::format("{}: {} is {}", to_string(place), key, value);
}

template <class E>
std::string choice(const Place& place, std::string_view key, E value, E standard) {
  return setting(place, key, enum_name(value), enum_name(standard));
}

bool moves(const HandleSpec& handle) {
  const auto is_zero = [](const Length& length) { return length.value == 0; };
  const bool displaced = !std::all_of(handle.by.begin(), handle.by.end(), is_zero);
  const bool turned = handle.turn && handle.turn->degrees != 0;
  return handle.to || (handle.move && (displaced || turned || handle.scale != Vec3::Ones()));
}

std::string with_commas(const std::string& a, const std::string& b, const std::string& c) {
  return fmt::format("{},{},{}", a, b, c);
}

/// "move y>85% by 30%,0,0 turn 0,0,1,30".
std::string described(const HandleSpec& handle) {
  const auto number = [](double value) { return fmt::format("{}", value); };
  const auto vector = [&](const Vec3& v) {
    return with_commas(number(v[0]), number(v[1]), number(v[2]));
  };
  const auto lengths = [](const LengthVector& v) {
    return with_commas(to_string(v[0]), to_string(v[1]), to_string(v[2]));
  };
  const LengthVector nowhere{};
  std::string text = fmt::format("{} {}", handle.fix ? "fix" : "move", handle.part());
  if (handle.to && handle.move) text += " to " + handle.to->path;
  if (lengths(handle.by) != lengths(nowhere)) text += " by " + lengths(handle.by);
  if (handle.turn) {
    text += fmt::format(" turn {},{}", vector(handle.turn->axis), handle.turn->degrees);
    if (handle.turn->about) text += " about " + lengths(*handle.turn->about);
  }
  if (handle.scale != Vec3::Ones()) text += " scale " + vector(handle.scale);
  if (handle.weight != 1) text += " weight " + number(handle.weight);
  return text;
}

/// Where the handle was asked for, and what it is.
std::string asked_for(const HandleSpec& handle) {
  const std::string what = described(handle);
  if (handle.place.line <= 0) return "command line: " + what;
  return fmt::format("{}: {}", to_string(handle.place), what);
}

std::string listed(const std::vector<HandleSpec>& handles) {
  std::string text;
  for (const HandleSpec& handle : handles) text += (text.empty() ? "" : "; ") + asked_for(handle);
  return text;
}

void add_energies(const PoseSpec& pose, std::vector<Effect>& effects) {
  const PoseWeights standard;
  effects.push_back(on("handles", listed(pose.handles)));
  effects.push_back(on("rigidity", setting(pose.place, "weights.rigidity", pose.weights.rigidity,
                                           standard.rigidity)));
  const std::string volume =
      setting(pose.place, "weights.volume", pose.weights.volume, standard.volume);
  effects.push_back(pose.weights.volume > 0 ? on("volume", volume) : off("volume", volume));
}

std::string listed(const std::vector<StiffnessSpec>& parts) {
  std::string text;
  for (const StiffnessSpec& part : parts)
    text += fmt::format("{}{}: {} is {} times as stiff", text.empty() ? "" : "; ",
                        part.place.line > 0 ? to_string(part.place) : "command line",
                        part.select.text, part.times);
  return text;
}

void add_stiffness(const PoseSpec& pose, std::vector<Effect>& effects) {
  effects.push_back(pose.stiffness.empty()
                        ? off("stiffness", "pose.stiffness is not given: one for all parts")
                        : on("stiffness", listed(pose.stiffness)));
}

void add_substeps(const PoseSpec& pose, std::vector<Effect>& effects) {
  const auto mover = std::find_if(pose.handles.begin(), pose.handles.end(), moves);
  if (mover == pose.handles.end())
    effects.push_back(off("substeps", "no handle moves"));
  else if (pose.substeps == 1)
    effects.push_back(off("substeps", to_string(pose.place) + ": substeps is 1"));
  else if (pose.substeps)
    effects.push_back(
        on("substeps", fmt::format("{}: substeps is {}", to_string(pose.place), *pose.substeps)));
  else
    effects.push_back(on("substeps", asked_for(*mover)));
}

void add_hard_handles(const PoseSpec& pose, std::vector<Effect>& effects) {
  const std::string why = setting(pose.place, "hard_handles", pose.hard_handles, false);
  effects.push_back(pose.hard_handles ? on("hard_handles", why) : off("hard_handles", why));
}

void add_no_inversion(const PoseSpec& pose, std::vector<Effect>& effects) {
  const std::string why = setting(pose.place, "no_inversion", pose.no_inversion, false);
  effects.push_back(pose.no_inversion ? on("no_inversion", why) : off("no_inversion", why));
}

void add_from(const PoseSpec& pose, std::vector<Effect>& effects) {
  effects.push_back(pose.from
                        ? on("from", fmt::format("{}: the way starts at {}",
                                                 to_string(pose.from->place), pose.from->path))
                        : off("from", "pose.from is not given: the way starts at rest"));
}

void add_region(const PoseSpec& pose, std::vector<Effect>& effects) {
  if (!pose.region) {
    effects.push_back(off("region", "pose.region is not given: all may move"));
    return;
  }
  const std::string width = pose.region_blend ? to_string(*pose.region_blend) : "two spacings";
  effects.push_back(
      on("region", fmt::format("{}: nothing outside {} moves; the pose sets in over {}",
                               to_string(pose.region->place), pose.region->text, width)));
}

void add_mirror(const PoseSpec& pose, std::vector<Effect>& effects) {
  if (!pose.mirror) {
    effects.push_back(off("mirror", "pose.mirror is not given: handles act where they are"));
    return;
  }
  const Vec3& n = pose.mirror->normal;
  effects.push_back(
      on("mirror", fmt::format("{}: handles act on both sides of the plane across {},{},{}",
                               to_string(pose.mirror->place), n[0], n[1], n[2])));
}

void add_solving(const PoseSpec& pose, std::vector<Effect>& effects) {
  add_from(pose, effects);
  add_region(pose, effects);
  add_mirror(pose, effects);
  if (pose.handles.empty()) {
    for (const char* name :
         {"handles", "rigidity", "volume", "stiffness", "substeps", "hard_handles", "no_inversion"})
      effects.push_back(off(name, "the scene has no handles: the shape stays as it is"));
    return;
  }
  add_energies(pose, effects);
  add_stiffness(pose, effects);
  add_substeps(pose, effects);
  add_hard_handles(pose, effects);
  add_no_inversion(pose, effects);
}

}  // namespace

Plan make_plan(const Scene& scene) {
  Plan plan;
  std::vector<Effect>& effects = plan.effects;
  const ShapeSpec standard_shape;
  effects.push_back(on("quadrature", choice(scene.shape.place, "quadrature", scene.shape.quadrature,
                                            standard_shape.quadrature)));
  const std::string coupling =
      choice(scene.shape.place, "coupling", scene.shape.coupling, standard_shape.coupling);
  effects.push_back(scene.shape.coupling == CouplingKind::inside ? on("coupling", coupling)
                                                                 : off("coupling", coupling));
  if (scene.pose) {
    add_solving(*scene.pose, effects);
    effects.push_back(on(
        "surface", choice(scene.pose->place, "surface", scene.pose->surface, PoseSpec{}.surface)));
    effects.push_back(on("normals", "the surface moves; used where the mesh has normals"));
  } else {
    effects.push_back(off("pose", "the scene has no pose"));
  }
  effects.push_back(off("motion", "the scene has no motion"));
  effects.push_back(off("simulate", "the scene has no simulate"));
  return plan;
}

}  // namespace supple
