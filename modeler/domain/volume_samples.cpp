#include "modeler/domain/volume_samples.h"

#include <algorithm>
#include <cmath>

#include "solver/core/parallel.h"
#include "solver/core/random.h"

namespace supple {

namespace {

constexpr Index cells_a_chunk = 64;

/// Cubes of one size about the region's box, off its middle so that no shape lines up with them.
std::vector<RegionCell> root_cells(const Region& region, double width) {
  const Box box = region.bounds();
  RegionCell root;
  root.half_width = 0.5 * width;
  while (2 * root.half_width < box.size().maxCoeff() + 2 * width) root.half_width *= 2;
  root.center = box.center() + width * Vec3(0.3137, 0.1271, 0.2213);
  look_at(region, {}, root);
  return {root};
}

/// The halves of all cells, in order.
std::vector<RegionCell> halve(const Region& region, const std::vector<RegionCell>& cells) {
  const Index count = static_cast<Index>(cells.size());
  std::vector<std::vector<RegionCell>> parts((count + cells_a_chunk - 1) / cells_a_chunk);
  parallel_chunks(count, cells_a_chunk, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i)
      append_halves(region, cells[i], parts[begin / cells_a_chunk]);
  });
  std::vector<RegionCell> result;
  for (const auto& part : parts) result.insert(result.end(), part.begin(), part.end());
  return result;
}

struct Sample {
  Vec3 position;
  double volume;
};

/// How a plane through the boundary point cuts a cell.
struct PlaneCut {
  Vec3 outward;      ///< unit normal
  double depth = 0;  ///< of the part that is inside, along the normal [m]
  double reach = 0;  ///< of the whole cell along the normal [m]
};

/// None where the plane passes the cell by.
std::optional<PlaneCut> plane_cut(const RegionCell& cell) {
  PlaneCut cut;
  cut.outward = cell.outward();
  cut.reach = 2 * cell.half_width * cut.outward.lpNorm<1>();
  const double depth = 0.5 * cut.reach + (cell.center_inside ? 1 : -1) * cell.distance();
  cut.depth = std::min(depth, cut.reach);
  if (cut.depth <= 0) return std::nullopt;
  return cut;
}

/// Samples the part of one cell that is inside the region.
class CellSampler {
 public:
  CellSampler(const Region& region, std::vector<Sample>& samples)
      : region_(region), samples_(samples) {}

  void add_inner(const RegionCell& cell, std::uint64_t seed) {
    Random random(seed);
    const Vec3 shift = 0.5 * cell.half_width * random.in_cube(-1, 1);
    samples_.push_back({cell.center + shift, cell.volume()});
  }

  /// Halves the cell up to `halvings` times where its part does not look cut by a plane.
  void add_cut(const RegionCell& cell, int halvings) {
    if (cell.inner) {
      samples_.push_back({cell.center, cell.volume()});
      return;
    }
    const std::optional<PlaneCut> cut = plane_cut(cell);
    if (!cut) return;
    const Vec3 middle = cell.boundary_point - 0.5 * cut->depth * cut->outward;
    const double share = cut->depth / cut->reach;
    if (plane_like(cell, middle, 0.5 * cut->depth)) {
      samples_.push_back({middle, share * cell.volume()});
    } else if (halvings > 0) {
      std::vector<RegionCell> halves;
      append_halves(region_, cell, halves);
      for (const RegionCell& half : halves) add_cut(half, halvings - 1);
    } else {
      add_thin(cell, *cut);
    }
  }

 private:
  bool plane_like(const RegionCell& cell, const Vec3& middle, double expected_depth) const {
    const double depth = (region_.closest_boundary_point(middle) - middle).norm();
    if (depth < 0.7 * expected_depth) return false;
    return contains(region_, cell, middle);
  }

  /// A part thinner than the cell: t = δ + distance to its other side, from a point δ inside.
  void add_thin(const RegionCell& cell, const PlaneCut& cut) {
    const std::optional<Vec3> inside = inside_at_boundary(region_, cell);
    if (!inside) return;
    const double depth = (*inside - cell.boundary_point).norm();
    const double beyond = (region_.closest_boundary_point(*inside) - *inside).norm();
    const double thickness = std::min(cut.depth, depth + beyond);
    samples_.push_back({*inside, thickness / cut.reach * cell.volume()});
  }

  const Region& region_;
  std::vector<Sample>& samples_;
};

}  // namespace

VolumeSamples sample_volume(const Region& region, const VolumeSampleOptions& options) {
  VolumeSamples result;
  result.cells = root_cells(region, options.width);
  while (!result.cells.empty() && result.cells.front().half_width > 0.51 * options.width &&
         static_cast<Index>(result.cells.size()) < options.enough)
    result.cells = halve(region, result.cells);

  const Index count = static_cast<Index>(result.cells.size());
  std::vector<std::vector<Sample>> parts((count + cells_a_chunk - 1) / cells_a_chunk);
  parallel_chunks(count, cells_a_chunk, [&](Index begin, Index end) {
    CellSampler sampler(region, parts[begin / cells_a_chunk]);
    for (Index i = begin; i < end; ++i) {
      const RegionCell& cell = result.cells[i];
      if (cell.inner)
        sampler.add_inner(cell, options.seed + static_cast<std::uint64_t>(i));
      else
        sampler.add_cut(cell, 1);
    }
  });
  std::vector<Sample> samples;
  for (const auto& part : parts) samples.insert(samples.end(), part.begin(), part.end());
  result.positions.resize(static_cast<Index>(samples.size()), 3);
  result.volumes.resize(static_cast<Index>(samples.size()));
  for (Index i = 0; i < result.volumes.size(); ++i) {
    result.positions.row(i) = samples[i].position.transpose();
    result.volumes[i] = samples[i].volume;
  }
  return result;
}

}  // namespace supple
