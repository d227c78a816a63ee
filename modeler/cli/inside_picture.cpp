#include "modeler/cli/inside_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "io/picture/view.h"
#include "modeler/domain/octree.h"
#include "solver/core/parallel.h"

namespace supple {
namespace {

constexpr std::array<std::pair<Inside, std::string_view>, 4> inside_names{{
    {Inside::particles, "particles"},
    {Inside::supports, "supports"},
    {Inside::cells, "cells"},
    {Inside::slice, "slice"},
}};

constexpr double veil = 0.3;  // opacity of a surface that shows what is inside
constexpr double ball_over_spacing = 0.16;
constexpr Color particle_color{0.75f, 0.12f, 0.10f}, dot_color{0.62f, 0.54f, 0.46f};
constexpr Index most_dots = 3000;
constexpr double dot_radius = 0.0012;  // of the diagonal

/// From blue over white to red as `share` goes from 0 to 1.
Color blue_to_red(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  const Vec3 blue(0.13, 0.33, 0.74), middle(0.93, 0.90, 0.80), red(0.78, 0.13, 0.10);
  const Vec3 c =
      s < 0.5 ? Vec3(blue + 2 * s * (middle - blue)) : Vec3(middle + (2 * s - 1) * (red - middle));
  return {static_cast<float>(c.x()), static_cast<float>(c.y()), static_cast<float>(c.z())};
}

Markers particle_balls(const Solid& solid) {
  const Particles& particles = solid.particles();
  return {solid.restored(particles.positions), particle_color,
          ball_over_spacing * particles.spacing * solid.unit()};
}

/// The half of a box that lies towards the viewer along the axis that does so most.
HalfSpace nearer_half(const Box& box, const Camera& camera) {
  const Vec3 towards = camera_rotation(camera).row(2);
  int axis = 0;
  towards.cwiseAbs().maxCoeff(&axis);
  const Vec3 normal = towards[axis] < 0 ? Vec3(-Vec3::Unit(axis)) : Vec3(Vec3::Unit(axis));
  return {normal, normal.dot(box.center())};
}

/// A cloud's points as a few dots, so that what lies between them is seen.
Markers dots_of(const Points& points, const std::optional<HalfSpace>& left_out) {
  const Index step = 1 + points.rows() / most_dots;
  std::vector<Index> shown;
  for (Index i = 0; i < points.rows(); i += step)
    if (!left_out || left_out->normal.dot(points.row(i)) <= left_out->offset) shown.push_back(i);
  return {points(shown, Eigen::all), dot_color, dot_radius * bounding_box(points).diagonal()};
}

// ---- supports -------------------------------------------------------------------------------

constexpr int ring_parts = 72, most_rings = 6;

/// Circles about x that face the viewer.
void add_ring(const Vec3& x, double radius, const Mat3& rotation, const Color& color,
              Lines& rings) {
  const Index start = rings.ends.rows();
  rings.ends.conservativeResize(start + 2 * ring_parts, 3);
  for (int k = 0; k < 2 * ring_parts; ++k) {
    const double angle = 2 * std::numbers::pi * ((k + 1) / 2) / ring_parts;
    rings.ends.row(start + k) = x.transpose() + radius * (std::cos(angle) * rotation.row(0) +
                                                          std::sin(angle) * rotation.row(1));
  }
  rings.colors.insert(rings.colors.end(), ring_parts, color);
}

/// Numbers of at most `count` particles far from each other, the first that with the least support.
std::vector<Index> spread_particles(const Particles& particles, int count) {
  Index next = 0;
  particles.supports.minCoeff(&next);
  std::vector<Index> chosen;
  Eigen::VectorXd distances =
      Eigen::VectorXd::Constant(particles.size(), std::numeric_limits<double>::infinity());
  for (int k = 0; k < count && distances.maxCoeff() > 0; ++k) {
    if (k > 0) distances.maxCoeff(&next);
    chosen.push_back(next);
    distances = distances.cwiseMin(
        (particles.positions.rowwise() - particles.positions.row(next)).rowwise().norm());
  }
  return chosen;
}

void add_supports(Solid& solid, const ShapeSpec& spec, const Camera& camera, PictureItem& item) {
  solid.choose_particle_supports(spec);
  const Particles& particles = solid.particles();
  const double least = particles.supports.minCoeff(), most = particles.supports.maxCoeff();
  const auto color = [&](Index i) {
    return blue_to_red(most > least ? (particles.supports[i] - least) / (most - least) : 0);
  };
  Markers balls = particle_balls(solid);
  for (Index i = 0; i < particles.size(); ++i) balls.colors.push_back(color(i));
  item.markers.push_back(std::move(balls));
  Lines rings;
  for (const Index i : spread_particles(particles, most_rings))
    add_ring(solid.restored(particles.positions.row(i)).transpose(),
             particles.supports[i] * solid.unit(), camera_rotation(camera), color(i), rings);
  item.lines.push_back(std::move(rings));
  item.label += fmt::format(": support radii {:.3g} (blue) to {:.3g} (red)", least * solid.unit(),
                            most * solid.unit());
}

// ---- cells ----------------------------------------------------------------------------------

/// The twelve edges of a leaf, drawn in a little so that neighbours of two classes both show.
void add_cube(const OctreeLeaf& leaf, Lines& lines) {
  const double half_width = 0.97 * leaf.half_width;
  Index row = lines.ends.rows();
  lines.ends.conservativeResize(row + 24, 3);
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, 1, 2, 3}) {
      Vec3 corner = leaf.center;
      corner[(axis + 1) % 3] += (side & 1 ? 1 : -1) * half_width;
      corner[(axis + 2) % 3] += (side & 2 ? 1 : -1) * half_width;
      for (const int end : {-1, 1}) {
        corner[axis] = leaf.center[axis] + end * half_width;
        lines.ends.row(row++) = corner.transpose();
      }
    }
}

