#include "modeler/pose/solid.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

#include "modeler/domain/closed_region.h"
#include "modeler/domain/octree_particles.h"
#include "modeler/domain/sample_particles.h"
#include "modeler/domain/shape_error.h"
#include "solver/field/supports.h"

namespace supple {
namespace {

constexpr int default_particles = 200;

/// What the quadrature points on the surface take of the volume of the particle nearest to them.
/// Enough to hold the surface; so little that the sum stays centred in the particle's cell: the
/// volume change of a twisted bar then depends on the number of particles by 0.1 %, not by 3 %.
constexpr double surface_share = 0.15;

/// Surface samples are no wider than this share of the particles' spacing.
constexpr double sample_width_over_spacing = 0.5;

std::vector<bool> vertices_of_faces(const Mesh& mesh) {
  std::vector<bool> used(static_cast<std::size_t>(mesh.positions.rows()), false);
  for (const int vertex : mesh.face_vertices) used[static_cast<std::size_t>(vertex)] = true;
  return used;
}

/// Of the vertices that faces use: others would distort every percent and every weight.
Box box_of_faces(const Mesh& mesh) {
  Box box;
  for (const int vertex : mesh.face_vertices) box.extend(mesh.positions.row(vertex).transpose());
  return box;
}

ParticleSamplingOptions sampling_options(const ShapeSpec& spec, double diagonal, double unit) {
  ParticleSamplingOptions options;
  options.count = spec.particles.value_or(default_particles);
  if (spec.spacing) options.spacing = resolve(*spec.spacing, diagonal) / unit;
  return options;
}

Particles place_particles(const Region& region, const ShapeSpec& spec, double diagonal,
                          double unit) {
  const ParticleSamplingOptions even = sampling_options(spec, diagonal, unit);
  if (spec.placement == PlacementKind::even) return sample_particles(region, even).particles;
  OctreeParticleOptions options;
  options.count = even.count;
  options.spacing = even.spacing;
  options.kernel = spec.kernel;
  return octree_particles(region, options);
}

/// How many particles a support would reach if they stood `spacing` apart.
double neighbors_within(double support, double spacing) {
  return 4 * std::numbers::pi / 3 * std::pow(support / spacing, 3);
}

Quadrature with_particles_first(const Particles& particles, const Quadrature& others) {
  Quadrature all;
  all.points.resize(particles.size() + others.points.rows(), 3);
  all.points << particles.positions, others.points;
  all.volumes.setZero(all.points.rows());
  all.volumes.tail(others.volumes.size()) =
      others.volumes * (particles.volumes.sum() / others.volumes.sum());
  return all;
}

}  // namespace

Mesh sized(const Mesh& mesh, const ShapeSpec& spec) {
  if (!spec.size) return mesh;
  const Box box = box_of_faces(mesh);
  const double scale = resolve(*spec.size, box.diagonal()) / box.diagonal();
  Mesh sized = mesh;
  sized.positions = (mesh.positions.rowwise() - box.center().transpose()) * scale;
  return sized;
}

Solid::Solid(const Mesh& mesh, const ShapeSpec& spec)
    : triangulation_(triangulate(mesh)),
      used_(vertices_of_faces(mesh)),
      box_(box_of_faces(mesh)),
      origin_(box_.center().transpose()),
      unit_(box_.diagonal()) {
  if (triangulation_.triangles.rows() == 0)
    throw ShapeError(
        "the shape has no faces, so it encloses no solid; point clouds cannot be posed yet");
  if (!(unit_ > 0)) throw ShapeError("all vertices of the shape lie at one place");
  if (!std::isfinite(unit_)) throw ShapeError("the shape is too large to compute with");
  vertices_ = scaled(mesh.positions);
  sample(spec);
  surface_ = sample_surface(vertices_, triangulation_.triangles,
                            sample_width_over_spacing * particles_.spacing);
}

void Solid::sample(const ShapeSpec& spec) {
  auto region = std::make_unique<const ClosedRegion>(vertices_, triangulation_.triangles);
  const SurfaceDefects& defects = region->defects();
  if (defects.inside_out)
    notes_.push_back("the faces point inwards; read as if they pointed outwards");
  if (defects.degenerate_faces > 0)
    notes_.push_back(
        fmt::format("{} faces without area do not bound the solid", defects.degenerate_faces));
  const long unused = std::count(used_.begin(), used_.end(), false);
  if (unused > 0)
    notes_.push_back(fmt::format("{} vertices that no face uses follow the solid", unused));
  region_ = std::move(region);
  particles_ = place_particles(*region_, spec, unit_, unit_);
}

Points Solid::spread_over_surface(double width) const {
  std::vector<int> all(static_cast<std::size_t>(surface_.size()));
  std::iota(all.begin(), all.end(), 0);
  const ThinnedSamples thinned = thin_samples(surface_, all, width);
  Points points(static_cast<Index>(thinned.indices.size()), 3);
  for (Index k = 0; k < points.rows(); ++k)
    points.row(k) = surface_.positions.row(thinned.indices[static_cast<std::size_t>(k)]);
  return points;
}

double Solid::choose_particle_supports(KernelKind kernel) {
  const Points spread = spread_over_surface(sample_width_over_spacing * particles_.spacing);
  const long used = std::count(used_.begin(), used_.end(), true);
  Points cover(particles_.size() + used + spread.rows(), 3);
  cover.topRows(particles_.size()) = particles_.positions;
  cover.bottomRows(spread.rows()) = spread;
  Index row = particles_.size();
  for (std::size_t i = 0; i < used_.size(); ++i)
    if (used_[i]) cover.row(row++) = vertices_.row(static_cast<Index>(i));

  SupportOptions options;
  // Those of an octree's particles follow from its leaves.
  if (particles_.supports.size() > 0)
    options.neighbors = neighbors_within(particles_.supports.minCoeff(), particles_.spacing);
  Supports supports =
      choose_supports(particles_.positions, particles_.spacing, cover, kernel, options);
  particles_.supports = std::move(supports.radii);
  return static_cast<double>(supports.thin) / static_cast<double>(cover.rows());
}

Quadrature Solid::quadrature(QuadratureKind kind) const {
  Quadrature quadrature{particles_.positions, particles_.volumes};
  if (kind == QuadratureKind::particles) return quadrature;
  if (kind == QuadratureKind::cells) {
    OctreeOptions cells;
    cells.width = particles_.spacing;
    return with_particles_first(particles_, cell_quadrature(*region_, {*region_, cells}));
  }
  const Points surface = spread_over_surface(particles_.spacing);
  const Neighbors<3> tree(particles_.positions, particles_.supports);
  std::vector<int> owners;
  Eigen::VectorXd owned = Eigen::VectorXd::Zero(particles_.size());
  for (Index k = 0; k < surface.rows(); ++k) {
    owners.push_back(tree.nearest(surface.row(k).transpose(), 1).front());
    owned[owners.back()] += 1;
  }
  quadrature.points.conservativeResize(particles_.size() + surface.rows(), 3);
  quadrature.points.bottomRows(surface.rows()) = surface;
  quadrature.volumes.conservativeResize(quadrature.points.rows());
  for (Index k = 0; k < surface.rows(); ++k) {
    const int owner = owners[static_cast<std::size_t>(k)];
    quadrature.volumes[particles_.size() + k] =
        surface_share * particles_.volumes[owner] / owned[owner];
  }
  for (Index i = 0; i < particles_.size(); ++i)
    if (owned[i] > 0) quadrature.volumes[i] *= 1 - surface_share;
  return quadrature;
}

}  // namespace supple
