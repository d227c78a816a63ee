#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "modeler/domain/make_region.h"
#include "modeler/domain/mesh_region.h"
#include "modeler/domain/sample_particles.h"
#include "modeler/domain/shape_error.h"
#include "solver/core/random.h"
#include "tests/cases/cases.h"
#include "tests/cases/posed_bar.h"
#include "tests/support/region_shapes.h"

namespace supple {
namespace {

/// Points that are in one region alone, over those in the first, in percent.
double inside_difference(const Region& region, const Region& other) {
  const Box box = region.bounds();
  Random random(17);
  int inside = 0, different = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 x = box.lower + random.in_cube(0, 1).cwiseProduct(box.size());
    const bool in = region.contains(x);
    if (in) ++inside;
    if (in != other.contains(x)) ++different;
  }
  return 100.0 * different / inside;
}

double percent_off(double value, double expected) {
  return 100 * std::abs(value / expected - 1);
}

void measure_holes(Figures& figures) {
  const auto compare = [&](const std::string& name, const Mesh& closed, const Mesh& holed) {
    const MeshRegion whole = region_of(closed), region = region_of(holed);
    figures[name + "_inside_percent"] = inside_difference(whole, region);
    figures[name + "_volume_percent"] = percent_off(region.volume(), whole.volume());
  };
  Random random(4);
  const auto one_in_twenty = [&](const Vec3&) { return random.uniform() < 0.05; };
  const Mesh torus = make_torus(1, 0.4, 64, 32), ball = make_icosphere(1, 4);
  compare("random_faces", torus, without(torus, one_in_twenty));
  compare("one_hole", ball, without(ball, [](const Vec3& x) { return x.z() > 0.9; }));
}

void measure_inversions(Figures& figures) {
  const auto particles = [](const SolidRegion& solid) {
    ParticleSamplingOptions options;
    options.spacing = 0.3;
    return static_cast<double>(sample_particles(*solid.region, options).particles.size());
  };
  const auto solid_of = [](const Mesh& mesh) {
    return make_region(mesh, mesh.positions, triangles_of(mesh));
  };
  const Mesh shape = make_torus(1, 0.4, 48, 24);
  const double expected = particles(solid_of(shape));
  const auto compare = [&](const std::string& name, const Mesh& mesh) {
    const SolidRegion solid = solid_of(mesh);
    figures[name + "_particles_percent"] = percent_off(particles(solid), expected);
    figures[name + "_notes"] = static_cast<double>(solid.notes.size());
  };
  compare("all", turned(shape));
  compare("half", turned_at_random(shape, 0.5, 9));
  const Mesh open = without(shape, [](const Vec3& x) { return x.x() > 1.3; });
  figures["all_open_volume_percent"] =
      percent_off(region_of(turned(open)).volume(), region_of(open).volume());
}

void measure_soups(Figures& figures) {
  const Mesh box = make_bar({1, 1, 1}, {1, 1, 1});
  const auto moved = [&](const Vec3& by) {
    return mapped(box, [by](const Vec3& x) -> Vec3 { return x + by; });
  };
  const auto off = [](const Mesh& mesh, double volume) {
    return percent_off(region_of(mesh).volume(), volume);
  };
  const auto top = [](const Vec3& x) { return x.z() > 0.99; };
  const auto all_but_top = [](const Vec3& x) { return x.z() < 0.99; };
  const Mesh lid = without(make_bar({1, 1, 1}, {4, 4, 4}), all_but_top);
  figures["shared_edge_percent"] = off(joined(box, moved({1, 1, 0})), 2);
  figures["shared_vertex_percent"] = off(joined(box, moved({1, 1, 1})), 2);
  figures["shared_face_percent"] = off(joined(box, moved({1, 0, 0})), 2);
  figures["overlap_percent"] = off(joined(box, moved({0.47, 0.23, 0.31})), 2 - 0.53 * 0.77 * 0.69);
  figures["t_junctions_percent"] = off(joined(without(box, top), lid), 1);
  figures["duplicate_faces_percent"] = off(joined(box, without(box, all_but_top)), 1);
  figures["turned_duplicates_percent"] = off(joined(box, turned(without(box, all_but_top))), 1);
  figures["doubled_percent"] = off(joined(box, box), 1);
}

/// A strip of 64 × 4 quads turned by half a turn and joined.
Mesh make_moebius_strip() {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> faces;
  constexpr int around = 64, across = 4;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j <= across; ++j) {
      const double angle = 2 * std::numbers::pi * i / around;
      const double width = 0.6 * (static_cast<double>(j) / across - 0.5);
      const double radius = 1 + width * std::cos(angle / 2);
      points.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                          width * std::sin(angle / 2));
    }
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const auto vertex = [&](int di, int dj) {
        const bool over = i + di == around;
        return (over ? 0 : i + di) * (across + 1) + (over ? across - j - dj : j + dj);
      };
      faces.push_back({vertex(0, 0), vertex(1, 0), vertex(1, 1)});
      faces.push_back({vertex(0, 0), vertex(1, 1), vertex(0, 1)});
    }
  return make_mesh(points, faces);
}

/// 1 where a pose of the shape is refused with these words.
double refused(const Mesh& mesh, const std::string& words) {
  try {
    pose_with(mesh, "    - fix: z<10%\n");
  } catch (const ShapeError& error) {
    return std::string(error.what()).find(words) != std::string::npos ? 1 : 0;
  }
  return 0;
}

