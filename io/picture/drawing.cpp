#include "io/picture/drawing.h"

#include <algorithm>
#include <cmath>

#include "io/picture/smooth_corners.h"
#include "io/points/spacing.h"
#include "solver/core/check.h"

namespace supple {
namespace {

constexpr double crease_angle_deg = 40;
constexpr double splat_over_spacing = 1.1;
constexpr std::array<std::uint8_t, 4> clay = {238, 208, 178, 255};

std::uint8_t to_byte(double value) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
}

std::array<std::uint8_t, 4> to_bytes(const Color& color) {
  return {to_byte(color[0]), to_byte(color[1]), to_byte(color[2]), 255};
}

std::array<std::uint8_t, 4> vertex_color(const PictureItem& item, Index vertex) {
  if (!item.vertex_colors.empty()) return to_bytes(item.vertex_colors[vertex]);
  const auto& colors = item.mesh->colors.values;
  if (colors.rows() != item.mesh->positions.rows()) return clay;
  return {to_byte(colors(vertex, 0)), to_byte(colors(vertex, 1)), to_byte(colors(vertex, 2)), 255};
}

bool finite_row(const Points& points, Index row) {
  return points.row(row).allFinite();
}

Triangles finite_triangles(const Mesh& mesh) {
  Triangles triangles = triangulate(mesh).triangles;
  Index kept = 0;
  for (Index t = 0; t < triangles.rows(); ++t) {
    const bool finite = finite_row(mesh.positions, triangles(t, 0)) &&
                        finite_row(mesh.positions, triangles(t, 1)) &&
                        finite_row(mesh.positions, triangles(t, 2));
    if (finite) triangles.row(kept++) = triangles.row(t);
  }
  triangles.conservativeResize(kept, 3);
  return triangles;
}

std::array<float, 3> local_position(const Drawing& drawing, const Points& points, Index row) {
  const Vec3 x = (points.row(row).transpose() - drawing.origin) / drawing.size;
  return {static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2])};
}

Box finite_bounds(const PictureItem& item) {
  Box box;
  const auto extend = [&box](const Points& points) {
    for (Index i = 0; i < points.rows(); ++i)
      if (finite_row(points, i)) box.extend(points.row(i).transpose());
  };
  if (item.mesh != nullptr) extend(item.mesh->positions);
  for (const Markers& markers : item.markers) extend(markers.positions);
  for (const Lines& lines : item.lines) extend(lines.ends);
  for (const Sheet& sheet : item.sheets) extend(sheet.positions);
  return box;
}

void add_surface(const PictureItem& item, Drawing& drawing) {
  const Points& positions = item.mesh->positions;
  const Triangles triangles = finite_triangles(*item.mesh);
  const SmoothCorners corners = smooth_corners(positions, triangles, crease_angle_deg);
  drawing.vertices.reserve(corners.vertex.size());
  for (std::size_t g = 0; g < corners.vertex.size(); ++g) {
    const int v = corners.vertex[g];
    const Eigen::Vector3f n = corners.normal[g].normalized().cast<float>();
    drawing.vertices.push_back(
        {local_position(drawing, positions, v), {n[0], n[1], n[2]}, vertex_color(item, v)});
  }
  drawing.indices.assign(corners.group.begin(), corners.group.end());
}

/// The points whose coordinates are finite.
std::vector<Index> finite_points(const Points& positions) {
  std::vector<Index> rows;
  for (Index i = 0; i < positions.rows(); ++i)
    if (finite_row(positions, i)) rows.push_back(i);
  return rows;
}

/// Unit length, zero where there is none.
Eigen::Vector3f point_normal(const Mesh& mesh, Index point) {
  if (mesh.normals.per_corner() || mesh.normals.values.rows() != mesh.positions.rows())
    return Eigen::Vector3f::Zero();
  const Vec3 n = mesh.normals.values.row(point).transpose();
  return n.allFinite() && n.norm() > 0 ? n.normalized().cast<float>().eval()
                                       : Eigen::Vector3f::Zero();
}

/// Splats that reach their neighbours, but do not swell where a point lies far from all others.
Eigen::VectorXd radii_by_spacing(const Points& positions) {
  const Eigen::VectorXd spacing = neighbor_spacing(positions);
  std::vector<double> sorted(spacing.begin(), spacing.end());
  const auto middle = sorted.begin() + static_cast<Index>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return splat_over_spacing * spacing.cwiseMin(3 * *middle);
}