/// A class of leaves and how it is shown.
struct LeafClass {
  LeafKind kind;
  std::string_view name;
  Color color;
};
constexpr std::array<LeafClass, 3> leaf_classes{{
    {LeafKind::interior, "inside", {0.15f, 0.35f, 0.75f}},
    {LeafKind::interior_boundary, "at the boundary (middle inside)", {0.10f, 0.60f, 0.25f}},
    {LeafKind::exterior_boundary, "(middle outside)", {0.90f, 0.50f, 0.08f}},
}};

/// The octree's leaves whose middles lie beyond the plane through the region's middle.
void add_cells(const Solid& solid, const Camera& camera, PictureItem& item) {
  OctreeOptions options;
  options.width = solid.particles().spacing;
  const Octree octree(solid.region(), options);
  const HalfSpace nearer = nearer_half(solid.region().bounds(), camera);
  item.label += fmt::format(": cells of {:.3g}", options.width * solid.unit());
  for (const LeafClass& wanted : leaf_classes) {
    Lines lines{{}, wanted.color, 1.0};
    long count = 0;
    for (const OctreeLeaf& leaf : octree.leaves()) {
      if (leaf.kind != wanted.kind) continue;
      ++count;
      if (nearer.normal.dot(leaf.center) <= nearer.offset) add_cube(leaf, lines);
    }
    lines.ends = solid.restored(lines.ends);
    item.lines.push_back(std::move(lines));
    item.label += fmt::format(", {} {}", count, wanted.name);
  }
  item.label += "; the nearer half not shown";
}

// ---- slice ----------------------------------------------------------------------------------

constexpr int slice_cells = 480;       // along its longer side
constexpr double slice_margin = 0.04;  // of the box's diagonal
constexpr double band_width = 0.02;    // of the box's diagonal
constexpr double dark_band = 0.88;     // brightness of every other one

