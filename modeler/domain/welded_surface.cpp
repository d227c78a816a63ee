#include "modeler/domain/welded_surface.h"

#include <algorithm>
#include <array>
#include <compare>
#include <cstdlib>
#include <numeric>
#include <tuple>
#include <utility>

#include "modeler/domain/disjoint_sets.h"
#include "modeler/domain/surface_measures.h"

namespace supple {

namespace {

/// For each position the number of its value, values in ascending order.
std::vector<int> number_positions(const Points& positions, std::vector<int>& firsts) {
  const int count = static_cast<int>(positions.rows());
  const auto key = [&](int i) {
    return std::make_tuple(positions(i, 0), positions(i, 1), positions(i, 2));
  };
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int i, int j) { return std::make_tuple(key(i), i) < std::make_tuple(key(j), j); });
  std::vector<int> numbers(count);
  for (int i : order) {
    if (firsts.empty() || key(firsts.back()) != key(i)) firsts.push_back(i);
    numbers[i] = static_cast<int>(firsts.size()) - 1;
  }
  return numbers;
}

}  // namespace

WeldedSurface weld(const Points& positions, const Triangles& triangles) {
  std::vector<int> firsts;
  const std::vector<int> numbers = number_positions(positions, firsts);
  WeldedSurface surface;
  surface.positions.resize(static_cast<Index>(firsts.size()), 3);
  for (Index i = 0; i < surface.positions.rows(); ++i)
    surface.positions.row(i) = positions.row(firsts[i]);

  Triangles welded = triangles.unaryExpr([&](int vertex) { return numbers[vertex]; });
  std::vector<int> kept;
  for (Index t = 0; t < welded.rows(); ++t)
    if (welded(t, 0) != welded(t, 1) && welded(t, 1) != welded(t, 2) &&
        welded(t, 2) != welded(t, 0))
      kept.push_back(static_cast<int>(t));
  surface.triangles = rows_of(welded, kept);
  surface.originals = std::move(firsts);
  return surface;
}

std::vector<int> first_at_position(const Points& positions) {
  std::vector<int> firsts;
  std::vector<int> numbers = number_positions(positions, firsts);
  for (int& number : numbers) number = firsts[number];
  return numbers;
}

std::vector<int> rows_with_area(const Points& positions, const Triangles& triangles) {
  std::vector<int> kept;
  for (Index t = 0; t < triangles.rows(); ++t) {
    const Vec3 a = positions.row(triangles(t, 0));
    const double ab = (positions.row(triangles(t, 1)).transpose() - a).norm();
    const double ac = (positions.row(triangles(t, 2)).transpose() - a).norm();
    // Below the rounding of a cross product of edges this long, an area is none.
    const double rounding = 1e-15 * ab * ac;
    if (double_area_normal(positions, triangles, t).norm() > rounding)
      kept.push_back(static_cast<int>(t));
  }
  return kept;
}

Triangles with_area(const Points& positions, const Triangles& triangles) {
  return rows_of(triangles, rows_with_area(positions, triangles));
}

Triangles without_duplicates(const Triangles& triangles) {
  struct Turned {
    std::array<int, 3> vertices;  // the least first
    int row;
    auto operator<=>(const Turned&) const = default;
  };
  std::vector<Turned> all(triangles.rows());
  for (Index t = 0; t < triangles.rows(); ++t) {
    int least;
    triangles.row(t).minCoeff(&least);
    for (int k = 0; k < 3; ++k) all[t].vertices[k] = triangles(t, (least + k) % 3);
    all[t].row = static_cast<int>(t);
  }
  std::sort(all.begin(), all.end());
  std::vector<int> kept;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (i == 0 || all[i].vertices != all[i - 1].vertices) kept.push_back(all[i].row);
  std::sort(kept.begin(), kept.end());
  return rows_of(triangles, kept);
}

std::vector<int> connected_parts(const Triangles& triangles) {
  const std::size_t vertices = triangles.size() > 0 ? triangles.maxCoeff() + 1 : 0;
  DisjointSets joined(vertices);
  for (Index t = 0; t < triangles.rows(); ++t)
    for (int k = 1; k < 3; ++k) joined.unite(triangles(t, k), triangles(t, 0));
  std::vector<int> numbers(vertices, -1), parts(triangles.rows());
  int count = 0;
  for (Index t = 0; t < triangles.rows(); ++t) {
    int& number = numbers[joined.root(triangles(t, 0))];
    if (number < 0) number = count++;
    parts[t] = number;
  }
  return parts;
}

std::vector<BoundaryEdge> boundary_edges(const Triangles& triangles) {
  std::vector<BoundaryEdge> passes;
  passes.reserve(3 * static_cast<std::size_t>(triangles.rows()));
  for (Index t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(t, k), b = triangles(t, (k + 1) % 3);
      passes.push_back(a < b ? BoundaryEdge{a, b, 1} : BoundaryEdge{b, a, -1});
    }
  std::sort(passes.begin(), passes.end(), [](const BoundaryEdge& x, const BoundaryEdge& y) {
    return std::tie(x.a, x.b) < std::tie(y.a, y.b);
  });
  std::vector<BoundaryEdge> result;
  for (const BoundaryEdge& pass : passes) {
    if (!result.empty() && result.back().a == pass.a && result.back().b == pass.b) {
      result.back().excess += pass.excess;
      continue;
    }
    if (!result.empty() && result.back().excess == 0) result.pop_back();
    result.push_back(pass);
  }
  if (!result.empty() && result.back().excess == 0) result.pop_back();
  return result;
}

}  // namespace supple
