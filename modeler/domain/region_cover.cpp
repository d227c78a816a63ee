#include "modeler/domain/region_cover.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "modeler/domain/welded_surface.h"
#include "solver/core/check.h"
#include "solver/core/parallel.h"

namespace supple {

namespace {

constexpr double cells_a_diagonal = 64;
constexpr double most_nodes = 2e7;
constexpr int bisections = 4;
constexpr Index queries_a_chunk = 256;

/// Corners of a cell, and edges from a node to another, as bits: 1 along x, 2 along y, 4 along z.
using Corner = int;

/// The six tetrahedra of a cell: ways from corner 0 to corner 7, one axis at a time.
constexpr std::array<std::array<Corner, 4>, 6> tetrahedra = {
    {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};

Vec3 offset(Corner corner) {
  return Vec3(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
}

/// A grid of nodes about a box, off its middle so that no plane of the shape lines up with it.
class Grid {
 public:
  Grid(const Box& box, double width) : width_(width) {
    origin_ = box.lower - width * Vec3(1.3137, 1.1271, 1.2213);
    for (int axis = 0; axis < 3; ++axis)
      counts_[axis] = static_cast<int>(std::ceil(box.size()[axis] / width + 2.5)) + 1;
    SUPPLE_CHECK(static_cast<double>(counts_[0]) * counts_[1] * counts_[2] < most_nodes,
                 "cells far too small for the box");
  }

  Index size() const { return Index{counts_[0]} * counts_[1] * counts_[2]; }
  std::array<int, 3> place(Index node) const {
    const Index row = node / counts_[0];
    return {static_cast<int>(node % counts_[0]), static_cast<int>(row % counts_[1]),
            static_cast<int>(row / counts_[1])};
  }
  Index next(Index node, Corner corner) const {
    return node + (corner & 1) + Index{corner >> 1 & 1} * counts_[0] +
           Index{corner >> 2 & 1} * counts_[0] * counts_[1];
  }
  Vec3 position(Index node) const {
    const auto [i, j, k] = place(node);
    return origin_ + width_ * Vec3(i, j, k);
  }
  bool outermost(Index node) const {
    const auto at = place(node);
    for (int axis = 0; axis < 3; ++axis)
      if (at[axis] == 0 || at[axis] == counts_[axis] - 1) return true;
    return false;
  }
  /// True where a cell begins at the node.
  bool has_cell(Index node) const {
    const auto at = place(node);
    for (int axis = 0; axis < 3; ++axis)
      if (at[axis] == counts_[axis] - 1) return false;
    return true;
  }
  double width() const { return width_; }

 private:
  double width_;
  Vec3 origin_;
  std::array<int, 3> counts_;
};

/// Where the boundary passes an edge of the grid.
struct Root {
  Index node;
  Corner edge;  ///< to the other end
  Vec3 position = Vec3::Zero();
  bool on_input = false;
};

/// Marching tetrahedra.
class Polygonizer {
 public:
  Polygonizer(const ImplicitRegion& region, double width, double reach)
      : region_(region), reach_(reach), grid_(region.box, width) {
    ask_nodes();
    list_roots();
    parallel_chunks(static_cast<Index>(roots_.size()), queries_a_chunk,
                    [&](Index begin, Index end) {
                      for (Index i = begin; i < end; ++i) find(roots_[static_cast<std::size_t>(i)]);
                    });
    for (const Index node : cells_)
      for (const auto& tetrahedron : tetrahedra) cut(node, tetrahedron);
  }

  RegionCover cover() const {
    Points positions(static_cast<Index>(roots_.size()), 3);
    std::vector<bool> on_input;
    for (const Root& root : roots_) {
      positions.row(static_cast<Index>(on_input.size())) = root.position.transpose();
      on_input.push_back(root.on_input);
    }
    Triangles triangles(static_cast<Index>(triangles_.size()), 3);
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      for (int k = 0; k < 3; ++k)
        triangles(static_cast<Index>(t), k) = triangles_[t][static_cast<std::size_t>(k)];
    return measure_cover(positions, triangles, on_input);
  }

 private:
  bool inside(Index node) const { return values_[static_cast<std::size_t>(node)] > 0.5; }

  void ask_nodes() {
    values_.assign(static_cast<std::size_t>(grid_.size()), 0);
    parallel_chunks(grid_.size(), queries_a_chunk, [&](Index begin, Index end) {
      for (Index node = begin; node < end; ++node)
        if (!grid_.outermost(node))
          values_[static_cast<std::size_t>(node)] = region_.value(grid_.position(node));
    });
  }

  void list_roots() {
    numbers_.assign(7 * values_.size(), -1);
    for (Index node = 0; node < grid_.size(); ++node) {
      if (!grid_.has_cell(node)) continue;
      int corners_inside = 0;
      for (Corner corner = 0; corner < 8; ++corner)
        if (inside(grid_.next(node, corner))) ++corners_inside;
      if (corners_inside == 0 || corners_inside == 8) continue;
      cells_.push_back(node);
      for (const auto& tetrahedron : tetrahedra)
        for (int i = 0; i < 4; ++i)
          for (int j = i + 1; j < 4; ++j)
            list(grid_.next(node, tetrahedron[i] & tetrahedron[j]),
                 tetrahedron[i] ^ tetrahedron[j]);
    }
  }

  void list(Index node, Corner edge) {
    int& number = numbers_[slot(node, edge)];
    if (number >= 0 || inside(node) == inside(grid_.next(node, edge))) return;
    number = static_cast<int>(roots_.size());
    roots_.push_back({node, edge});
  }

  static std::size_t slot(Index node, Corner edge) {
    return 7 * static_cast<std::size_t>(node) + static_cast<std::size_t>(edge) - 1;
  }

  /// Where the edge passes through the input once; else bisects it, then takes the value for
  /// linear: the jump at a piece of the input lies within what is left.
  void find(Root& root) const {
    Index ends[2] = {root.node, grid_.next(root.node, root.edge)};
    if (!inside(ends[0])) std::swap(ends[0], ends[1]);
    Vec3 in = grid_.position(ends[0]), out = grid_.position(ends[1]);
    const Passage passage = region_.passage ? region_.passage(in, out) : Passage{2, 0};
    if (passage.times == 1) {
      root.position = in + passage.share * (out - in);
      root.on_input = true;
      return;
    }
    double value_in = values_[static_cast<std::size_t>(ends[0])];
    double value_out = values_[static_cast<std::size_t>(ends[1])];
    for (int step = 0; step < bisections; ++step) {
      const Vec3 middle = 0.5 * (in + out);
      const double value = region_.value(middle);
      (value > 0.5 ? in : out) = middle;
      (value > 0.5 ? value_in : value_out) = value;
    }
    const double share = std::clamp((value_in - 0.5) / (value_in - value_out), 0.0, 1.0);
    root.position = in + share * (out - in);
    root.on_input =
        passage.times > 0 && region_.distance(root.position) <= reach_ + (out - in).norm();
  }

  /// The triangles within one tetrahedron of the cell at a node, outward.
  void cut(Index node, const std::array<Corner, 4>& tetrahedron) {
    std::array<Corner, 4> in{}, out{};
    int ins = 0, outs = 0;
    for (const Corner corner : tetrahedron)
      (inside(grid_.next(node, corner)) ? in[ins++] : out[outs++]) = corner;
    if (ins == 1)
      add(node, {{{in[0], out[0]}, {in[0], out[1]}, {in[0], out[2]}}});
    else if (outs == 1)
      add(node, {{{in[0], out[0]}, {in[1], out[0]}, {in[2], out[0]}}});
    else if (ins == 2) {
      add(node, {{{in[0], out[0]}, {in[0], out[1]}, {in[1], out[1]}}});
      add(node, {{{in[0], out[0]}, {in[1], out[1]}, {in[1], out[0]}}});
    }
  }

  /// A triangle on three edges, each from inside to outside.
  void add(Index node, const std::array<std::array<Corner, 2>, 3>& edges) {
    std::array<int, 3> triangle;
    std::array<Vec3, 3> middles;
    Vec3 outward = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      const auto [in, out] = edges[k];
      triangle[k] = numbers_[slot(grid_.next(node, in & out), in ^ out)];
      middles[k] = 0.5 * (offset(in) + offset(out));
      outward += offset(out) - offset(in);
    }
    // By the edges' middles: a root near a node could make a triangle too small to tell.
    if ((middles[1] - middles[0]).cross(middles[2] - middles[0]).dot(outward) < 0)
      std::swap(triangle[1], triangle[2]);
    triangles_.push_back(triangle);
  }

  const ImplicitRegion& region_;
  double reach_;
  Grid grid_;
  std::vector<double> values_;  ///< by node
  std::vector<int> numbers_;    ///< of roots, by edge; −1: none
  std::vector<Index> cells_;    ///< first nodes of those that the boundary passes
  std::vector<Root> roots_;
  std::vector<std::array<int, 3>> triangles_;
};

/// Areas of the boundary's pieces and the caps among them.
class Accountant {
 public:
  Accountant(const Points& positions, const Triangles& triangles, const std::vector<bool>& on_input)
      : boundary_(positions), on_input_(on_input) {
    for (Index t = 0; t < triangles.rows(); ++t) add(triangles.row(t));
    cover_.caps.resize(static_cast<Index>(caps_.size()), 3);
    for (std::size_t t = 0; t < caps_.size(); ++t)
      for (int k = 0; k < 3; ++k)
        cover_.caps(static_cast<Index>(t), k) = caps_[t][static_cast<std::size_t>(k)];
    cover_.cap_positions.resize(static_cast<Index>(positions_.size()), 3);
    for (std::size_t i = 0; i < positions_.size(); ++i)
      cover_.cap_positions.row(static_cast<Index>(i)) = positions_[i].transpose();
  }

  RegionCover cover() {
    if (!(cover_.area > 0)) return std::move(cover_);
    cover_.covered = 1 - open_area_ / cover_.area;
    measure_greatest_opening();
    return std::move(cover_);
  }

 private:
  void add(const Eigen::RowVector3i& triangle) {
    std::array<Vec3, 3> x;
    int beyond = 0;
    for (int k = 0; k < 3; ++k) {
      x[k] = boundary_.row(triangle[k]);
      if (!on_input_[static_cast<std::size_t>(triangle[k])]) ++beyond;
    }
    const double area = 0.5 * (x[1] - x[0]).cross(x[2] - x[0]).norm();
    cover_.area += area;
    if (beyond == 0) return;
    open_area_ += area * beyond / 3;
    open_areas_.push_back(area * beyond / 3);
    middles_.push_back((x[0] + x[1] + x[2]) / 3);
    caps_.push_back({cap_vertex(triangle[0]), cap_vertex(triangle[1]), cap_vertex(triangle[2])});
  }

  int cap_vertex(int vertex) {
    if (numbers_.empty()) numbers_.assign(on_input_.size(), -1);
    int& number = numbers_[static_cast<std::size_t>(vertex)];
    if (number < 0) {
      number = static_cast<int>(positions_.size());
      positions_.push_back(boundary_.row(vertex));
      cover_.cap_on_input.push_back(on_input_[static_cast<std::size_t>(vertex)]);
    }
    return number;
  }

  void measure_greatest_opening() {
    const std::vector<int> pieces = connected_parts(cover_.caps);
    std::vector<double> areas;
    std::vector<Vec3> sums;
    for (std::size_t t = 0; t < pieces.size(); ++t) {
      const auto piece = static_cast<std::size_t>(pieces[t]);
      areas.resize(std::max(areas.size(), piece + 1), 0);
      sums.resize(areas.size(), Vec3::Zero());
      areas[piece] += open_areas_[t];
      sums[piece] += open_areas_[t] * middles_[t];
    }
    const auto greatest = std::max_element(areas.begin(), areas.end());
    if (greatest == areas.end() || !(*greatest > 0)) return;
    cover_.greatest_opening = *greatest / cover_.area;
    cover_.opening = sums[static_cast<std::size_t>(greatest - areas.begin())] / *greatest;
  }

  const Points& boundary_;
  const std::vector<bool>& on_input_;
  RegionCover cover_;
  double open_area_ = 0;
  std::vector<double> open_areas_;  ///< by cap
  std::vector<Vec3> middles_;       ///< by cap
  std::vector<std::array<int, 3>> caps_;
  std::vector<Vec3> positions_;
  std::vector<int> numbers_;  ///< of cap positions, by the boundary's; −1: none
};

}  // namespace

RegionCover cover_region(const ImplicitRegion& region, const RegionCoverOptions& options) {
  const double diagonal = region.box.diagonal();
  if (!(diagonal > 0)) return {};
  const double width = options.width > 0 ? options.width : diagonal / cells_a_diagonal;
  return Polygonizer(region, width, options.reach).cover();
}

RegionCover measure_cover(const Points& positions, const Triangles& triangles,
                          const std::vector<bool>& on_input) {
  return Accountant(positions, triangles, on_input).cover();
}

}  // namespace supple