/// Blue inside, amber outside, in bands of equal distance that pale away from the boundary.
Color distance_color(double distance) {
  const Vec3 inside(0.16, 0.42, 0.78), outside(0.93, 0.70, 0.42), pale(0.97, 0.97, 0.96);
  const double fade = std::min(1.0, std::abs(distance) / (distance < 0 ? 0.35 : 0.15));
  const bool dark = static_cast<long>(std::floor(distance / band_width)) % 2 != 0;
  const Vec3 c = ((1 - 0.75 * fade) * (distance < 0 ? inside : outside) + 0.75 * fade * pale) *
                 (dark ? dark_band : 1);
  return {static_cast<float>(c.x()), static_cast<float>(c.y()), static_cast<float>(c.z())};
}

/// Signed distances of the plane through the middle of the region's box across `axis`, our
/// coordinates.
Sheet distance_sheet(const Region& region, int axis) {
  const Box box = region.bounds();
  const Vec3 margin = Vec3::Constant(slice_margin * box.diagonal());
  const Vec3 lower = box.lower - margin, size = box.size() + 2 * margin;
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double cell = std::max(size[u], size[v]) / slice_cells;
  const Index columns = static_cast<Index>(std::ceil(size[u] / cell)) + 1;
  const Index rows = static_cast<Index>(std::ceil(size[v] / cell)) + 1;
  Sheet sheet{Points(rows * columns, 3), Triangles(2 * (rows - 1) * (columns - 1), 3),
              std::vector<Color>(static_cast<std::size_t>(rows * columns))};
  parallel_chunks(rows * columns, 512, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      Vec3 x = box.center();
      x[u] = lower[u] + cell * static_cast<double>(i % columns);
      x[v] = lower[v] + cell * static_cast<double>(i / columns);
      sheet.positions.row(i) = x.transpose();
      sheet.colors[static_cast<std::size_t>(i)] =
          distance_color(region.signed_distance(x) / box.diagonal());
    }
  });
  Index t = 0;
  for (Index row = 0; row + 1 < rows; ++row)
    for (Index column = 0; column + 1 < columns; ++column) {
      const int a = static_cast<int>(row * columns + column), c = a + static_cast<int>(columns);
      sheet.triangles.row(t++) << a, a + 1, c + 1;
      sheet.triangles.row(t++) << a, c + 1, c;
    }
  return sheet;
}

void add_slice(const Solid& solid, const Camera& camera, PictureItem& item) {
  const Box box{solid.restored(solid.region().bounds().lower.transpose()).transpose(),
                solid.restored(solid.region().bounds().upper.transpose()).transpose()};
  item.cut = nearer_half(box, camera);
  int axis = 0;
  item.cut->normal.cwiseAbs().maxCoeff(&axis);
  Sheet sheet = distance_sheet(solid.region(), axis);
  sheet.positions = solid.restored(sheet.positions);
  item.sheets.push_back(std::move(sheet));
  item.label += fmt::format(": distance to the surface at {} = {:.4g}, bands of {:.3g}",
                            "xyz"[axis], box.center()[axis], band_width * box.diagonal());
}

}  // namespace

EnumNames<Inside> enum_names(Inside) {
  return inside_names;
}

void show_inside(Inside inside, Solid& solid, const ShapeSpec& spec, const Camera& camera,
                 PictureItem& item) {
  if (inside != Inside::slice) item.opacity = veil;
  switch (inside) {
    case Inside::particles:
      item.label += fmt::format(": {} particles", solid.particles().size());
      item.markers.push_back(particle_balls(solid));
      break;
    case Inside::supports:
      add_supports(solid, spec, camera, item);
      break;
    case Inside::cells:
      add_cells(solid, camera, item);
      break;
    case Inside::slice:
      add_slice(solid, camera, item);
      break;
  }
  if (item.mesh->face_count() > 0) return;
  item.markers.push_back(dots_of(item.mesh->positions, item.cut));
  item.mesh = nullptr;
}

}  // namespace supple
