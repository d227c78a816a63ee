#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

#include "io/errors.h"
#include "modeler/pose/pose_session.h"
#include "solver/core/random.h"
#include "solver/field/supports.h"
#include "tests/cases/cases.h"
#include "tests/cases/posed_bar.h"
#include "tests/support/lattice.h"

namespace supple {
namespace {

constexpr double degree = std::numbers::pi / 180;

double notes_with(const Report& report, std::string_view text) {
  return static_cast<double>(
      std::count_if(report.notes.begin(), report.notes.end(),
                    [&](const std::string& note) { return note.find(text) != std::string::npos; }));
}

VertexPlaces all_to(const Points& places) {
  VertexPlaces all{std::vector<int>(static_cast<std::size_t>(places.rows())), places};
  std::iota(all.vertices.begin(), all.vertices.end(), 0);
  return all;
}

PoseResult pose_to(const Mesh& mesh, const std::string& scene, PoseFiles files) {
  return pose(mesh, read_scene_text(scene, "scene.yaml", ""), {}, files);
}

// C4: twists by whole turns.

/// A bar 1:1:`length` with its lower end held and its upper one turned by that many degrees.
struct Twist {
  double degrees;
  int length;  ///< over the width
  double end_percent = 1;
  int particles = 400;
  std::string more = {};  ///< entries of `pose`
};

PoseResult pose_of(const Twist& twist) {
  const std::string scene = fmt::format(
      "shape: {{mesh: bar.obj, particles: {}}}\npose:\n{}  handles:\n    - fix: z<{}%\n"
      "    - {{move: z>{}%, turn: {{axis: [0, 0, 1], degrees: {}}}}}\n",
      twist.particles, twist.more, twist.end_percent, 100 - twist.end_percent, twist.degrees);
  return pose_to(make_bar({1, 1, double(twist.length)}, {8, 8, 8 * twist.length}), scene, {});
}

/// Angle [rad] about z from the bar's middle to the corner at the origin's edge at height z.
double corner_angle(const PoseResult& result, double z) {
  Vec3 middle = Vec3::Zero(), corner = Vec3::Zero();
  int count = 0;
  for (Index i = 0; i < result.rest.positions.rows(); ++i) {
    const Vec3 rest = result.rest.positions.row(i).transpose();
    if (std::abs(rest.z() - z) > 1e-9) continue;
    const Vec3 place = result.mesh.positions.row(i).transpose();
    middle += place;
    ++count;
    if (rest.head<2>().norm() < 1e-9) corner = place;
  }
  const Vec3 arm = corner - middle / count;
  return std::atan2(arm.y(), arm.x());
}

/// The turn [rad] from one end to the other, counted from slice to slice of the surface.
double turn_along(const PoseResult& result, int length) {
  double turn = 0;
  for (int slice = 0; slice < 8 * length; ++slice)
    turn +=
        std::remainder(corner_angle(result, (slice + 1) / 8.0) - corner_angle(result, slice / 8.0),
                       2 * std::numbers::pi);
  return turn;
}

void measure_held_twist(const Twist& twist, Figures& figures) {
  const PoseResult result = pose_of(twist);
  figures[fmt::format("min_J_{}", twist.degrees)] = result.min_det_F;
  figures[fmt::format("turn_off_{}_degrees", twist.degrees)] =
      std::abs(turn_along(result, twist.length) / degree - twist.degrees);
}

/// Places of the upper end, turned about the bar's axis.
Points upper_end_turned(const Mesh& bar, double degrees) {
  Points places = bar.positions;
  const Eigen::Rotation2Dd turn(degrees * degree);
  for (Index i = 0; i < places.rows(); ++i)
    places.row(i).head<2>() =
        (turn * (places.row(i).head<2>().transpose() - Eigen::Vector2d(0.5, 0.5)) +
         Eigen::Vector2d(0.5, 0.5))
            .transpose();
  return places;
}

void measure_whole_turns(Figures& figures) {
  measure_held_twist({.degrees = 360, .length = 8, .end_percent = 5, .particles = 200}, figures);
  measure_held_twist({.degrees = 720, .length = 16}, figures);

  const PoseResult buckled =
      pose_of({.degrees = 720, .length = 8, .end_percent = 5, .particles = 200});
  figures["buckled_said"] = buckled.report.find(ReasonCode::turn_lost) != nullptr;
  const PoseResult one_step =
      pose_of({.degrees = 720, .length = 8, .particles = 200, .more = "  substeps: 1\n"});
  figures["one_step_said"] = one_step.report.find(ReasonCode::turn_lost) != nullptr;

  const Mesh bar = case_bar();
  const std::string scene = scene_text("    - fix: z<1%\n    - {move: z>99%, to: places.obj}\n");
  const PoseResult places = pose_to(bar, scene, {{}, {{}, all_to(upper_end_turned(bar, 170))}});
  figures["places_said"] = notes_with(places.report, "the shorter way");
}

// C5: all handles to one point.

/// The least det F over particles and vertices that lie outside all supports that reach a handle.
double least_det_F_away(const PoseResult& result) {
  const Points& particles = result.particles.positions;
  const MovingLeastSquares<3> field(particles, result.particles.supports);
  Points points(particles.rows() + result.rest.positions.rows(), 3);
  points << particles, result.rest.positions;
  const Samples samples = sample_field(field, points, SampleContent::values_and_gradients);
  const double reach = result.particles.supports.maxCoeff();
  double least = 1;
  for (Index k = 0; k < samples.size(); ++k)
    if ((result.handle_rest.rowwise() - points.row(k)).rowwise().norm().minCoeff() > reach)
      least = std::min(least, samples.deformation_gradient(k, result.displacements).determinant());
  return least;
}

/// The bar with these parts led to its middle.
PoseResult led_to_one_point(const std::vector<std::string>& parts, const std::string& options) {
  const Mesh bar = case_bar();
  Points middle = bar.positions;
  middle.rowwise() = Eigen::RowVector3d(0.5, 0.5, 2);
  std::string scene = "shape: {mesh: bar.obj}\npose:\n" + options + "  handles:\n";
  for (const std::string& part : parts)
    scene += fmt::format("    - {{move: {}, to: middle.obj}}\n", part);
  return pose_to(bar, scene, {{}, std::vector<VertexPlaces>(parts.size(), all_to(middle))});
}

void measure_one_point(Figures& figures) {
  double& least = figures.emplace("min_J_away", 1).first->second;
  for (const std::vector<std::string>& parts :
       {std::vector<std::string>{"z<1%", "z>99%"},
        {"'nearest(0, 0, 0)'", "'nearest(1, 1, 0)'", "'nearest(1, 0, 4)'", "'nearest(0, 1, 4)'"}}) {
    const PoseResult plain = led_to_one_point(parts, "");
    const PoseResult guarded = led_to_one_point(parts, "  no_inversion: true\n");
    for (const PoseResult* result : {&plain, &guarded})
      figures["not_finite"] += !result->mesh.positions.allFinite();
    figures["unsaid"] +=
        (plain.min_det_F <= 0) != (plain.report.find(ReasonCode::inverted) != nullptr);
    least = std::min(least, least_det_F_away(guarded));
  }
}

// C12: handles that ask for the mirror image.

void measure_reflection(Figures& figures) {
  const Mesh bar = case_bar();
  Points mirrored = bar.positions;
  mirrored.col(0) = Eigen::VectorXd::Ones(mirrored.rows()) - mirrored.col(0);
  const std::string handles =
      "  handles:\n    - {move: z<10%, to: a.obj}\n    - {move: z>90%, to: a.obj}\n";
  const std::string scene = "shape: {mesh: bar.obj}\npose:\n";
  const std::vector<VertexPlaces> targets(2, all_to(mirrored));
  const PoseResult result = pose_to(bar, scene + handles, {{}, targets});
  const PoseResult from_mirrored =
      pose_to(bar, scene + "  from: b.obj\n" + handles, {mirrored, targets});
  figures["energy_over_other_start"] =
      result.report.total_energy() / from_mirrored.report.total_energy();
  figures["not_finite"] = !result.mesh.positions.allFinite();

  const Reason* inverted = result.report.find(ReasonCode::inverted);
  const Vec3& at = result.min_det_F_place;
  figures["min_J_said"] = inverted && inverted->value == result.min_det_F && result.min_det_F < 0;
  figures["place_said"] =
      inverted && inverted->detail.find(fmt::format("({:.6g}, {:.6g}, {:.6g})", at[0], at[1],
                                                    at[2])) != std::string::npos;
  // The ends are asked to turn inside out; the free middle is not.
  figures["place_off_the_ends"] = std::min(at.z(), 4 - at.z());
}

// C13: handles that reach nothing, or weigh nothing.

/// The line in which a handle's weight is refused; 0: it is not.
int line_of_refused_weight() {
  try {
    pose_with(case_bar(), "    - fix: z<10%\n    - move: z>90%\n      weight: 0\n");
  } catch (const UsageError& error) {
    constexpr std::string_view file = "scene.yaml:";
    const std::string message = error.what();
    if (message.rfind(file, 0) == 0) return std::stoi(message.substr(file.size()));
  }
  return 0;
}

/// A cube of particles and a handle of one point five spacings beside it, led by (0.1, 0, 0).
void measure_far_handle(Figures& figures) {
  const Particles particles = lattice_particles({1, 1, 1}, 0.25);
  const MovingLeastSquares<3> field(
      particles.positions,
      choose_supports(particles.positions, particles.spacing, particles.positions).radii);
  const Samples quadrature =
      sample_field(field, particles.positions, SampleContent::values_and_gradients);
  const SurfaceSamples point =
      point_samples(Points(Vec3(2.25, 0.5, 0.5).transpose()), Eigen::VectorXd::Ones(1));
  HandleSpec spec;
  PoseHandle handle;
  handle.spec = &spec;
  handle.samples = &point;
  handle.selected = {0};
  handle.thinned = {handle.selected, point.areas};
  handle.path.by = Vec3(0.1, 0, 0);
  const HandleSamples handles({handle});
  PoseSolver solver(field, quadrature, particles.volumes, handles, {});
  Points u = Points::Zero(particles.size(), 3);
  const Report report = solver.solve(
      {}, [](double) {}, u);
  figures["far_handle_said"] = report.find(ReasonCode::uncovered) != nullptr;
  figures["far_handle_miss"] = (u.rowwise() - Eigen::RowVector3d(0.1, 0, 0)).cwiseAbs().maxCoeff();
}

void measure_handles_without_effect(Figures& figures) {
  figures["no_weight_rejected_in_line"] = line_of_refused_weight();
  measure_far_handle(figures);
}

// C14: nearly incompressible.

/// The bar 1:1:4 with its upper face pulled sideways.
PoseResult pulled(const std::string& options, int particles, double handle_weight) {
  return pose_to(case_bar(),
                 fmt::format("shape: {{mesh: bar.obj, particles: {}}}\npose:\n{}  handles:\n"
                             "    - fix: z<1%\n"
                             "    - {{move: z>99%, by: [20%, 0, 0], weight: {}}}\n",
                             particles, options, handle_weight),
                 {});
}

std::string volume_weight(double weight) {
  return fmt::format("  weights: {{volume: {}}}\n", weight);
}

/// How far a weak handle gets the upper face.
double way_of_the_top(const PoseResult& result) {
  const Points ways = result.mesh.positions - result.rest.positions;
  double sum = 0;
  long count = 0;
  for (Index i = 0; i < ways.rows(); ++i)
    if (result.rest.positions(i, 2) > 4 - 1e-9) sum += ways(i, 0), ++count;
  return sum / static_cast<double>(count);
}

void measure_heavy_volume(Figures& figures) {
  const std::string reference = "  solver: trust_region\n";
  const double usual = pulled(reference, 200, 1).report.iterations;
  double& change = figures["volume_change_percent"];
  double& iterations = figures["iterations_over_usual"];
  for (const double weight : {1e3, 1e4, 1e5, 1e6}) {
    const PoseResult result = pulled(volume_weight(weight), 200, 1);
    figures["not_ok"] += result.report.status != Status::ok;
    change = std::max(change, 100 * std::abs(result.volume_after / result.volume_before - 1));
    const PoseResult check = pulled(reference + volume_weight(weight), 200, 1);
    iterations = std::max(iterations, check.report.iterations / usual);
  }
  const std::string exact = "  tolerance: 1e-9\n" + volume_weight(1e3);
  const PoseResult coarse = pulled(exact, 200, 1e-5), fine = pulled(exact, 1000, 1e-5);
  figures["way_over_finer"] = way_of_the_top(coarse) / way_of_the_top(fine);
}

// C15: handles that outweigh the shape by far.

PoseResult held_at_points(const std::string& how) {
  return pose_to(case_bar(),
                 "shape: {mesh: bar.obj}\npose:\n  tolerance: 1e-14\n" + how +
                     "  handles:\n    - fix: nearest(0, 0, 0)\n    - fix: nearest(1, 1, 0)\n"
                     "    - fix: nearest(1, 0, 0)\n"
                     "    - {move: 'nearest(0, 1, 4)', by: [20%, 5%, -5%]}\n"
                     "    - {move: 'nearest(1, 0, 4)', by: [20%, 5%, -5%]}\n",
                 {});
}

void measure_heavy_handles(Figures& figures) {
  const PoseResult heavy =
      held_at_points("  weights: {handles: 1e9, rigidity: 1e-3, volume: 1e-3}\n");
  const PoseResult exact = held_at_points("  hard_handles: true\n");
  figures["off_constrained"] =
      greatest_distance(heavy.mesh.positions, exact.mesh.positions) / diagonal_of(exact.rest);
}

// C16: a wild drag.

/// 1000 jumps of the upper end to random places, turned at random, five iterations each; then it
/// goes to its place and is let go.
void measure_wild_drag(Figures& figures) {
  const Mesh bar = case_bar();
  const Scene scene = read_scene_text(
      scene_text("    - fix: z<10%\n    - {move: z>90%, by: [0.8, 0.2, -0.4], turn: "
                 "{axis: [0, 1, 0], degrees: 60, about: [0.5, 0.5, 3.8]}}\n"),
      "scene.yaml", "");
  HandlePath last;
  last.center = last.about = Vec3(0.5, 0.5, 3.8);
  last.by = Vec3(0.8, 0.2, -0.4);
  last.axis = Vec3::UnitY();
  last.radians = 60 * degree;

  PoseSession session(bar, scene);
  Random random(1);
  for (int jump = 0; jump < 1000; ++jump) {
    HandlePath path = last;
    path.by = diagonal_of(bar) * random.in_cube(-0.5, 0.5);
    path.axis = random.in_cube(-1, 1).normalized();
    path.radians = std::numbers::pi * random.uniform(-1, 1);
    session.lead(1, path);
    session.drag({.max_iterations = 5, .tolerance = 1e-4});
  }
  session.lead(1, last);
  const Points cold = pose(bar, scene).mesh.positions;
  const auto off_cold = [&] {
    FloatPoints places;
    session.deform(places);
    return greatest_distance(places.cast<double>(), cold) / diagonal_of(bar);
  };
  figures["off_cold_before_release"] = off_cold();
  const Report report = session.release();
  figures["off_cold"] = off_cold();
  figures["not_ok"] = report.status != Status::ok;
}

constexpr Case cases[] = {{"C4", measure_whole_turns},   {"C5", measure_one_point},
                          {"C12", measure_reflection},   {"C13", measure_handles_without_effect},
                          {"C14", measure_heavy_volume}, {"C15", measure_heavy_handles},
                          {"C16", measure_wild_drag}};

}  // namespace

std::span<const Case> extreme_pose_cases() {
  return cases;
}

}  // namespace supple