void add_cloud(const PictureItem& item, Drawing& drawing) {
  const Mesh& mesh = *item.mesh;
  const std::vector<Index> rows = finite_points(mesh.positions);
  Eigen::VectorXd radii = Eigen::VectorXd::Zero(static_cast<Index>(rows.size()));
  if (mesh.radii.size() == mesh.positions.rows())
    radii = mesh.radii(rows);
  else if (!mesh.normals.empty() && !rows.empty())
    radii = radii_by_spacing(mesh.positions(rows, Eigen::all));
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double radius = radii[static_cast<Index>(k)] / drawing.size;
    const Eigen::Vector3f n = point_normal(mesh, rows[k]);
    auto& points = n.isZero(0) ? drawing.balls : drawing.splats;
    points.push_back({local_position(drawing, mesh.positions, rows[k]),
                      {n[0], n[1], n[2]},
                      vertex_color(item, rows[k]),
                      std::isfinite(radius) ? static_cast<float>(radius) : 0});
  }
}

/// The i-th of `colors`, or what stands for all where there are none.
Color color_of(const std::vector<Color>& colors, const Color& all, Index i) {
  return colors.empty() ? all : colors[static_cast<std::size_t>(i)];
}

void add_markers(const Markers& markers, Drawing& drawing) {
  std::vector<DrawnVertex> balls;
  for (const Index i : finite_points(markers.positions))
    balls.push_back({local_position(drawing, markers.positions, i),
                     {},
                     to_bytes(color_of(markers.colors, markers.color, i)),
                     static_cast<float>(markers.radius / drawing.size)});
  drawing.markers.push_back(std::move(balls));
}

void add_lines(const Lines& lines, Drawing& drawing) {
  DrawnLines drawn{{}, lines.width};
  for (Index i = 0; i + 1 < lines.ends.rows(); i += 2) {
    if (!finite_row(lines.ends, i) || !finite_row(lines.ends, i + 1)) continue;
    const auto color = to_bytes(color_of(lines.colors, lines.color, i / 2));
    for (const Index end : {i, i + 1})
      drawn.ends.push_back({local_position(drawing, lines.ends, end), {}, color});
  }
  drawing.lines.push_back(std::move(drawn));
}

void add_sheet(const Sheet& sheet, Drawing& drawing) {
  SUPPLE_CHECK(static_cast<Index>(sheet.colors.size()) == sheet.positions.rows(),
               "one colour a vertex of a sheet");
  DrawnSheet drawn;
  for (Index i = 0; i < sheet.positions.rows(); ++i)
    drawn.vertices.push_back({local_position(drawing, sheet.positions, i),
                              {},
                              to_bytes(sheet.colors[static_cast<std::size_t>(i)])});
  for (Index t = 0; t < sheet.triangles.rows(); ++t) {
    if (!sheet.positions(sheet.triangles.row(t), Eigen::all).allFinite()) continue;
    for (int k = 0; k < 3; ++k)
      drawn.indices.push_back(static_cast<std::uint32_t>(sheet.triangles(t, k)));
  }
  drawing.sheets.push_back(std::move(drawn));
}

/// The half-space in the drawing's coordinates.
Eigen::Vector4f local_cut(const HalfSpace& cut, const Drawing& drawing) {
  const Vec3 normal = cut.normal.normalized();
  const double offset = (cut.offset - normal.dot(drawing.origin)) / drawing.size;
  return Eigen::Vector4d(normal.x(), normal.y(), normal.z(), -offset).cast<float>();
}

}  // namespace

Drawing make_drawing(const PictureItem& item) {
  Drawing drawing;
  const Box box = finite_bounds(item);
  if (box.empty()) return drawing;
  drawing.origin = box.center();
  if (box.diagonal() > 0) drawing.size = box.diagonal();
  if (item.mesh != nullptr) {
    SUPPLE_CHECK(item.vertex_colors.empty() ||
                     static_cast<Index>(item.vertex_colors.size()) == item.mesh->positions.rows(),
                 "one colour a vertex");
    if (item.mesh->face_count() > 0)
      add_surface(item, drawing);
    else
      add_cloud(item, drawing);
  }
  for (const Markers& markers : item.markers) add_markers(markers, drawing);
  for (const Lines& lines : item.lines) add_lines(lines, drawing);
  for (const Sheet& sheet : item.sheets) add_sheet(sheet, drawing);
  drawing.opacity = item.opacity;
  if (item.cut) drawing.cut = local_cut(*item.cut, drawing);
  return drawing;
}

}  // namespace supple
