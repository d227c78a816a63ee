#include "modeler/domain/octree_particles.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

#include "modeler/domain/leaf_parts.h"
#include "modeler/domain/region_cell.h"
#include "modeler/domain/sample_particles.h"
#include "modeler/domain/shape_error.h"
#include "modeler/domain/site_tree.h"
#include "solver/core/parallel.h"
#include "solver/field/neighbors.h"

namespace supple {

namespace {

constexpr Index leaves_a_chunk = 16;

/// How far inside the boundary projected nodes lie, over half their leaf's edge.
constexpr double hair = 0.01;

/// Of a leaf at the boundary, to measure its inside part.
constexpr int volume_halvings = 2;

/// Trees that are built at most to come near a count, and how near is near enough.
constexpr int most_trials = 8;
constexpr double count_tolerance = 0.02;

/// The count of nodes falls about with this power of the width: 3 in bulk, 2 in sheets.
constexpr double usual_power = 2.5;

double support_of(const OctreeParticleOptions& options, double width) {
  if (options.kernel == KernelKind::box) return 0.5 * options.cover * width;
  return options.cover * width * std::cbrt(3 / (4 * std::numbers::pi));
}

/// A place a hair from `surface` on the way to `target`; none where that is outside.
std::optional<Vec3> just_inside(const Region& region, const Vec3& surface, const Vec3& target,
                                double half_width) {
  const Vec3 way = target - surface;
  if (!(way.norm() > 0)) return std::nullopt;
  for (double depth = hair * half_width; depth > 1e-4 * hair * half_width; depth *= 0.25) {
    const Vec3 place = surface + depth * way.normalized();
    if (region.contains(place)) return place;
  }
  return std::nullopt;
}

/// Beyond the boundary point as seen from the leaf's centre; where the centre lies at the boundary
/// itself, on the way to a half that is inside.
std::optional<Vec3> projected(const Region& region, const OctreeLeaf& leaf) {
  RegionCell cell;
  cell.center = leaf.center;
  cell.half_width = leaf.half_width;
  look_at(region, {}, cell);
  const Vec3& surface = cell.boundary_point;
  if (cell.distance() > 1e-6 * leaf.half_width) {
    const Vec3 beyond = 2 * surface - leaf.center;
    if (const auto place = just_inside(region, surface, beyond, leaf.half_width)) return place;
  }
  for (const RegionCell& half : halves(region, cell))
    if (half.center_inside)
      if (const auto place = just_inside(region, surface, half.center, leaf.half_width))
        return place;
  return std::nullopt;
}

/// What becomes of each leaf: a node, or none.
struct Nodes {
  std::vector<std::optional<Vec3>> of_leaves;
  Index count = 0;
};

std::vector<std::optional<Vec3>> all_nodes(const Region& region, const Octree& octree) {
  const std::vector<OctreeLeaf>& leaves = octree.leaves();
  std::vector<std::optional<Vec3>> nodes(leaves.size());
  parallel_chunks(static_cast<Index>(leaves.size()), leaves_a_chunk, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const LeafKind kind = leaves[at].kind;
      if (kind == LeafKind::exterior_boundary)
        nodes[at] = projected(region, leaves[at]);
      else if (kind != LeafKind::exterior)
        nodes[at] = leaves[at].center;
    }
  });
  return nodes;
}

/// Takes away projected nodes that come too close to another, with no gap between the two.
Nodes thinned(const Region& region, const Octree& octree, double least_distance) {
  const std::vector<OctreeLeaf>& leaves = octree.leaves();
  Nodes nodes{all_nodes(region, octree), 0};
  std::vector<std::size_t> owners;
  for (std::size_t i = 0; i < leaves.size(); ++i)
    if (nodes.of_leaves[i]) owners.push_back(i);
  if (owners.empty()) return nodes;
  // Nodes at centres come first: they stay.
  std::stable_partition(owners.begin(), owners.end(), [&](std::size_t i) {
    return leaves[i].kind != LeafKind::exterior_boundary;
  });
  Points places(static_cast<Index>(owners.size()), 3);
  for (std::size_t k = 0; k < owners.size(); ++k)
    places.row(static_cast<Index>(k)) = nodes.of_leaves[owners[k]]->transpose();
  const SiteTree tree(places);
  for (std::size_t k = 0; k < owners.size(); ++k) {
    const Vec3 x = places.row(static_cast<Index>(k));
    const double radius = least_distance * 2 * leaves[owners[k]].half_width;
    const std::vector<int> near = tree.within(x, radius);
    const bool crowded = std::any_of(near.begin(), near.end(), [&](int other) {
      const auto before = static_cast<std::size_t>(other);
      return before < k && nodes.of_leaves[owners[before]] &&
             region.connects(x, region.layers(x), places.row(other).transpose());
    });
    if (crowded)
      nodes.of_leaves[owners[k]].reset();
    else
      ++nodes.count;
  }
  return nodes;
}

