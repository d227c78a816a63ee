#include "modeler/pose/solid.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

#include "modeler/domain/beneath_surface.h"
#include "modeler/domain/inside_cover.h"
#include "modeler/domain/inside_detours.h"
#include "modeler/domain/make_region.h"
#include "modeler/domain/octree_particles.h"
#include "modeler/domain/point_cleaning.h"
#include "modeler/domain/sample_particles.h"
#include "modeler/domain/shape_error.h"
#include "solver/core/stopwatch.h"

namespace supple {
namespace {

/// What the quadrature points on the surface take of the volume of the particle nearest to them.
/// Enough to hold the surface; so little that the sum stays centred in the particle's cell: the
/// volume change of a twisted bar then depends on the number of particles by 0.1 %, not by 3 %.
constexpr double surface_share = 0.15;

/// Surface samples are no wider than this share of the particles' spacing.
constexpr double sample_width_over_spacing = 0.5;

/// Vertices that lie closer than this share of the spacing feel the same particles.
constexpr double vertex_width_over_spacing = 0.125;

/// How far inside a surface points are taken where gaps may have no width, of the diagonal: little
/// enough to be rounding, and well above that of the segments that part the walls.
constexpr double beneath = 1e-10;

/// Adds the time that it lives.
class AddedTime {
 public:
  explicit AddedTime(double& seconds) : seconds_(seconds) {}
  ~AddedTime() { seconds_ += watch_.seconds(); }
  AddedTime(const AddedTime&) = delete;
  AddedTime& operator=(const AddedTime&) = delete;

