#include "modeler/domain/polygonize.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "solver/core/check.h"
#include "solver/core/parallel.h"

namespace supple {

namespace {

constexpr double most_nodes = 2e8;
constexpr Index queries_a_chunk = 256;

/// Nodes and the cells that begin at them share numbers.
class Lattice {
 public:
  explicit Lattice(const PolygonizeOptions& options) : width_(options.width) {
    SUPPLE_CHECK(width_ > 0, "the cells' width must be positive");
    // Off the box's corner, so that no plane of the shape lines up with the cells.
    lower_ = options.box.lower - width_ * Vec3(2.3137, 2.1271, 2.2213);
    double nodes = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const double count = std::ceil(options.box.size()[axis] / width_ + 4.5) + 1;
      nodes *= count;
      counts_[axis] = static_cast<Index>(count);
    }
    SUPPLE_CHECK(nodes < most_nodes, "cells far too small for the box");
    strides_ = {1, counts_[0], counts_[0] * counts_[1]};
  }

  Index size() const { return strides_[2] * counts_[2]; }
  Index stride(int axis) const { return strides_[axis]; }
  Index corner(Index cell, int k) const {
    return cell + (k & 1) + (k >> 1 & 1) * strides_[1] + (k >> 2 & 1) * strides_[2];
  }
  Index cell_at(const Vec3& x) const {
    Index cell = 0;
    for (int axis = 0; axis < 3; ++axis)
      cell += strides_[axis] *
              std::clamp<Index>(Index((x[axis] - lower_[axis]) / width_), 1, counts_[axis] - 3);
    return cell;
  }
  Vec3 position(Index node) const {
    const Vec3 steps(double(node % counts_[0]), double(node / strides_[1] % counts_[1]),
                     double(node / strides_[2]));
    return lower_ + width_ * steps;
  }
  /// True for the nodes of the outermost layer.
  bool outermost(Index node) const {
    for (int axis = 0; axis < 3; ++axis) {
      const Index step = node / strides_[axis] % counts_[axis];
      if (step <= 0 || step >= counts_[axis] - 1) return true;
    }
    return false;
  }

 private:
  double width_;
  Vec3 lower_;
  std::array<Index, 3> counts_, strides_;
};

class SurfaceNets {
 public:
  SurfaceNets(const std::function<double(const Vec3&)>& f, const Points& seeds,
              const PolygonizeOptions& options)
      : f_(f),
        lattice_(options),
        value_of_(static_cast<std::size_t>(lattice_.size()), -1),
        seen_(static_cast<std::size_t>(lattice_.size()), 0) {
    std::vector<Index> wave;
    for (Index i = 0; i < seeds.rows(); ++i) see(lattice_.cell_at(seeds.row(i)), wave);
    while (!wave.empty()) wave = pass(wave);
    std::sort(cells_.begin(), cells_.end());
  }

  Polygons polygons() {
    std::vector<int> vertex_of(static_cast<std::size_t>(lattice_.size()), -1);
    Polygons result;
    result.positions.resize(static_cast<Index>(cells_.size()), 3);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      vertex_of[cells_[i]] = static_cast<int>(i);
      result.positions.row(static_cast<Index>(i)) = middle(cells_[i]).transpose();
    }
    std::vector<std::array<int, 3>> triangles;
    for (Index cell : cells_)
      for (int axis = 0; axis < 3; ++axis)
        if (inside(cell) != inside(cell + lattice_.stride(axis)))
          add_quad(vertex_of, result.positions, cell, axis, triangles);
    result.triangles.resize(static_cast<Index>(triangles.size()), 3);
    for (std::size_t t = 0; t < triangles.size(); ++t)
      result.triangles.row(static_cast<Index>(t)) << triangles[t][0], triangles[t][1],
          triangles[t][2];
    return result;
  }

 private:
  void see(Index cell, std::vector<Index>& wave) {
    if (seen_[cell]) return;
    seen_[cell] = 1;
    wave.push_back(cell);
  }