/// The inside part of each leaf [m³].
std::vector<double> leaf_volumes(const Region& region, const std::vector<OctreeLeaf>& leaves) {
  std::vector<double> volumes(leaves.size());
  parallel_chunks(static_cast<Index>(leaves.size()), leaves_a_chunk, [&](Index begin, Index end) {
    std::vector<LeafPart> parts;
    for (Index i = begin; i < end; ++i) {
      const auto at = static_cast<std::size_t>(i);
      parts.clear();
      append_parts(region, leaves[at], volume_halvings, parts);
      for (const LeafPart& part : parts) volumes[at] += part.volume;
    }
  });
  return volumes;
}

Particles particles_at(const Region& region, const Octree& octree, const Nodes& nodes,
                       const OctreeParticleOptions& options) {
  if (nodes.count == 0)
    throw ShapeError("no inside found: the shape is thinner everywhere than can be sampled");
  const std::vector<OctreeLeaf>& leaves = octree.leaves();
  const std::vector<double> leaf_volume = leaf_volumes(region, leaves);
  Particles particles;
  particles.positions.resize(nodes.count, 3);
  particles.supports.resize(nodes.count);
  particles.volumes.setZero(nodes.count);
  Index row = 0;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (!nodes.of_leaves[i]) continue;
    particles.positions.row(row) = nodes.of_leaves[i]->transpose();
    particles.supports[row] = support_of(options, 2 * leaves[i].half_width);
    particles.volumes[row++] = leaf_volume[i];
  }
  const Neighbors<3> tree(particles.positions, particles.supports);
  for (std::size_t i = 0; i < leaves.size(); ++i)
    if (!nodes.of_leaves[i] && leaf_volume[i] > 0)
      particles.volumes[tree.nearest(leaves[i].center, 1).front()] += leaf_volume[i];
  // Of a leaf that the boundary only brushes nothing may be left.
  const double least = 1e-3 * region.volume() / static_cast<double>(nodes.count);
  particles.volumes = particles.volumes.cwiseMax(least);
  particles.volumes *= region.volume() / particles.volumes.sum();
  return particles;
}

Octree octree_of(const Region& region, double width) {
  OctreeOptions options;
  options.width = width;
  return {region, options};
}

/// The width at which the nodes' count comes nearest to the one that is asked for. The count jumps
/// where leaves slip out of a symmetric shape all at once: a bracket closes in on the best jump.
double width_for_count(const Region& region, const OctreeParticleOptions& options) {
  double width = std::cbrt(region.volume() / options.count), best = width;
  double too_narrow = 0, too_wide = std::numeric_limits<double>::infinity();
  Index least_miss = std::numeric_limits<Index>::max();
  for (int trial = 0; trial < most_trials; ++trial) {
    const Octree octree = octree_of(region, width);
    const Index count = thinned(region, octree, options.least_distance).count;
    const Index miss = std::abs(count - options.count);
    if (miss < least_miss) {
      least_miss = miss;
      best = width;
    }
    if (static_cast<double>(miss) <= count_tolerance * options.count) break;
    (count > options.count ? too_narrow : too_wide) = width;
    const double ratio = static_cast<double>(std::max<Index>(count, 1)) / options.count;
    width *= std::pow(ratio, 1 / usual_power);
    if (width <= too_narrow || width >= too_wide) width = 0.5 * (too_narrow + too_wide);
  }
  return best;
}

}  // namespace

Particles particles_in_leaves(const Region& region, const Octree& octree,
                              const OctreeParticleOptions& options) {
  const Nodes nodes = thinned(region, octree, options.least_distance);
  Particles particles = particles_at(region, octree, nodes, options);
  particles.spacing = octree.width();
  return particles;
}

Particles octree_particles(const Region& region, const OctreeParticleOptions& options) {
  check_particle_count(region, options.count, options.spacing);
  const double width = options.spacing > 0 ? options.spacing : width_for_count(region, options);
  return particles_in_leaves(region, octree_of(region, width), options);
}

}  // namespace supple
