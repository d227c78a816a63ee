#include "modeler/cli/scene_arguments.h"

#include <algorithm>
#include <array>
#include <type_traits>

#include <fmt/format.h>

#include "io/errors.h"

namespace supple {
namespace {

/// The scene that a bare shape stands for; the shape and its handles are put in after it was read.
constexpr const char* shape_scene = "shape: {mesh: SHAPE}\npose: {}\n";

/// Keys that are not options of their own: what the command line says in other words, and
/// shape.size, since --size is the picture's.
constexpr std::array<std::string_view, 4> not_options{"shape.mesh", "shape.points", "pose.handles",
                                                      "shape.size"};

template <class T>
struct Unwrapped {
  using type = T;
};
template <class T>
struct Unwrapped<std::optional<T>> {
  using type = T;
};

template <class T>
constexpr bool is_described = requires(T value) {
  T::describe(value, [](auto&&...) {});
};

std::string with_dashes(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

/// Text that YAML takes as it is.
std::string quoted_yaml(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + "'";
}

/// What the help shows for a value of type T.
template <class T>
std::string value_form() {
  std::string form;
  if constexpr (std::is_enum_v<T>) {
    for (const auto& [value, name] : enum_names(T{}))
      form += fmt::format("{}{}", form.empty() ? "" : "|", name);
  } else if constexpr (std::is_same_v<T, Length>) {
    form = "LENGTH";
  } else {
    form = std::is_integral_v<T> ? "N" : "NUMBER";
  }
  return form;
}

}  // namespace

void SceneArguments::declare(CommandLine& line) {
  line.positional("SHAPE",
                  "a mesh (OBJ, PLY, OFF, STL, GLB, ...), a point cloud (PLY, XYZ, PWN, PCD), or a "
                  "scene (.yaml)",
                  [this](const std::string& value) { path_ = value; });
  handles_.declare(line);
  parts_.declare(line);
  line.option("--region", {"SELECTION", "move nothing outside this part; see --region-blend"},
              [this](const std::string& value) {
                knobs_.push_back({"--region " + value, "pose.region", quoted_yaml(value)});
              });
  line.option("--mirror", {"NX,NY,NZ", "let handles act on the other side of this plane too"},
              [this](const std::string& value) {
                knobs_.push_back({"--mirror " + value, "pose.mirror.normal", "[" + value + "]"});
              });
  line.option("--mirror-at", {"X,Y,Z", "point of that plane; default: the box's centre"},
              [this](const std::string& value) {
                knobs_.push_back({"--mirror-at " + value, "pose.mirror.at", "[" + value + "]"});
              });
  line.begin_group("Shape");
  declare_knobs<ShapeSpec>(line, "shape", "--");
  line.begin_group("Pose");
  declare_knobs<PoseSpec>(line, "pose", "--");
  declare_set(line);
}

void SceneArguments::declare_set(CommandLine& line) {
  line.repeated_option(
      "--set", {"KEY=VALUE", "any key of the scene: pose.weights.volume=10"},
      [this](const std::string& value) {
        const std::size_t equals = value.find('=');
        if (equals == std::string::npos || equals == 0)
          throw UsageError(
              fmt::format("--set {}: allowed: KEY=VALUE, as in "
                          "pose.weights.volume=10",
                          value));
        knobs_.push_back({"--set " + value, value.substr(0, equals), value.substr(equals + 1)});
      });
}

template <class Spec>
void SceneArguments::declare_knobs(CommandLine& line, const std::string& key,
                                   const std::string& prefix) {
  Spec defaults;
  Spec::describe(defaults, [&](std::string_view name, auto& member, const Described& described) {
    using Member = typename Unwrapped<std::remove_reference_t<decltype(member)>>::type;
    const std::string member_key = fmt::format("{}.{}", key, name);
    if (std::find(not_options.begin(), not_options.end(), member_key) != not_options.end()) return;
    const std::string option = prefix + with_dashes(std::string(name));
    if constexpr (is_described<Member>)
      declare_knobs<Member>(line, member_key, option + "-");
    else
      declare_knob<Member>(line, member_key, option, described);
  });
}

template <class Member>
void SceneArguments::declare_knob(CommandLine& line, const std::string& key,
                                  const std::string& option, const Described& described) {
  const std::string doc(described.doc);
  if constexpr (std::is_same_v<Member, bool>) {
    line.flag(option, doc, [=, this] { knobs_.push_back({option, key, "true"}); });
  } else if constexpr (std::is_arithmetic_v<Member> || std::is_enum_v<Member> ||
                       std::is_same_v<Member, Length>) {
    line.option(option, {value_form<Member>(), doc}, [=, this](const std::string& value) {
      knobs_.push_back({fmt::format("{} {}", option, value), key, value});
    });
  }
}

bool SceneArguments::is_scene_file() const {
  return path_.ends_with(".yaml") || path_.ends_with(".yml");
}

Scene SceneArguments::take() {
  Scene scene = read();
  if (scene.pose && scene.pose->region) name_by_option(*scene.pose->region);
  if (scene.pose && scene.pose->mirror) name_by_option(scene.pose->mirror->place);
  std::vector<HandleSpec> handles = handles_.take();
  if (handles.empty() && !parts_.given()) return scene;
  if (!scene.pose) scene.pose.emplace().place = scene.shape.place;
  parts_.give(*scene.pose);
  for (HandleSpec& handle : handles) scene.pose->handles.push_back(std::move(handle));
  return scene;
}

void SceneArguments::name_by_option(Place& place) const {
  for (const Knob& knob : knobs_)
    if (place.file == fmt::format("--set {}={}", knob.key, knob.value)) place.file = knob.words;
}

void SceneArguments::name_by_option(Selection& selection) const {
  name_by_option(selection.place);
  for (Selection& part : selection.parts) name_by_option(part);
}

Scene SceneArguments::read() const {
  SceneOverrides overrides;
  for (const Knob& knob : knobs_) overrides.emplace_back(knob.key, knob.value);
  try {
    return is_scene_file() ? read_scene(path_, overrides) : read_shape(overrides);
  } catch (const UsageError& error) {
    const std::string message = error.what();
    for (const Knob& knob : knobs_) {
      const std::string place = fmt::format("--set {}={}", knob.key, knob.value);
      if (message.starts_with(place)) throw UsageError(knob.words + message.substr(place.size()));
    }
    throw;
  }
}

Scene SceneArguments::read_shape(const SceneOverrides& overrides) const {
  for (const auto& [key, value] : overrides)
    if (key.starts_with("pose.handles") || key == "shape.mesh" || key == "shape.points")
      throw UsageError(
          fmt::format("--set {}: only with a scene file; a shape has its handles from "
                      "--fix and --move",
                      key));
  Scene scene = read_scene_text(shape_scene, "command line", {}, overrides);
  scene.shape.mesh = path_;
  scene.shape.place = scene.pose->place = {"command line"};
  return scene;
}

}  // namespace supple
