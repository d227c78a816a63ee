#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "io/picture/picture.h"

namespace supple {

/// What the graphics library reads for one vertex of a surface, one splat or one ball.
struct DrawnVertex {
  std::array<float, 3> position;      ///< in the drawing's own coordinates
  std::array<float, 3> normal;        ///< unit length; zero where the surface has no area
  std::array<std::uint8_t, 4> color;  ///< red, green, blue, 255
  float radius = 0;  ///< of a point, in the drawing's coordinates; 0: by the picture's scale
};

/// Lines of one width, two vertices each.
struct DrawnLines {
  std::vector<DrawnVertex> ends;
  double width = 1;  ///< [px]
};

/// Triangles that no light changes.
struct DrawnSheet {
  std::vector<DrawnVertex> vertices;
  std::vector<std::uint32_t> indices;  ///< three a triangle
};

/// An item ready for the graphics library: positions are (x − origin) / size, so that single
/// precision serves every unit and every distance from the origin. Whatever touches a coordinate
/// that is not finite is left out.
struct Drawing {
  Vec3 origin = Vec3::Zero();  ///< [m]
  double size = 1;             ///< [m]
  std::vector<DrawnVertex> vertices;
  std::vector<std::uint32_t> indices;  ///< three a triangle
  std::vector<DrawnVertex> splats;     ///< points with normals, of a mesh without faces
  std::vector<DrawnVertex> balls;      ///< points without normals
  std::vector<std::vector<DrawnVertex>> markers;
  double opacity = 1;                             ///< of the surface
  Eigen::Vector4f cut = Eigen::Vector4f::Zero();  ///< x is left out where cut·(x, 1) > 0
  std::vector<DrawnLines> lines;
  std::vector<DrawnSheet> sheets;
};

/// [m]
inline Vec3 world_position(const Drawing& drawing, const DrawnVertex& vertex) {
  const Vec3 local(vertex.position[0], vertex.position[1], vertex.position[2]);
  return drawing.origin + drawing.size * local;
}

/// Drawing coordinates → [m].
inline Eigen::Matrix4d world_from_drawing(const Drawing& drawing) {
  Eigen::Matrix4d world = Eigen::Matrix4d::Identity();
  world.topLeftCorner<3, 3>() *= drawing.size;
  world.topRightCorner<3, 1>() = drawing.origin;
  return world;
}

Drawing make_drawing(const PictureItem& item);

}  // namespace supple
