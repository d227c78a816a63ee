#pragma once

#include <functional>

#include "tests/support/shapes.h"

/// Shapes of boxes in a grid whose lines may lie anywhere.
namespace supple {

/// Coordinates from `from` to `to` in `cells` equal parts, without the last.
inline void append_lines(double from, double to, int cells, std::vector<double>& lines) {
  for (int k = 0; k < cells; ++k) lines.push_back(from + (to - from) * k / cells);
}

/// Surface of those boxes of a grid that are filled, in triangles. Its vertices are those of the
/// grid: two lines at one place part the boxes beside them by a gap of no width.
inline Mesh make_filled_boxes(const std::array<std::vector<double>, 3>& lines,
                              const std::function<bool(int, int, int)>& filled) {
  using Node = std::array<int, 3>;
  std::vector<Vec3> points;
  std::vector<std::vector<int>> quads;
  std::map<Node, int> numbers;
  const auto number = [&](const Node& node) {
    const auto [entry, added] = numbers.emplace(node, static_cast<int>(points.size()));
    if (added) points.emplace_back(lines[0][node[0]], lines[1][node[1]], lines[2][node[2]]);
    return entry->second;
  };
  const auto is_filled = [&](const Node& box) {
    for (int k = 0; k < 3; ++k)
      if (box[k] < 0 || box[k] + 1 >= static_cast<int>(lines[k].size())) return false;
    return filled(box[0], box[1], box[2]);
  };
  const auto boxes = [&](int axis) { return static_cast<int>(lines[axis].size()) - 1; };
  for (int i = 0; i < boxes(0); ++i)
    for (int j = 0; j < boxes(1); ++j)
      for (int k = 0; k < boxes(2); ++k)
        for (int axis = 0; is_filled({i, j, k}) && axis < 3; ++axis)
          for (int side : {0, 1}) {
            Node beside = {i, j, k};
            beside[axis] += side == 0 ? -1 : 1;
            if (is_filled(beside)) continue;
            const auto corner = [&](int du, int dv) {
              Node node = {i, j, k};
              node[axis] += side;
              node[(axis + 1) % 3] += du;
              node[(axis + 2) % 3] += dv;
              return number(node);
            };
            std::vector<int> quad = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
            if (side == 0) std::swap(quad[1], quad[3]);
            quads.push_back(std::move(quad));
          }
  return as_fans(make_mesh(points, quads));
}

/// Two fingers of 2×2×8 that stand side by side, `gap` apart, on a palm 3 high whose top is at
/// z = 0; x = 0 is the middle of the gap. A negative gap lets them overlap.
inline Mesh make_two_fingers(double gap) {
  std::array<std::vector<double>, 3> lines;
  append_lines(-2 - 0.5 * gap, -0.5 * gap, 4, lines[0]);
  append_lines(-0.5 * gap, 0.5 * gap, 1, lines[0]);
  append_lines(0.5 * gap, 2 + 0.5 * gap, 4, lines[0]);
  lines[0].push_back(2 + 0.5 * gap);
  append_lines(0, 2, 4, lines[1]);
  lines[1].push_back(2);
  append_lines(-3, 8, 22, lines[2]);
  lines[2].push_back(8);
  return make_filled_boxes(lines, [](int i, int, int k) { return k < 6 || i != 4; });
}

/// A block 6×2×4 with a notch of width 0.2 from its top down to its middle, at x = 0.
inline Mesh make_notched_block() {
  std::array<std::vector<double>, 3> lines;
  append_lines(-3, -0.1, 6, lines[0]);
  append_lines(-0.1, 0.1, 1, lines[0]);
  append_lines(0.1, 3, 6, lines[0]);
  lines[0].push_back(3);
  append_lines(0, 2, 4, lines[1]);
  lines[1].push_back(2);
  append_lines(-2, 2, 8, lines[2]);
  lines[2].push_back(2);
  return make_filled_boxes(lines, [](int i, int, int k) { return k < 4 || i != 6; });
}

}  // namespace supple