 private:
  double& seconds_;
  Stopwatch watch_;
};

/// Those that faces use; in a cloud all but outliers, which must not tell how large it is.
std::vector<bool> vertices_of_surface(const Mesh& mesh) {
  std::vector<bool> used(static_cast<std::size_t>(mesh.positions.rows()), false);
  const std::vector<int> vertices =
      mesh.face_count() > 0 ? mesh.face_vertices : clean_points(mesh.positions).kept;
  for (const int vertex : vertices) used[static_cast<std::size_t>(vertex)] = true;
  return used;
}

/// Of the used vertices: others would distort every percent and every weight.
Box box_of(const Mesh& mesh, const std::vector<bool>& used) {
  Box box;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) box.extend(mesh.positions.row(static_cast<Index>(i)).transpose());
  return box;
}

/// `diagonal` of the shape in the user's coordinates; 1 in ours.
ParticleSamplingOptions sampling_options(const ShapeSpec& spec, double diagonal) {
  ParticleSamplingOptions options;
  options.count = spec.particles.value_or(ShapeSpec::usual_particles);
  if (spec.spacing) options.spacing = resolve(*spec.spacing, diagonal) / diagonal;
  return options;
}

/// Particles and the samples of the volume that they share, as the spec wants them placed.
ParticleSampling place_particles(const Region& region, const ShapeSpec& spec, double diagonal) {
  const ParticleSamplingOptions even = sampling_options(spec, diagonal);
  if (spec.placement == PlacementKind::even) return sample_particles(region, even);
  OctreeParticleOptions options;
  options.count = even.count;
  options.spacing = even.spacing;
  options.kernel = spec.kernel;
  ParticleSampling sampling;
  sampling.particles = octree_particles(region, options);
  VolumeSampleOptions samples;
  samples.width = sampling.particles.spacing / std::cbrt(even.candidates);
  samples.enough = even.candidates * sampling.particles.size();
  sampling.samples = sample_volume(region, samples);
  return sampling;
}

/// How many particles a support would reach if they stood `spacing` apart.
double neighbors_within(double support, double spacing) {
  return 4 * std::numbers::pi / 3 * std::pow(support / spacing, 3);
}

/// What supports reach by ways inside changes with them.
void scale_supports(double scale, const DetoursWithin& detours_within, Supports& supports) {
  supports.radii *= scale;
  if (detours_within) supports.detours = detours_within(supports.radii, supports.radii.maxCoeff());
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
  const Box box = box_of(mesh, vertices_of_surface(mesh));
  const double scale = resolve(*spec.size, box.diagonal()) / box.diagonal();
  Mesh sized = mesh;
  sized.positions = (mesh.positions.rowwise() - box.center().transpose()) * scale;
  sized.radii = mesh.radii * scale;
  return sized;
}

Solid::Solid(const Mesh& mesh, const ShapeSpec& spec)
    : triangulation_(triangulate(mesh)),
      used_(vertices_of_surface(mesh)),
      box_(box_of(mesh, used_)),
      origin_(box_.center().transpose()),
      unit_(box_.diagonal()) {
  if (!(unit_ > 0)) throw ShapeError("zero volume: all vertices of the shape lie at one place");
  if (!std::isfinite(unit_)) throw ShapeError("the shape is too large to compute with");
  vertices_ = scaled(mesh.positions);
  sample(mesh, spec);
  find_surface();
}

void Solid::find_surface() {
  const Triangles& triangles = triangulation_.triangles;
  surface_ =
      cloud_ ? cloud_samples(vertices_, *cloud_)
             : sample_surface(vertices_, triangles, sample_width_over_spacing * particles_.spacing);
  inner_vertices_ = vertices_;
  if (!graph_ || !graph_->parted()) return;
  if (cloud_) {
    inner_vertices_ = points_beneath(vertices_, *cloud_, beneath);
    surface_.positions = cloud_samples(inner_vertices_, *cloud_).positions;
  } else {
    inner_vertices_ = vertices_beneath(vertices_, triangles, beneath);
    surface_.positions = samples_beneath(surface_, vertices_, triangles, beneath);
  }
}

void Solid::keep(const CloudSurface& cloud, const Mesh& mesh) {
  used_.assign(used_.size(), false);
  for (const int point : cloud.points) used_[static_cast<std::size_t>(point)] = true;
  box_ = box_of(mesh, used_);
  cloud_ = cloud;
}

void Solid::sample(const Mesh& mesh, const ShapeSpec& spec) {
  SolidRegion solid = make_region(mesh, vertices_, triangulation_.triangles);
  notes_ = std::move(solid.notes);
  reasons_ = std::move(solid.reasons);
  if (solid.cloud) keep(*solid.cloud, mesh);
  const long unused = std::count(used_.begin(), used_.end(), false);
  if (unused > 0 && !cloud_)
    notes_.push_back(fmt::format("{} vertices that no face uses follow the solid", unused));
  region_ = std::move(solid.region);
  boundary_ = std::move(solid.boundary);
  ParticleSampling sampling = place_particles(*region_, spec, unit_);
  particles_ = std::move(sampling.particles);
  particles_placed_ = particles_.size();
  if (spec.coupling == CouplingKind::inside) couple_inside(sampling.samples);
  for (std::string& note : solid.empty_parts(particles_.positions))
    notes_.push_back(std::move(note));
}

void Solid::couple_inside(const VolumeSamples& samples) {
  const AddedTime coupling(coupling_seconds_);
  graph_ = std::make_shared<const InsideGraph>(*region_, samples);
  const InsideCover cover = cover_inside(*graph_, particles_);
  if (cover.added > 0)
    notes_.push_back(fmt::format(
        "{} particles were added in parts that no other reaches by the way inside", cover.added));
}

Points Solid::spread_over_surface(double width) const {
  std::vector<int> all(static_cast<std::size_t>(surface_.size()));
  std::iota(all.begin(), all.end(), 0);
  return surface_.positions(thin_samples(surface_, all, width).indices, Eigen::all);
}

Points Solid::spread_vertices(double width) const {
  std::vector<int> used;
  for (std::size_t i = 0; i < used_.size(); ++i)
    if (used_[i]) used.push_back(static_cast<int>(i));
  const SurfaceSamples vertices =
      point_samples(inner_vertices_, Eigen::VectorXd::Ones(inner_vertices_.rows()));
  return inner_vertices_(thin_samples(vertices, used, width).indices, Eigen::all);
}

double Solid::choose_particle_supports(const ShapeSpec& spec) {
  const Points spread = spread_over_surface(sample_width_over_spacing * particles_.spacing);
  const Points vertices = spread_vertices(vertex_width_over_spacing * particles_.spacing);
  Points cover(particles_.size() + spread.rows() + vertices.rows(), 3);
  cover << particles_.positions, spread, vertices;

  SupportOptions options;
  options.kind = spec.supports;
  // Those of an octree's particles follow from its leaves.
  if (particles_.supports.size() > 0)
    options.neighbors = neighbors_within(particles_.supports.minCoeff(), particles_.spacing);
  const DetoursWithin detours_within = detours_within_supports();
  Supports supports = choose_supports(particles_.positions, particles_.spacing, cover, spec.kernel,
                                      options, detours_within);
  if (spec.support_scale != 1) scale_supports(spec.support_scale, detours_within, supports);
  particles_.supports = std::move(supports.radii);
  particles_.stretches = std::move(supports.stretches);
  detours_ = std::move(supports.detours);
  return static_cast<double>(supports.thin) / static_cast<double>(cover.rows());
}

DetoursWithin Solid::detours_within_supports() {
  if (!graph_) return {};
  const auto finder =
      std::make_shared<InsideDetours>(graph_, particles_.positions, particles_.spacing);
  return [this, finder](const Eigen::VectorXd& supports, double widest) {
    const AddedTime coupling(coupling_seconds_);
    return finder->within(supports, widest);
  };
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
