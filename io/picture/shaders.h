#pragma once

#include <string_view>

namespace supple::shaders {

/// Fills the picture without any input.
inline constexpr std::string_view background_vertex = R"(#version 330 core
out float height;
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  height = 0.5 + 0.5 * corner.y;
  gl_Position = vec4(corner, 1.0, 1.0);
}
)";

inline constexpr std::string_view background_fragment = R"(#version 330 core
in float height;
out vec4 pixel;
void main() {
  pixel = vec4(mix(vec3(0.902, 0.910, 0.925), vec3(0.988, 0.988, 0.992), height), 1.0);
}
)";

/// Light on a matt surface: a warm key light from the upper left, a cool fill light from the
/// right, a rim light from behind, a sky above and a floor below. Colours are sRGB at both ends.
/// `n` is the normal as the viewer sees it (x right, y up, z towards the viewer).
inline constexpr std::string_view lighting = R"(#version 330 core
float wrapped(vec3 n, vec3 light, float wrap) {
  return max(0.0, (dot(n, normalize(light)) + wrap) / (1.0 + wrap));
}
vec3 shade(vec3 n, vec3 color) {
  vec3 albedo = pow(color, vec3(2.2));
  vec3 light = mix(vec3(0.13, 0.11, 0.10), vec3(0.32, 0.34, 0.38), 0.5 + 0.5 * n.y);
  light += vec3(0.92, 0.87, 0.80) * wrapped(n, vec3(-0.55, 0.65, 0.75), 0.2);
  light += vec3(0.12, 0.14, 0.18) * wrapped(n, vec3(0.9, 0.0, 0.5), 0.3);
  light += vec3(0.20) * pow(1.0 - abs(n.z), 3.0) * wrapped(n, vec3(0.5, 0.6, -0.5), 0.2);
  vec3 halfway = normalize(normalize(vec3(-0.55, 0.65, 0.75)) + vec3(0.0, 0.0, 1.0));
  float gloss = 0.05 * pow(max(dot(n, halfway), 0.0), 24.0);
  return pow(min(albedo * light + gloss, 1.0), vec3(1.0 / 2.2));
}
)";

inline constexpr std::string_view surface_vertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;
uniform mat4 to_clip;
uniform mat3 to_view;
out vec3 seen_normal;
out vec3 seen_color;
out vec3 place;
void main() {
  seen_normal = to_view * normal;
  seen_color = color.rgb;
  place = position;
  gl_Position = to_clip * vec4(position, 1.0);
}
)";

/// Both sides are lit; the inner one, seen through a hole, is darker.
inline constexpr std::string_view surface_fragment = R"(
in vec3 seen_normal;
in vec3 seen_color;
in vec3 place;
uniform vec4 cut;
uniform float opacity;
out vec4 pixel;
void main() {
  if (dot(cut, vec4(place, 1.0)) > 0.0) discard;
  float size = length(seen_normal);
  vec3 n = size > 1e-6 ? seen_normal / size : vec3(0.0, 0.0, 1.0);
  vec3 color = seen_color;
  if (!gl_FrontFacing) {
    n = -n;
    color *= vec3(0.62, 0.64, 0.70);
  }
  pixel = vec4(shade(n, color), opacity);
}
)";

/// How large a point is in the picture: see PointScale.
inline constexpr std::string_view point_size = R"(#version 330 core
layout(location = 3) in float radius;
uniform float px_per_unit;
uniform float default_px;
uniform float largest_px;
float seen_radius() {
  return clamp(radius > 0.0 ? px_per_unit * radius : default_px, 0.75, largest_px);
}
)";

/// A ball is one square point of the right size, lit and cut out by pixel.
inline constexpr std::string_view ball_vertex = R"(
layout(location = 0) in vec3 position;
layout(location = 2) in vec4 color;
uniform mat4 to_clip;
out vec3 seen_color;
out float radius_px;
void main() {
  seen_color = color.rgb;
  radius_px = seen_radius();
  gl_PointSize = 2.0 * radius_px;
  gl_Position = to_clip * vec4(position, 1.0);
}
)";

