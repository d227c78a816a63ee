#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "modeler/domain/inside_cover.h"
#include "modeler/domain/inside_detours.h"
#include "modeler/domain/sample_particles.h"
#include "solver/core/random.h"
#include "solver/field/moving_least_squares.h"
#include "tests/cases/cases.h"
#include "tests/cases/posed_bar.h"
#include "tests/support/fingers.h"
#include "tests/support/region_shapes.h"

namespace supple {
namespace {

using Field = MovingLeastSquares<3>;

constexpr BasisOrder orders[] = {BasisOrder::constant, BasisOrder::linear, BasisOrder::quadratic};

/// Keeps the greater; a NaN stays.
void keep_worst(double& worst, double value) {
  if (!(value <= worst)) worst = value;
}

/// A shape filled with particles 0.8 apart, all with supports wide enough for a quadratic basis.
struct Body {
  static constexpr double h = 2.4;

  explicit Body(const Mesh& mesh) : region(region_of(mesh)) {
    ParticleSamplingOptions options;
    options.spacing = 0.8;
    ParticleSampling sampling = sample_particles(region, options);
    particles = std::move(sampling.particles);
    graph = std::make_shared<const InsideGraph>(region, sampling.samples);
    cover_inside(*graph, particles);
    supports = Eigen::VectorXd::Constant(particles.size(), h);
    detours = InsideDetours(graph, particles.positions, particles.spacing).within(supports, h);
  }

  Field field(BasisOrder order) const { return {particles.positions, supports, {order}, detours}; }

  /// φ of all particles at x.
  Eigen::VectorXd values(const Field& field, const Vec3& x) const {
    ShapeFunctions<3> at_x;
    field.evaluate(x, Derivatives::none, at_x);
    Eigen::VectorXd values = Eigen::VectorXd::Zero(particles.size());
    values(at_x.particles) = at_x.values;
    return values;
  }

