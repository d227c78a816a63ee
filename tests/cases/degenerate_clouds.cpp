#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "solver/energy/energy_sum.h"
#include "solver/energy/rigidity.h"
#include "solver/energy/volume.h"
#include "solver/field/hash_grid.h"
#include "solver/field/merge_coincident.h"
#include "solver/field/pieces.h"
#include "solver/field/samples.h"
#include "solver/field/supports.h"
#include "tests/cases/cases.h"
#include "tests/cases/clouds.h"
#include "tests/cases/posed_bar.h"
#include "tests/support/all_of.h"
#include "tests/support/lattice.h"

namespace supple {
namespace {

Points together(const Points& a, const Points& b) {
  Points both(a.rows() + b.rows(), 3);
  both << a, b;
  return both;
}

Points random_directions(Index count, std::uint64_t seed) {
  Random random(seed);
  Points directions(count, 3);
  for (Index i = 0; i < count; ++i) {
    Vec3 direction;
    do direction = random.in_cube(-1, 1);
    while (direction.norm() > 1 || direction.norm() < 0.1);
    directions.row(i) = direction.normalized().transpose();
  }
  return directions;
}

Eigen::RowVector3d linear_moment(const ShapeAtPoint& shape, const Field& field, const Vec3& x) {
  return shape.rows.col(0).transpose() * (field.positions().rowwise() - x.transpose());
}

/// A bar with handles and a piece without, more than 5 supports away: notes of the report on it.
double loose_piece_notes() {
  Mesh bars = case_bar();
  const Mesh crumb = make_bar({1, 1, 2}, {4, 4, 8});
  const int first = static_cast<int>(bars.positions.rows());
  bars.positions =
      together(bars.positions, crumb.positions.rowwise() + Eigen::RowVector3d(8, 0, 1));
  for (const int vertex : crumb.face_vertices) bars.face_vertices.push_back(first + vertex);
  const auto end = bars.face_starts.back();
  for (std::size_t f = 1; f < crumb.face_starts.size(); ++f)
    bars.face_starts.push_back(end + crumb.face_starts[f]);
  const PoseResult result =
      pose_with(bars, "    - fix: z<10%\n    - {move: 'z>90%', by: [5%, 0, 0]}\n");
  return static_cast<double>(std::count_if(
      result.report.notes.begin(), result.report.notes.end(), [](const std::string& note) {
        return note.find("pieces without handles") != std::string::npos;
      }));
}

/// A body and a particle 5 supports away from it.
void measure_isolated_particle(Figures& figures) {
  constexpr double h = 0.5;
  const Particles body = lattice_particles({1, 1, 1}, 1.0 / 6);
  const Index lone = body.size();
  const Points positions =
      together(body.positions, Points(Eigen::RowVector3d(1 + 5 * h, 0.5, 0.5)));
  const Field field = Cloud{positions, h}.field({});
  const Samples samples = sample_field(field, positions, SampleContent::values_and_gradients);
  Pieces pieces(positions.rows());
  pieces.tie(samples);
  const std::vector<int> numbers = pieces.numbers();
  figures["pieces"] = 1 + *std::max_element(numbers.begin(), numbers.end());
  figures["counted"] = static_cast<double>(samples.rank_lost);
  figures["covers_itself"] =
      std::abs(ShapeAtPoint(field, positions.row(lone).transpose()).rows(lone, 0) - 1);

  const RigidityEnergy rigidity;
  const VolumeEnergy volume;
  EnergySum energy(positions.rows());
  const Eigen::VectorXd weights = Eigen::VectorXd::Ones(positions.rows());
  energy.add(rigidity, samples, weights, 1);
  energy.add(volume, samples, weights, 1);
  Points u = Points::Zero(positions.rows(), 3), gradient;
  u.row(lone) << 3, -4, 5;
  figures["energy_of_its_way"] = energy.evaluate(u);
  u.topRows(lone) = 0.1 * body.positions.cwiseAbs2();
  energy.evaluate(u, &gradient);
  figures["force_on_it"] = gradient.row(lone).norm() / gradient.norm();
  figures["notes"] = loose_piece_notes();
}

/// 60 particles in one place but for 1e-12, and a body of which every particle is there twice.
void measure_coincident_particles(Figures& figures) {
  for (const BasisOrder order : all_of<BasisOrder>())
    for (const KernelKind kernel : all_of<KernelKind>()) {
      const Field field = Cloud{1e-12 * random_points(60, 3, 1), 1}.field({order, kernel});
      for (const double size : {1e-12, 1e-3, 0.5})
        for (int k = 0; k < 20; ++k) {
          const ShapeAtPoint shape(field, size * random_points(20, 3, 2).row(k).transpose());
          keep_worst(figures["partition_of_unity"], shape.unity_error());
          figures["not_finite"] += shape.not_finite();
        }
    }

  const Particles body = lattice_particles({1, 1, 1}, 1.0 / 6);
  const Index n = body.size();
  const Points twice = together(body.positions, body.positions);
  Eigen::VectorXd volumes(2 * n);
  volumes << body.volumes, body.volumes;
  const MergedParticles merged = merge_coincident(twice, volumes, 1e-9);
  figures["merged_too_many"] = static_cast<double>(merged.positions.rows() - n);
  if (merged.positions.rows() != n) return;
  figures["merged_mass"] =
      (merged.volumes - 2 * body.volumes).cwiseAbs().maxCoeff() / body.volumes[0];
  const Field single = Cloud{body.positions, 0.5}.field({});
  const Field doubled = Cloud{twice, 0.5}.field({});
  const Field one = Cloud{merged.positions, 0.5}.field({});
  for (Index k = 0; k < 100; ++k) {
    const Vec3 x = random_points(100, 3, 2).row(k).transpose();
    const auto expected = ShapeAtPoint(single, x).rows;
    const auto both = ShapeAtPoint(doubled, x).rows;
    const double size = expected.cwiseAbs().maxCoeff();
    keep_worst(figures["doubled"],
               (both.topRows(n) + both.bottomRows(n) - expected).cwiseAbs().maxCoeff() / size);
    keep_worst(figures["merged"],
               (ShapeAtPoint(one, x).rows - expected).cwiseAbs().maxCoeff() / size);
  }
}

/// Points on a particle, on a rim and outside all supports.
void measure_special_places(Figures& figures) {
  constexpr double h = 0.5;
  const Cloud cloud{lattice_particles({1, 1, 1}, 1.0 / 6).positions, h};
  const Points outside = random_directions(20, 3) * 5;
  Points u = cloud.positions.cwiseAbs2();  // bent
  for (const BasisOrder order : all_of<BasisOrder>())
    for (const KernelKind kernel : all_of<KernelKind>()) {
      const Field field = cloud.field({order, kernel});
      for (Index i = 0; i < cloud.positions.rows(); i += 7) {
        const Vec3 at = cloud.positions.row(i).transpose();
        std::vector<Vec3> places{at};
        for (const double rim : {1 - 1e-15, 1.0, 1 + 1e-15})
          for (int axis = 0; axis < 3; ++axis) places.push_back(at + rim * h * Vec3::Unit(axis));
        for (const Vec3& x : places) {
          const ShapeAtPoint shape(field, x);
          figures["not_finite"] += shape.not_finite();
          if (shape.rank > 0) keep_worst(figures["partition_of_unity"], shape.unity_error());
        }
      }
      const Samples samples = sample_field(field, outside, SampleContent::values_and_gradients);
      keep_worst(figures["outside_not_counted"],
                 static_cast<double>(outside.rows() - samples.uncovered));
      for (Index k = 0; k < outside.rows(); ++k) {
        const Vec3 x = outside.row(k).transpose();
        const int nearest = field.neighbors().nearest(x, 1).front();
        const Vec3 p = cloud.positions.row(nearest).transpose();
        const Samples there =
            sample_field(field, Points(p.transpose()), SampleContent::values_and_gradients);
        const Vec3 mapped = there.position(0, u) + there.deformation_gradient(0, u) * (x - p);
        keep_worst(figures["outside_miss"], (samples.position(k, u) - mapped).norm() / x.norm());
      }
    }
}

/// 60 particles on a unit sphere: a quadric is zero on all of them.
void measure_conic(Figures& figures) {
  const Field field = Cloud{random_directions(60, 3), 3}.field({BasisOrder::quadratic});
  const Points inside = random_directions(100, 4);
  for (Index k = 0; k < inside.rows(); ++k) {
    const Vec3 x = (k % 2 == 0 ? 1.0 : 0.6) * inside.row(k).transpose();
    const ShapeAtPoint shape(field, x);
    keep_worst(figures["rank_off"], std::abs(shape.rank - 9));
    keep_worst(figures["partition_of_unity"], shape.unity_error());
    keep_worst(figures["linear_reproduction"], linear_moment(shape, field, x).norm() / 3);
    keep_worst(figures["sum_of_absolutes"], shape.rows.col(0).lpNorm<1>());
  }
}

/// Keeps Σ|φ| at `points`, and its ratio to the step before.
void keep_step(const Field& field, const Points& points, const std::string& name,
               std::vector<double>& before, Figures& figures) {
  std::vector<double> sums;
  for (Index k = 0; k < points.rows(); ++k) {
    sums.push_back(ShapeAtPoint(field, points.row(k).transpose()).rows.col(0).lpNorm<1>());
    keep_worst(figures[name + "_sum_of_absolutes"], sums.back());
    if (before.empty()) continue;
    const double last = before[static_cast<std::size_t>(k)];
    keep_worst(figures[name + "_step"], std::max(sums.back() / last, last / sums.back()));
  }
  before = sums;
}

/// A sphere's particles on their way to an ellipsoid, which is a quadric too, and to a rough
/// sphere, which is none: its rank rises by one. There points are where the particles are.
void measure_sphere_to_ellipsoid(Figures& figures) {
  const Points sphere = random_directions(60, 3), directions = random_directions(60, 4);
  Points inside = directions;
  for (Index k = 0; k < inside.rows(); k += 2) inside.row(k) *= 0.5;
  Random random(5);
  Eigen::VectorXd roughness(60);
  for (Index i = 0; i < 60; ++i) roughness[i] = random.uniform(-1, 1);
  std::vector<double> before, rough_before;
  for (int step = 0; step < 40; ++step) {
    const double e = std::pow(10.0, -8 + 7.0 * step / 39);
    Points ellipsoid = sphere;
    ellipsoid.col(2) *= std::sqrt(1 - e * e);
    keep_step(Cloud{ellipsoid, 3}.field({BasisOrder::quadratic}), inside, "ellipsoid", before,
              figures);
    const Points rough = (1 + e * roughness.array()).matrix().asDiagonal() * sphere;
    keep_step(Cloud{rough, 3}.field({BasisOrder::quadratic}), directions, "rough", rough_before,
              figures);
  }
}

/// Two layers of particles 1e-6 spacings thick; points in the slab and half a spacing off it.
void measure_thin_slab(Figures& figures) {
  constexpr double s = 0.125, thickness = 1e-6 * s;
  Points slab = lattice_particles({1, 1, 2 * s}, s).positions;
  slab.col(2) = thickness * random_points(slab.rows(), 1, 6).col(0);
  const Points points = 0.1 + 0.8 * random_points(100, 3, 2).array();
  for (const BasisOrder order : all_of<BasisOrder>())
    for (const KernelKind kernel : all_of<KernelKind>()) {
      const Field field = Cloud{slab, 2.5 * s}.field({order, kernel});
      for (Index k = 0; k < points.rows(); ++k) {
        const Vec3 inside(points(k, 0), points(k, 1), thickness * points(k, 2));
        for (const Vec3& x : {inside, Vec3(inside + 0.5 * s * Vec3::UnitZ())}) {
          const ShapeAtPoint shape(field, x);
          keep_worst(figures["partition_of_unity"], shape.unity_error());
          keep_worst(figures["sum_of_absolutes"], shape.rows.col(0).lpNorm<1>());
          figures["not_finite"] += shape.not_finite();
        }
      }
    }
}

/// A block that passes into a single layer of particles, `thickness` spacings thick.
Points block_and_layer(double s, double thickness) {
  Points block = lattice_particles({1, 1, 4 * s}, s).positions;
  block.col(2).array() -= 2 * s;
  Points layer = lattice_particles({1, 1, s}, s).positions;
  layer.col(0).array() += 1;
  layer.col(2) = thickness * s * (random_points(layer.rows(), 1, 6).col(0).array() - 0.5);
  return together(block, layer);
}

/// The greatest change of a φ over 1e-3 h along x, from block to layer, `height` off the middle.
double greatest_jump(const Field& field, double h, double height) {
  Eigen::VectorXd before;
  double jump = 0;
  for (double x = 0.6; x < 1.6; x += 1e-3 * h) {
    ShapeFunctions<3> at_x;
    field.evaluate({x, 0.47, height}, Derivatives::none, at_x);
    Eigen::VectorXd phi = Eigen::VectorXd::Zero(field.positions().rows());
    phi(at_x.particles) = at_x.values;
    if (before.size() > 0) keep_worst(jump, (phi - before).cwiseAbs().maxCoeff());
    before = phi;
  }
  return jump;
}

/// Along the middle with supports all alike; off it with those that a shape's own choice gives.
void measure_thick_to_thin(Figures& figures) {
  constexpr double s = 0.125;
  for (const double thickness : {0.0, 1e-6, 1e-3, 1e-2, 1e-1}) {
    const Points particles = block_and_layer(s, thickness);
    for (const BasisOrder order : {BasisOrder::linear, BasisOrder::quadratic})
      keep_worst(figures["jump_in_the_middle"],
                 greatest_jump(Cloud{particles, 2.5 * s}.field({order}), 2.5 * s, 0));
    Points path(100, 3);
    for (Index k = 0; k < path.rows(); ++k) path.row(k) << 0.6 + 0.01 * double(k), 0.47, 0.5 * s;
    for (const SupportKind kind : all_of<SupportKind>()) {
      const Supports supports = choose_supports(particles, s, together(particles, path),
                                                KernelKind::polynomial, {.kind = kind});
      const Field field(particles, supports.radii, {}, nullptr, supports.stretches);
      keep_worst(figures["jump_at_the_surface"], greatest_jump(field, 1.81 * s, 0.5 * s));
    }
  }
}

/// A cone of slices with spacings from 1 to 100.
Particles graded_cone() {
  constexpr double ratio = 1.15;
  constexpr int slices = 34, width = 9;  // 1.15³³ = 101
  Random random(7);
  Particles cone;
  cone.positions.resize(slices * width * width, 3);
  cone.supports.resize(cone.positions.rows());
  Index row = 0;
  for (int k = 0; k < slices; ++k) {
    const double s = std::pow(ratio, k);
    for (int a = 0; a < width; ++a)
      for (int b = 0; b < width; ++b, ++row) {
        const Vec3 place(1 / (ratio - 1), a - width / 2, b - width / 2);
        cone.positions.row(row) = s * (place + random.in_cube(-0.15, 0.15)).transpose();
        cone.supports[row] = 2.6 * s;
      }
  }
  return cone;
}

void measure_graded_spacing(Figures& figures) {
  const Particles cone = graded_cone();
  Random random(8);
  for (const KernelKind kernel : all_of<KernelKind>()) {
    const Field field(cone.positions, cone.supports, {BasisOrder::quadratic, kernel});
    ShapeFunctions<3> at_x;
    for (int k = 0; k < 100; ++k) {
      const double s = std::pow(10.0, random.uniform(0.3, 1.7));
      const Vec3 x = s * Vec3(1 / 0.15, random.uniform(-2, 2), random.uniform(-2, 2));
      field.evaluate(x, Derivatives::none, at_x);
      const Eigen::MatrixX3d near =
          (cone.positions(at_x.particles, Eigen::all).rowwise() - x.transpose()) / s;
      keep_worst(figures["rank_off"], std::abs(at_x.rank - 10));
      keep_worst(figures["constant"], std::abs(at_x.values.sum() - 1));
      keep_worst(figures["linear"], (at_x.values.transpose() * near).norm());
      keep_worst(figures["quadratic"], (near.transpose() * at_x.values.asDiagonal() * near).norm());
      const Eigen::MatrixX3d ways = (cone.positions.rowwise() - x.transpose()).eval();
      Index reached = 0;
      for (Index i = 0; i < ways.rows(); ++i)
        reached += (kernel == KernelKind::box ? ways.row(i).lpNorm<Eigen::Infinity>()
                                              : ways.row(i).norm()) < cone.supports[i];
      keep_worst(figures["neighbors_off"],
                 std::abs(static_cast<double>(reached - Index(at_x.particles.size()))));
    }
  }
}

/// Particles that a grid finds within its radius otherwise than a look at all, or a kd-tree, does.
double wrong_neighbors(const Points& positions, double radius, const Points& places) {
  const HashGrid grid(positions, radius);
  const Neighbors<3> tree(positions, Eigen::VectorXd::Constant(positions.rows(), radius));
  std::vector<int> found, by_tree;
  double wrong = 0;
  for (Index k = 0; k < places.rows(); ++k) {
    const Vec3 x = places.row(k).transpose();
    std::vector<int> all;
    for (Index i = 0; i < positions.rows(); ++i)
      if ((positions.row(i).transpose() - x).squaredNorm() < radius * radius)
        all.push_back(static_cast<int>(i));
    grid.within(x, found);
    tree.reaching(x, by_tree);
    if (found != all || found != by_tree) ++wrong;
  }
  return wrong;
}

void measure_hash_grid(Figures& figures) {
  figures["wrong_random"] = figures["wrong_extreme"] = 0;
  Random random(9);
  for (int set = 0; set < 1000; ++set) {
    const Points points =
        (random_points(60, 3, random.next()).array() - 0.5) * random.uniform(0.1, 100);
    figures["wrong_random"] += wrong_neighbors(points, random.uniform(0.05, 20), points);
  }
  for (int set = 0; set < 50; ++set) {
    // Whole numbers with a radius of 1, 2 or 3: on the edges of cells and of balls; around a far
    // origin, with stray particles 2³¹ … 2⁵⁰ cells away on both sides.
    const double far = std::exp2(31 + set % 20);
    Points points = (8 * random_points(60, 3, random.next())).array().round() - 4;
    points.row(0) << far, -far, 0;
    points.row(1) << -far, far, far;
    points.row(2) = points.row(1) + Eigen::RowVector3d(1, 0, 0);
    if (set % 2 == 1) points.rowwise() += Eigen::RowVector3d(-far, far, -far);
    figures["wrong_extreme"] += wrong_neighbors(points, 1 + set % 3, points);
    const Points outside = points.rowwise() + Eigen::RowVector3d(0, 1e30, 0);
    figures["wrong_extreme"] += wrong_neighbors(points, 1, outside);
  }
}

constexpr Case cases[] = {
    {"A3", measure_isolated_particle},   {"A4", measure_coincident_particles},
    {"A5", measure_special_places},      {"A6", measure_conic},
    {"A7", measure_sphere_to_ellipsoid}, {"A8", measure_thin_slab},
    {"A9", measure_thick_to_thin},       {"A12", measure_graded_spacing},
    {"A13", measure_hash_grid},
};

}  // namespace

std::span<const Case> degenerate_cloud_cases() {
  return cases;
}

}  // namespace supple
