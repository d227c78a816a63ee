#include "modeler/domain/trimmed_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "solver/core/parallel.h"

namespace supple {

namespace {

constexpr Index triangles_a_chunk = 64;

using Corners = std::array<Vec3, 3>;

/// What a triangle is to the region.
enum class Bound { none, outward, inward, mixed };

/// A piece of a triangle that bounds the region, outward.
struct Piece {
  int source;
  bool whole;  ///< all of the source, which `turned` says how to read
  bool turned;
  Corners corners;
};

class Trimmer {
 public:
  Trimmer(const TriangleTree& winding, const TrimOptions& options, std::vector<Piece>& pieces)
      : winding_(winding), options_(options), pieces_(pieces) {}

  void trim(int source, const Corners& corners) {
    source_ = source;
    const Bound bound = visit(corners);
    if (bound != Bound::mixed) add(corners, bound, true);
  }

 private:
  /// Appends pieces only where the triangle is mixed.
  Bound visit(const Corners& c) {
    const double longest = std::sqrt(std::max(
        {(c[1] - c[0]).squaredNorm(), (c[2] - c[1]).squaredNorm(), (c[0] - c[2]).squaredNorm()}));
    if (longest <= options_.width) return ask(c);
    const Vec3 ab = 0.5 * (c[0] + c[1]), bc = 0.5 * (c[1] + c[2]), ca = 0.5 * (c[2] + c[0]);
    const std::array<Corners, 4> parts = {
        {{c[0], ab, ca}, {ab, c[1], bc}, {ca, bc, c[2]}, {ab, bc, ca}}};
    std::array<Bound, 4> bounds;
    if (longest <= options_.grain) {
      for (int i = 0; i < 4; ++i) bounds[i] = ask(parts[i]);
      if (uniform(bounds)) return bounds[0];
    }
    for (int i = 0; i < 4; ++i) bounds[i] = visit(parts[i]);
    if (uniform(bounds)) return bounds[0];
    for (int i = 0; i < 4; ++i)
      if (bounds[i] != Bound::mixed) add(parts[i], bounds[i], false);
    return Bound::mixed;
  }

  static bool uniform(const std::array<Bound, 4>& bounds) {
    return bounds[0] != Bound::mixed &&
           std::all_of(bounds.begin(), bounds.end(), [&](Bound b) { return b == bounds[0]; });
  }

  Bound ask(const Corners& c) const {
    const Vec3 middle = (c[0] + c[1] + c[2]) / 3;
    const Vec3 step = options_.offset * (c[1] - c[0]).cross(c[2] - c[0]).normalized();
    const bool below = winding_.winding_number(middle - step) > 0.5;
    const bool above = winding_.winding_number(middle + step) > 0.5;
    if (below == above) return Bound::none;
    return below ? Bound::outward : Bound::inward;
  }

  void add(const Corners& corners, Bound bound, bool whole) {
    if (bound == Bound::none) return;
    const bool turned = bound == Bound::inward;
    pieces_.push_back({source_, whole, turned, corners});
    if (turned) std::swap(pieces_.back().corners[1], pieces_.back().corners[2]);
  }

  const TriangleTree& winding_;
  const TrimOptions& options_;
  std::vector<Piece>& pieces_;
  int source_ = 0;
};

/// All pieces, in the order of their triangles.
std::vector<Piece> pieces_of(const TriangleTree& winding, const Points& positions,
                             const Triangles& triangles, const TrimOptions& options) {
  const Index count = triangles.rows();
  std::vector<std::vector<Piece>> parts((count + triangles_a_chunk - 1) / triangles_a_chunk);
  parallel_chunks(count, triangles_a_chunk, [&](Index begin, Index end) {
    Trimmer trimmer(winding, options, parts[begin / triangles_a_chunk]);
    for (Index t = begin; t < end; ++t)
      trimmer.trim(static_cast<int>(t),
                   {positions.row(triangles(t, 0)), positions.row(triangles(t, 1)),
                    positions.row(triangles(t, 2))});
  });
  std::vector<Piece> pieces;
  for (const auto& part : parts) pieces.insert(pieces.end(), part.begin(), part.end());
  return pieces;
}

}  // namespace

TrimmedSurface trim(const TriangleTree& winding, Points& positions, const Triangles& triangles,
                    const TrimOptions& options) {
  const std::vector<Piece> pieces = pieces_of(winding, positions, triangles, options);
  TrimmedSurface trimmed;
  trimmed.triangles.resize(static_cast<Index>(pieces.size()), 3);
  Index corner = positions.rows();
  const auto cut = std::count_if(pieces.begin(), pieces.end(), [](auto& p) { return !p.whole; });
  positions.conservativeResize(corner + 3 * cut, 3);
  trimmed.whole = static_cast<Index>(pieces.size()) == triangles.rows();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Piece& piece = pieces[i];
    trimmed.sources.push_back(piece.source);
    trimmed.whole = trimmed.whole && piece.whole && !piece.turned;
    auto row = trimmed.triangles.row(static_cast<Index>(i));
    if (piece.whole) {
      row = triangles.row(piece.source);
      if (piece.turned) std::swap(row[1], row[2]);
      continue;
    }
    for (int k = 0; k < 3; ++k) {
      positions.row(corner) = piece.corners[k].transpose();
      row[k] = static_cast<int>(corner++);
    }
  }
  return trimmed;
}

}  // namespace supple