/// The ball stands in front of its centre by one more radius, so that one that lies on a surface
/// is not half sunk in it.
inline constexpr std::string_view ball_fragment = R"(
in vec3 seen_color;
in float radius_px;
uniform float depth_per_px;
out vec4 pixel;
void main() {
  vec2 across = (2.0 * gl_PointCoord - 1.0) * vec2(1.0, -1.0);
  float square = dot(across, across);
  if (square > 1.0) discard;
  vec3 n = vec3(across, sqrt(1.0 - square));
  gl_FragDepth = gl_FragCoord.z - depth_per_px * radius_px * (1.0 + n.z);
  pixel = vec4(shade(n, seen_color), 1.0);
}
)";

/// A splat is a disc across its normal. Seen from behind it is darker, as a surface is, but not
/// where it peeps out behind the edge of what it belongs to.
inline constexpr std::string_view splat_vertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;
uniform mat4 to_clip;
uniform mat3 to_view;
out vec3 seen_normal;
out vec3 seen_color;
out float radius_px;
void main() {
  seen_normal = to_view * normal;
  seen_color = color.rgb;
  if (seen_normal.z < 0.0) {
    seen_color *= mix(vec3(1.0), vec3(0.62, 0.64, 0.70), smoothstep(0.1, 0.5, -seen_normal.z));
    seen_normal = -seen_normal;
  }
  radius_px = seen_radius();
  gl_PointSize = 2.0 * radius_px;
  gl_Position = to_clip * vec4(position, 1.0);
}
)";

/// Adds up normals and colours, weighted by the nearness to the splat's centre; the depth goes
/// along with the colours. With `behind` = 1 only the depth counts, set back by one radius:
/// splats of one surface lie that near to each other, and what lies deeper is hidden.
inline constexpr std::string_view splat_fragment = R"(#version 330 core
in vec3 seen_normal;
in vec3 seen_color;
in float radius_px;
uniform float depth_per_px;
uniform float behind;
layout(location = 0) out vec4 normal_sum;
layout(location = 1) out vec4 color_sum;
void main() {
  vec2 across = (2.0 * gl_PointCoord - 1.0) * vec2(1.0, -1.0);
  float nearer = -dot(across, seen_normal.xy) / max(seen_normal.z, 0.01);
  float weight = 1.0 - dot(across, across) - nearer * nearer;
  if (weight <= 0.0) discard;
  weight *= weight;
  float depth = gl_FragCoord.z - depth_per_px * radius_px * nearer;
  gl_FragDepth = depth + behind * depth_per_px * radius_px;
  normal_sum = weight * vec4(seen_normal, 1.0);
  color_sum = weight * vec4(seen_color, depth);
}
)";

/// Lights what splat_fragment added up.
inline constexpr std::string_view resolve_fragment = R"(
uniform sampler2D normal_sums;
uniform sampler2D color_sums;
uniform int left;
out vec4 pixel;
void main() {
  ivec2 place = ivec2(gl_FragCoord.xy) - ivec2(left, 0);
  vec4 normal = texelFetch(normal_sums, place, 0);
  vec4 color = texelFetch(color_sums, place, 0) / normal.w;
  if (normal.w == 0.0) discard;
  gl_FragDepth = color.a;
  pixel = vec4(shade(normalize(normal.xyz), color.rgb), 1.0);
}
)";

/// Colours as they are: lines and sheets.
inline constexpr std::string_view flat_vertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 2) in vec4 color;
uniform mat4 to_clip;
out vec3 seen_color;
void main() {
  seen_color = color.rgb;
  gl_Position = to_clip * vec4(position, 1.0);
}
)";

inline constexpr std::string_view flat_fragment = R"(#version 330 core
in vec3 seen_color;
out vec4 pixel;
void main() { pixel = vec4(seen_color, 1.0); }
)";

inline constexpr std::string_view ground_vertex = R"(#version 330 core
uniform mat4 to_clip;
out vec2 place;
void main() {
  place = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = to_clip * vec4(place, 0.0, 1.0);
}
)";

inline constexpr std::string_view ground_fragment = R"(#version 330 core
in vec2 place;
uniform sampler2D shadow;
out vec4 pixel;
void main() { pixel = vec4(vec3(0.24, 0.21, 0.22), 0.55 * texture(shadow, place).r); }
)";

}  // namespace supple::shaders
