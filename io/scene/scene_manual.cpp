#include <type_traits>

#include <fmt/format.h>

#include "io/scene/scene_reader.h"
#include "io/scene/scene_rules.h"

namespace supple {
namespace {

constexpr std::string_view introduction = R"(# The scene language

This page is made from the program; see `scene_manual()`.

A scene is one YAML document. Unknown and duplicate keys, tags, anchors, aliases, merges (`<<`) and
`yes`, `no`, `on`, `off` are errors, told with file:line:column and the nearest valid name.

```yaml
supple: 1                     # version of the scene language; may be left out
shape:
  mesh: bunny.ply
  particles: 200
pose:
  handles:
    - fix: y<10%
    - move: y>85%
      by: [30%, 0, 0]
      turn: {axis: [0, 0, 1], degrees: 30}
```

- A **length** is a number in the file's units (`0.3`) or a percent of the shape's bounding-box
  diagonal (`30%`).
- A **point** with a percent in it is measured from the centre of the shape's bounding box. Points
  and vectors mix percents and other numbers only where those are 0.
- Paths are relative to the scene file. Files with places of vertices (`from`, `to`) have the
  coordinates of the posed shape: with `shape.size`, those of the scaled one.
- `--set pose.handles[1].weight=2` on the command line replaces a value; the value is YAML.

## Selections

A selection is text, or a map where commas would be cut inside `{ }` and `[ ]`:

| text | map | what |
|---|---|---|
| `y<10%`, `x>=0.2` | | half-space; percent of the bounding box along that axis |
| `y:..10%`, `y:85%..`, `y:10%..30%` | | as `y<10%`, `y>85%`, both; no quotes in a shell |
| `box(x0,y0,z0,x1,y1,z1)` | `{box: {min: [x0,y0,z0], max: [x1,y1,z1]}}` | corners are points |
| `sphere(x,y,z,r)` | `{sphere: {center: [x, y, z], radius: r}}` | ball |
| `nearest(x,y,z)` | `{nearest: [x, y, z]}` | the surface nearest to a point |
| `vertices(file)` | `{vertices: file}` | vertices listed in a file |
| `group(name)` | `{group: name}` | a group of the mesh file |
| `a and b` | `{and: [a, b]}` | in all of them |
| `a or b` | `{or: [a, b]}` | in one of them at least |
| `not a` | `{not: a}` | outside |

`not` binds before `and`, `and` before `or`; parentheses change that.

## Beside handles

```yaml
pose:
  from: posed.ply                                # the way starts at another pose of the shape
  stiffness: [{select: y:40%..60%, times: 5}]    # the inside of the part too
  region: y>30%                                  # nothing outside changes by a bit
  region_blend: 5%
  mirror: {normal: [1, 0, 0]}                    # handles act on both sides
  handles:
    - {move: x>90%, by: [5%, 0, 0]}
    - {move: group(face), to: smile.ply}         # each vertex to its own place
    - {to: landmarks.txt}                        # lines: number x y z
```

- What handles miss in `from` is where they start: soft handles give way once more, `hard_handles`
  end where one step would.
- The wider `region_blend`, the smoother the edge, and the more of the pose it takes away there.
- The pose of a symmetric shape is made symmetric to rounding, unless `from`, `stiffness` or
  `region` ask for more.
)";

template <class T>
struct Inner {
  using type = T;
};
template <class T>
struct Inner<std::optional<T>> {
  using type = T;
};
template <class T>
struct Inner<std::vector<T>> {
  using type = T;
};

template <class T>
constexpr bool is_list = !std::is_same_v<typename Inner<T>::type, T> &&
                         std::is_same_v<T, std::vector<typename Inner<T>::type>>;

template <class T>
concept Struct = requires(T& value) {
  T::describe(value, [](std::string_view, auto&, const Described&) {});
};

std::string code(std::string_view text) {
  return fmt::format("`{}`", text);
}

template <class E>
std::string names_of(E) {
  std::string names;
  for (const auto& [value, name] : enum_names(E{}))
    names += (names.empty() ? "" : ", ") + code(name);
  return names;
}

template <class T>
std::string type_of(const Described& described) {
  if constexpr (std::is_same_v<T, bool>)
    return "`true`, `false`";
  else if constexpr (std::is_same_v<T, int>)
    return "whole number";
  else if constexpr (std::is_same_v<T, double>)
    return "number";
  else if constexpr (std::is_same_v<T, std::string>)
    return "text";
  else if constexpr (std::is_same_v<T, Length>)
    return "length";
  else if constexpr (std::is_same_v<T, LengthVector>)
    return "list of 3 lengths";
  else if constexpr (std::is_same_v<T, NamedFile>)
    return "file";
  else if constexpr (std::is_same_v<T, Selection>)
    return "selection";
  else if constexpr (std::is_same_v<T, Vec3>)
    return described.unit == factor_unit ? "number, or list of 3" : "list of 3 numbers";
  else if constexpr (std::is_enum_v<T>)
    return names_of(T{});
  else
    return "map, see below";
}

std::string bounds_of(const Described& described) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::string bounds;
  if (described.min > -infinity)
    bounds += fmt::format(" {} {}", described.exclusive_min ? ">" : "≥", described.min);
  if (described.max < infinity)
    bounds += fmt::format("{} ≤ {}", bounds.empty() ? "" : ",", described.max);
  return bounds;
}

template <class T>
std::string default_of(const T& value) {
  if constexpr (std::is_enum_v<T>)
    return code(enum_name(value));
  else if constexpr (std::is_arithmetic_v<T>)
    return code(fmt::format("{}", value));
  else if constexpr (std::is_same_v<T, Vec3>)
    return code(fmt::format("[{}, {}, {}]", value[0], value[1], value[2]));
  else if constexpr (std::is_same_v<T, LengthVector>)
    return code(
        fmt::format("[{}, {}, {}]", to_string(value[0]), to_string(value[1]), to_string(value[2])));
  else
    return "";
}

std::string sentence(std::string_view doc) {
  std::string text(doc);
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = char(text[0] - 'a' + 'A');
  return text + ".";
}

std::string later_of(std::span<const std::string_view> keys) {
  std::string names;
  for (const std::string_view key : keys) names += (names.empty() ? "" : ", ") + code(key);
  return names.empty() ? "" : fmt::format("\nNot available yet: {}.\n", names);
}

/// The table of one struct, then those of the structs in it.
template <class T>
std::string section(const std::string& path, std::string_view doc) {
  T defaults;
  std::string table = path.empty() ? std::string("\n## Keys at the top\n\n")
                                   : fmt::format("\n## {}\n\n{}\n\n", code(path), sentence(doc));
  table += "| key | value | unit | default | what |\n|---|---|---|---|---|\n";
  std::string inner;
  T::describe(defaults, [&]<class M>(std::string_view name, M& member, const Described& what) {
    using Value = typename Inner<M>::type;
    const std::string list = is_list<M> ? "list, an entry each: " : "";
    table += fmt::format("| {} | {}{}{} | {} | {} | {} |\n", code(name), list, type_of<Value>(what),
                         bounds_of(what), what.unit, default_of(member), what.doc);
    const std::string below = joined_path(path, name) + (is_list<M> ? "[]" : "");
    if constexpr (Struct<Value>) inner += section<Value>(below, what.doc);
  });
  return table + later_of(later_keys(defaults)) + inner;
}

}  // namespace

std::string scene_manual() {
  return std::string(introduction) + section<Scene>("", "");
}

}  // namespace supple
