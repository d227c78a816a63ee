#include "io/picture/axes.h"

#include <cmath>

#include <fmt/format.h>

#include "io/picture/view.h"

namespace supple {
namespace {

constexpr std::array<Color, 3> axis_colors{Color{0.80f, 0.15f, 0.12f}, Color{0.10f, 0.52f, 0.16f},
                                           Color{0.12f, 0.28f, 0.80f}};
constexpr Color frame_color{0.66f, 0.68f, 0.72f};
constexpr double tick_length = 0.015, number_distance = 0.045, name_distance = 0.09,
                 number_room = 0.04;  // of the size
constexpr int ticks = 10;

/// One edge of the box along `axis`: its start, and the direction away from the box's middle.
struct Edge {
  Vec3 start, outward;
};

void add_line(Lines& lines, const Vec3& a, const Vec3& b) {
  lines.ends.conservativeResize(lines.ends.rows() + 2, 3);
  lines.ends.bottomRows<2>() << a.transpose(), b.transpose();
}

/// The four edges along `axis`.
std::vector<Edge> edges_along(const Box& box, int axis) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::vector<Edge> edges;
  for (const double side_u : {-1.0, 1.0})
    for (const double side_v : {-1.0, 1.0}) {
      Edge edge{box.lower, side_u * Vec3::Unit(u) + side_v * Vec3::Unit(v)};
      if (side_u > 0) edge.start[u] = box.upper[u];
      if (side_v > 0) edge.start[v] = box.upper[v];
      edges.push_back(edge);
    }
  return edges;
}

/// The edge that is seen lowest, or of an axis that is seen upright the one farthest to the left.
Edge clear_edge(const Box& box, int axis, const Mat3& rotation) {
  const Vec3 along = rotation * Vec3::Unit(axis);
  const bool upright = std::abs(along.y()) > std::abs(along.x());
  const Vec3 wanted = upright ? -rotation.row(0) : -rotation.row(1);
  Edge best;
  double farthest = -std::numeric_limits<double>::infinity();
  for (const Edge& edge : edges_along(box, axis)) {
    const double way = wanted.dot(edge.start);
    if (way <= farthest) continue;
    farthest = way;
    best = edge;
  }
  return best;
}

/// `outward` as far as the viewer sees it, of unit length.
Vec3 seen_direction(const Vec3& outward, int axis, const Mat3& rotation) {
  Vec3 seen = rotation * outward;
  seen.z() = 0;
  // Straight off the axis as it is drawn, so that ticks do not lie along it.
  Eigen::Vector2d along = (rotation * Vec3::Unit(axis)).head<2>();
  if (along.norm() > 1e-9) along.normalize();
  seen.head<2>() -= along.dot(seen.head<2>()) * along;
  if (seen.norm() < 1e-9) return Vec3::Zero();
  return rotation.transpose() * seen.normalized();
}

/// Leaves the note out where it would stand on another.
void add_number(const Vec3& x, int percent, const Mat3& rotation, double room, PictureItem& item) {
  for (const Note& note : item.notes)
    if ((rotation * (note.position - x)).head<2>().norm() < room) return;
  item.notes.push_back({x, fmt::format("{}", percent)});
}

}  // namespace

void add_axes(const Box& box, const Camera& camera, PictureItem& item) {
  const Mat3 rotation = camera_rotation(camera);
  const double size = box.diagonal();
  Lines frame{{}, frame_color, 1.0};
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 length = box.size()[axis] * Vec3::Unit(axis);
    for (const Edge& edge : edges_along(box, axis))
      add_line(frame, edge.start, edge.start + length);

    const Edge edge = clear_edge(box, axis, rotation);
    const Vec3 away = seen_direction(edge.outward, axis, rotation);
    Lines marked{{}, axis_colors[axis], 2.5};
    add_line(marked, edge.start, edge.start + length);
    const bool is_short = (rotation * length).head<2>().norm() < 0.3 * size;
    for (int tick = 0; tick <= ticks; ++tick) {
      const Vec3 x = edge.start + tick / double(ticks) * length;
      add_line(marked, x, x + tick_length * size * away);
      if (tick % (is_short ? 5 : 2) == 0 && !(rotation * length).head<2>().isZero(0.05 * size))
        add_number(x + number_distance * size * away, 10 * tick, rotation, number_room * size,
                   item);
    }
    item.notes.push_back({edge.start + 0.5 * length + name_distance * size * away,
                          fmt::format("{} %", "xyz"[axis])});
    item.lines.push_back(std::move(marked));
  }
  item.lines.push_back(std::move(frame));
}

}  // namespace supple
