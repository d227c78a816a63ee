#include "modeler/domain/welded_surface.h"

#include <algorithm>
#include <array>
#include <compare>
#include <cstdlib>
#include <numeric>
#include <tuple>
#include <utility>

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

/// The representative of i's set; halves the path to it on the way.
int root_of(std::vector<int>& parents, int i) {
  while (parents[i] != i) i = parents[i] = parents[parents[i]];
  return i;
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
  std::vector<Index> kept;
  for (Index t = 0; t < welded.rows(); ++t)
    if (welded(t, 0) != welded(t, 1) && welded(t, 1) != welded(t, 2) &&
        welded(t, 2) != welded(t, 0))
      kept.push_back(t);
  surface.triangles = rows_of(welded, kept);
  surface.originals = std::move(firsts);
  return surface;
}

Triangles rows_of(const Triangles& triangles, const std::vector<Index>& rows) {
  Triangles result(static_cast<Index>(rows.size()), 3);
  for (Index i = 0; i < result.rows(); ++i) result.row(i) = triangles.row(rows[i]);
  return result;
}

Triangles with_area(const Points& positions, const Triangles& triangles) {
  std::vector<Index> kept;
  for (Index t = 0; t < triangles.rows(); ++t) {
    const Vec3 a = positions.row(triangles(t, 0));
    const double ab = (positions.row(triangles(t, 1)).transpose() - a).norm();
    const double ac = (positions.row(triangles(t, 2)).transpose() - a).norm();
    // Below the rounding of a cross product of edges this long, an area is none.
    const double rounding = 1e-15 * ab * ac;
    if (double_area_normal(positions, triangles, t).norm() > rounding) kept.push_back(t);
  }
  return rows_of(triangles, kept);
}

Triangles without_duplicates(const Triangles& triangles) {
  struct Turned {
    std::array<int, 3> vertices;  // the least first
    Index row;
    auto operator<=>(const Turned&) const = default;
  };
  std::vector<Turned> all(triangles.rows());
  for (Index t = 0; t < triangles.rows(); ++t) {
    int least;
    triangles.row(t).minCoeff(&least);
    for (int k = 0; k < 3; ++k) all[t].vertices[k] = triangles(t, (least + k) % 3);
    all[t].row = t;
  }
  std::sort(all.begin(), all.end());
  std::vector<Index> kept;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (i == 0 || all[i].vertices != all[i - 1].vertices) kept.push_back(all[i].row);
  std::sort(kept.begin(), kept.end());
  return rows_of(triangles, kept);
}

std::vector<int> connected_parts(const Triangles& triangles) {
  std::vector<int> parents(triangles.size() > 0 ? triangles.maxCoeff() + 1 : 0);
  std::iota(parents.begin(), parents.end(), 0);
  for (Index t = 0; t < triangles.rows(); ++t)
    for (int k = 1; k < 3; ++k)
      parents[root_of(parents, triangles(t, k))] = root_of(parents, triangles(t, 0));
  std::vector<int> numbers(parents.size(), -1), parts(triangles.rows());
  int count = 0;
  for (Index t = 0; t < triangles.rows(); ++t) {
    int& number = numbers[root_of(parents, triangles(t, 0))];
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