  /// Asks for the corners of some cells; returns the cells to look at next.
  std::vector<Index> pass(const std::vector<Index>& wave) {
    std::vector<Index> nodes;
    const std::size_t known = values_.size();
    for (Index cell : wave)
      for (int k = 0; k < 8; ++k) {
        int& value = value_of_[lattice_.corner(cell, k)];
        if (value >= 0) continue;
        value = static_cast<int>(known + nodes.size());
        nodes.push_back(lattice_.corner(cell, k));
      }
    values_.resize(known + nodes.size());
    parallel_chunks(static_cast<Index>(nodes.size()), queries_a_chunk, [&](Index begin, Index end) {
      for (Index i = begin; i < end; ++i)
        values_[known + i] = lattice_.outermost(nodes[i]) ? 1 : f_(lattice_.position(nodes[i]));
    });
    std::vector<Index> next;
    for (Index cell : wave) {
      unsigned signs = 0;
      for (int k = 0; k < 8; ++k) signs |= unsigned(inside(lattice_.corner(cell, k))) << k;
      if (signs == 0 || signs == 0xff) continue;
      cells_.push_back(cell);
      for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side)
          if (mixed(signs, axis, side))
            see(side ? cell + lattice_.stride(axis) : cell - lattice_.stride(axis), next);
    }
    return next;
  }

  /// True where the signs at the four corners of a cell's face differ.
  static bool mixed(unsigned signs, int axis, int side) {
    constexpr std::array<std::array<unsigned, 2>, 3> faces = {
        {{0x55, 0xaa}, {0x33, 0xcc}, {0x0f, 0xf0}}};
    const unsigned face = faces[axis][side];
    return (signs & face) != 0 && (signs & face) != face;
  }

  double value(Index node) const { return values_[value_of_[node]]; }
  bool inside(Index node) const { return value(node) < 0; }

  /// Mean of where the surface passes the cell's edges.
  Vec3 middle(Index cell) const {
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (int k = 0; k < 8; ++k)
      for (int axis = 0; axis < 3; ++axis) {
        if (k >> axis & 1) continue;
        const Index a = lattice_.corner(cell, k), b = a + lattice_.stride(axis);
        if (inside(a) == inside(b)) continue;
        const double share = value(a) / (value(a) - value(b));
        sum += (1 - share) * lattice_.position(a) + share * lattice_.position(b);
        ++count;
      }
    return sum / count;
  }

  /// The four cells about the edge that leaves a cell's first corner along an axis, outward.
  void add_quad(const std::vector<int>& vertex_of, const Points& positions, Index cell, int axis,
                std::vector<std::array<int, 3>>& triangles) const {
    const Index u = lattice_.stride((axis + 1) % 3), v = lattice_.stride((axis + 2) % 3);
    std::array<int, 4> quad = {vertex_of[cell], vertex_of[cell - u], vertex_of[cell - u - v],
                               vertex_of[cell - v]};
    if (!inside(cell)) std::swap(quad[1], quad[3]);
    const auto length2 = [&](int a, int b) {
      return (positions.row(quad[a]) - positions.row(quad[b])).squaredNorm();
    };
    const int first = length2(0, 2) <= length2(1, 3) ? 0 : 1;
    const auto at = [&](int k) { return quad[(first + k) % 4]; };
    triangles.push_back({at(0), at(1), at(2)});
    triangles.push_back({at(0), at(2), at(3)});
  }

  const std::function<double(const Vec3&)>& f_;
  Lattice lattice_;
  std::vector<int> value_of_;  ///< by node; −1: not asked for
  std::vector<char> seen_;     ///< by cell
  std::vector<double> values_;
  std::vector<Index> cells_;  ///< that the surface passes
};

}  // namespace

Polygons polygonize(const std::function<double(const Vec3&)>& f, const Points& seeds,
                    const PolygonizeOptions& options) {
  return SurfaceNets(f, seeds, options).polygons();
}

}  // namespace supple