  const MeshRegion region;
  Particles particles;
  std::shared_ptr<const InsideGraph> graph;
  Eigen::VectorXd supports;
  std::shared_ptr<const Detours> detours;
};

/// Random points inside where a detour is felt.
std::vector<Vec3> points_with_detours(const Body& body, int count) {
  Random random(3);
  std::vector<Vec3> points;
  std::vector<Detour> detours;
  const Box box = body.region.bounds();
  for (int tries = 0; tries < 100 * count && static_cast<int>(points.size()) < count; ++tries) {
    const Vec3 x = box.lower + random.in_cube(0, 1).cwiseProduct(box.size());
    if (!body.region.contains(x)) continue;
    body.detours->at(x, Derivatives::none, detours);
    if (!detours.empty()) points.push_back(x);
  }
  return points;
}

void measure_gradients(const Body& body, const Field& field, const std::vector<Vec3>& points,
                       Figures& figures) {
  const Vec3 b(0.3, -1.1, 0.7);
  const Eigen::VectorXd affine = (body.particles.positions * b).array() + 2;
  ShapeFunctions<3> at_x;
  for (const Vec3& x : points) {
    field.evaluate(x, Derivatives::first, at_x);
    Eigen::MatrixX3d slopes = Eigen::MatrixX3d::Zero(body.particles.size(), 3);
    slopes(at_x.particles, Eigen::all) = at_x.gradients;
    keep_worst(figures["concave_constant_field"], body.h * slopes.colwise().sum().norm());
    constexpr double step = 1e-6 * Body::h;
    Eigen::MatrixX3d differences = slopes;
    for (int k = 0; k < 3; ++k) {
      const Vec3 way = step * Vec3::Unit(k);
      differences.col(k) = (body.values(field, x + way) - body.values(field, x - way)) / (2 * step);
    }
    keep_worst(figures["concave_finite_differences"],
               body.h * (slopes - differences).rowwise().norm().maxCoeff());
    if (field.options().order == BasisOrder::constant) continue;
    keep_worst(figures["concave_affine_field"],
               (slopes.transpose() * affine - b).norm() / b.norm());
  }
}

/// Greatest change of any φ over 1e-3 h on straight ways through the corners.
double greatest_jump(const Body& body, const Field& field, const std::vector<Vec3>& corners) {
  double jump = 0;
  Eigen::VectorXd last = body.values(field, corners.front());
  for (std::size_t k = 1; k < corners.size(); ++k) {
    const Vec3 way = corners[k] - corners[k - 1];
    const int steps = static_cast<int>(std::ceil(way.norm() / (1e-3 * Body::h)));
    for (int step = 1; step <= steps; ++step) {
      const Eigen::VectorXd now = body.values(field, corners[k - 1] + way * step / steps);
      jump = std::max(jump, (now - last).cwiseAbs().maxCoeff());
      last = now;
    }
  }
  return jump;
}

/// Ways from one side of a gap at x = 0, z > 0 round its end to the other.
void measure_jumps(const Body& body, const Field& field, Figures& figures) {
  Random random(4);
  for (int way = 0; way < 4; ++way) {
    const double y = random.uniform(0.05, 1.95), side = random.uniform(0.12, 1);
    const double above = random.uniform(0.5, 1.8), below = random.uniform(0.02, 1);
    keep_worst(figures["concave_jump"], greatest_jump(body, field,
                                                      {{-side, y, above},
                                                       {-side, y, -below},
                                                       {side, random.uniform(0.05, 1.95), -below},
                                                       {side, y, above}}));
  }
}

void measure_plate(Figures& figures) {
  const Mesh plate = make_bar({100, 100, 1}, {30, 30, 1});
  constexpr double spacing = 1 / 0.3;
  const PoseResult result =
      pose(plate, read_scene_text(fmt::format("shape: {{mesh: plate.obj, spacing: {}}}\npose:\n"
                                              "  handles: [{{fix: x<5%}}]\n",
                                              spacing),
                                  "scene.yaml", ""));
  const Particles& particles = result.particles;
  figures["volume_error_percent"] = 100 * std::abs(particles.volumes.sum() / 1e4 - 1);
  for (Index i = 0; i < plate.positions.rows(); ++i)
    keep_worst(
        figures["gap"],
        (particles.positions.rowwise() - plate.positions.row(i)).rowwise().norm().minCoeff() /
            spacing);
  figures["said"] = result.report.find(ReasonCode::thin) != nullptr;
}

/// Two fingers, one of which is pulled away by 0.3 L. The palm and the fingers' roots are held, and
/// stiffly: what the palm itself passes on is no glue. (With the palm alone held, fingers 4 s apart
/// move by 4.6e-3 of the pull.)
PoseResult pull_finger(double gap, const std::string& coupling) {
  return pose(make_two_fingers(gap),
              read_scene_text("shape: {mesh: fingers.obj, spacing: 0.7, coupling: " + coupling +
                                  "}\npose:\n  weights: {handles: 1e6}\n  tolerance: 1e-11\n"
                                  "  max_iterations: 3000\n  handles:\n"
                                  "    - fix: z<2.6\n"
                                  "    - {move: z>7.6 and x<0, by: [-30%, 0, 0]}\n",
                              "scene.yaml", ""));
}

/// The longest way of a vertex of the finger that is not pulled, over the pull's.
double way_of_other_finger(const PoseResult& result) {
  const int vertices = static_cast<int>(result.rest.positions.rows());
  double way = 0;
  // Where the walls coincide, only what lies behind them is surely of the other finger.
  for (int i = 0; i < vertices; ++i)
    if (result.rest.positions(i, 0) > 0.05 && result.rest.positions(i, 2) > 0)
      keep_worst(way, (result.mesh.positions.row(i) - result.rest.positions.row(i)).norm());
  return way / (0.3 * diagonal_of(result.rest));
}

void measure_fingers(Figures& figures) {
  constexpr double gap = 0.2 * 0.7;
  const PoseResult result = pull_finger(gap, "inside");
  figures["other_finger"] = way_of_other_finger(result);
  figures["straight"] = way_of_other_finger(pull_finger(gap, "straight"));
  figures["active"] = static_cast<double>(
      std::any_of(result.effects.begin(), result.effects.end(),
                  [](const Effect& effect) { return effect.name == "coupling" && effect.active; }));
}

void measure_touching_fingers(Figures& figures) {
  const PoseResult touching = pull_finger(0, "inside");
  figures["other_finger"] = way_of_other_finger(touching);
  figures["said"] = touching.report.find(ReasonCode::self_contact) != nullptr;
  figures["overlap_said"] =
      pull_finger(-0.1 * 0.7, "inside").report.find(ReasonCode::self_contact) != nullptr;
}

constexpr Case cases[] = {
    {"B1", measure_plate}, {"B2", measure_fingers}, {"B3", measure_touching_fingers}};

}  // namespace

void measure_concave_gradients(Figures& figures) {
  for (const Mesh& mesh : {make_notched_block(), make_two_fingers(0.16)}) {
    const Body body(mesh);
    const std::vector<Vec3> points = points_with_detours(body, 60);
    figures["concave_points"] += static_cast<double>(points.size());
    for (const BasisOrder order : orders) {
      const Field field = body.field(order);
      measure_gradients(body, field, points, figures);
      measure_jumps(body, field, figures);
    }
  }
}

std::span<const Case> coupling_cases() {
  return cases;
}

}  // namespace supple