void measure_open_surfaces(Figures& figures) {
  const Mesh sheet =
      without(make_bar({1, 1, 1}, {16, 16, 1}), [](const Vec3& x) { return x.z() < 0.99; });
  const auto bumpy = [](const Vec3& x) -> Vec3 {
    return {x.x(), x.y(), 0.1 * std::sin(7 * x.x()) * std::sin(9 * x.y())};
  };
  figures["hemisphere_refused"] = refused(
      without(make_icosphere(1, 4), [](const Vec3& x) { return x.z() > 0; }), "open surface");
  figures["flat_sheet_refused"] = refused(sheet, "open surface");
  figures["bumpy_sheet_refused"] = refused(mapped(sheet, bumpy), "open surface");
  figures["moebius_strip_refused"] = refused(make_moebius_strip(), "open surface");
}

void measure_no_volume(Figures& figures) {
  const std::vector<Vec3> quad = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const Mesh doubled = make_mesh(quad, {{0, 1, 2}, {0, 2, 3}, {2, 1, 0}, {3, 2, 0}});
  figures["doubled_quad_refused"] = refused(doubled, "zero volume");
  figures["one_triangle_refused"] = refused(make_mesh(quad, {{0, 1, 2}}), "zero volume");
  figures["one_place_refused"] = refused(mapped(doubled,
                                                [](const Vec3&) -> Vec3 {
                                                  return {1, 1, 1};
                                                }),
                                         "zero volume");
}

/// `mesh` with triangles that repeat a vertex, have no area, or are 1e8 times as long as high.
Mesh with_degenerate_faces(const Mesh& mesh, int of_each) {
  Mesh extra;
  std::vector<Vec3> points;
  std::vector<std::vector<int>> faces;
  for (int i = 0; i < of_each; ++i) {
    const int* corner = &mesh.face_vertices[static_cast<std::size_t>(3 * i)];
    const Vec3 a = mesh.positions.row(corner[0]), b = mesh.positions.row(corner[1]);
    const int first = static_cast<int>(points.size());
    points.insert(points.end(), {a, b, 0.25 * a + 0.75 * b});
    points.push_back(points.back() + 1e-8 * (b - a).norm() * Vec3(0.6, 0.48, 0.64));
    faces.push_back({first, first, first + 1});
    faces.push_back({first, first + 1, first + 2});
    faces.push_back({first, first + 1, first + 3});
  }
  return joined(mesh, make_mesh(points, faces));
}

void measure_degenerate_faces(Figures& figures) {
  const Mesh clean = make_torus(1, 0.4, 48, 24);
  const int of_each = 50;
  const MeshRegion expected = region_of(clean);
  const MeshRegion region = region_of(with_degenerate_faces(clean, of_each));
  figures["counted_share"] = region.defects().degenerate_faces / (3.0 * of_each);
  figures["volume_change"] = std::abs(region.volume() / expected.volume() - 1);
  ParticleSamplingOptions options;
  options.count = 60;
  const Points a = sample_particles(expected, options).particles.positions;
  const Points b = sample_particles(region, options).particles.positions;
  figures["particles_moved"] =
      a.rows() == b.rows() ? greatest_distance(a, b) / expected.bounds().diagonal() : 1;
}

void measure_parts(Figures& figures) {
  const Mesh ball = make_icosphere(1, 3);
  Mesh mesh = joined(ball, mapped(ball, [](const Vec3& x) -> Vec3 { return x + Vec3(3, 0, 0); }));
  const Mesh crumb = make_icosphere(0.005, 0);
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 at = 1.1 * random.in_cube(-1, 1).normalized();
    mesh = joined(mesh, mapped(crumb, [&](const Vec3& x) -> Vec3 { return x + at; }));
  }
  const SolidRegion solid = make_region(mesh, mesh.positions, triangles_of(mesh));
  const Points particles = sample_particles(*solid.region, {}).particles.positions;
  const MeshRegion region = region_of(mesh);
  long empty_bodies = 0, empty = 0;
  for (const MeshPart& part : region.parts(particles)) {
    if (part.particles > 0) continue;
    ++empty;
    if (part.volume_share > 0.1) ++empty_bodies;
  }
  const std::vector<std::string> notes = solid.empty_parts(particles);
  const std::string listed = fmt::format("{} of 1002 parts", empty);
  figures["bodies_without_particles"] = static_cast<double>(empty_bodies);
  figures["crumbs_listed"] = !notes.empty() && notes[0].rfind(listed, 0) == 0 ? 1 : 0;

  const MeshRegion hollow = region_of(joined(ball, turned(make_icosphere(0.5, 3))));
  const Particles shell = sample_particles(hollow, {}).particles;
  figures["particles_in_the_cavity"] =
      static_cast<double>((shell.positions.rowwise().norm().array() < 0.49).count());
  figures["hollow_volume_percent"] =
      percent_off(shell.volumes.sum(), 4 * std::numbers::pi / 3 * (1 - 0.125));
}

constexpr Case cases[] = {
    {"B4", measure_holes},         {"B5", measure_inversions}, {"B6", measure_soups},
    {"B7", measure_open_surfaces}, {"B8", measure_no_volume},  {"B9", measure_degenerate_faces},
    {"B10", measure_parts},
};

}  // namespace

std::span<const Case> geometry_cases() {
  return cases;
}

}  // namespace supple
