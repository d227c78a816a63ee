#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "io/errors.h"
#include "solver/core/rigid_motion.h"
#include "tests/cases/cases.h"
#include "tests/cases/posed_bar.h"

namespace supple {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// Greatest way of a vertex from where `motion` takes it, over L.
double miss(const PoseResult& result, const RigidMotion& motion) {
  const Points& x = result.rest.positions;
  const Points wanted = (x * motion.R.transpose()).rowwise() + motion.t.transpose();
  return greatest_distance(result.mesh.positions, wanted) / diagonal_of(result.rest);
}

void measure_rest(Figures& figures) {
  const PoseResult result =
      pose_with(case_bar(), "    - fix: z<10%\n    - {move: z>90%, by: [0, 0, 0]}\n");
  figures["moved"] = miss(result, {});
  figures["iterations"] = result.report.iterations;
}

/// Both ends turned by `degrees` about an oblique axis through the origin, then moved by
/// `lengths` diagonals.
double miss_of_rigid_motion(double degrees, double lengths) {
  std::string handles;
  for (const char* end : {"z<10%", "z>90%"})
    handles += fmt::format(
        "    - move: {}\n      by: [{}%, 0, {}%]\n"
        "      turn: {{axis: [1, 2, 3], degrees: {}, about: [0, 0, 0]}}\n",
        end, 60 * lengths, 80 * lengths, degrees);
  const Mesh bar = case_bar();
  RigidMotion motion;
  motion.R = Eigen::AngleAxisd(degrees * degree, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  motion.t = lengths * diagonal_of(bar) * Vec3(0.6, 0, 0.8);
  return miss(pose_with(bar, handles), motion);
}

void measure_rigid_motions(Figures& figures) {
  figures["turned_90"] = miss_of_rigid_motion(90, 0);
  figures["turned_180"] = miss_of_rigid_motion(180, 0);
  figures["moved_1000_L"] = miss_of_rigid_motion(0, 1000);
  figures["turned_180_moved_1000_L"] = miss_of_rigid_motion(180, 1000);
}

/// Best-fit angle [rad] about z of the vertices at height z, each seen from their mean.
double slice_angle(const PoseResult& result, double z) {
  std::vector<Index> slice;
  for (Index i = 0; i < result.rest.positions.rows(); ++i)
    if (result.rest.positions(i, 2) == z) slice.push_back(i);
  Points before = result.rest.positions(slice, Eigen::all);
  Points after = result.mesh.positions(slice, Eigen::all);
  before.rowwise() -= before.colwise().mean().eval();
  after.rowwise() -= after.colwise().mean().eval();
  const double cosine = before.leftCols<2>().cwiseProduct(after.leftCols<2>()).sum();
  const double sine = before.col(0).dot(after.col(1)) - before.col(1).dot(after.col(0));
  return std::atan2(sine, cosine);
}

/// The bar's end faces are held and turned, so that the twist grows along its whole length. The
/// volume weight is 10: at 1 the energy's own minimum loses 6 %, whatever the number of particles.
void measure_twist(Figures& figures) {
  const std::string handles =
      "    - fix: z<1%\n    - {move: z>99%, turn: {axis: [0, 0, 1], degrees: 180}}\n";
  Scene scene = read_scene_text(scene_text(handles), "scene.yaml", "");
  scene.pose->weights.volume = 10;
  const PoseResult result = pose(case_bar(), scene);
  figures["min_J"] = result.min_det_F;
  figures["volume_change_percent"] = 100 * std::abs(result.volume_after / result.volume_before - 1);
  double& off = figures["twist_off_linear_degrees"];
  for (double z = 0; z <= 4; z += 0.125) {
    const double difference = slice_angle(result, z) - 45 * degree * z;
    off = std::max(off, std::abs(std::remainder(difference, 2 * std::numbers::pi)) / degree);
  }
}

void measure_one_handle(Figures& figures) {
  const Mesh bar = case_bar();
  const PoseResult result =
      pose_with(bar, "    - {move: 'nearest(0.4, 0, 1)', by: [30%, 10%, -20%]}\n");
  figures["one_handle"] = miss(result, {Mat3::Identity(), diagonal_of(bar) * Vec3(0.3, 0.1, -0.2)});
}

void measure_no_handles(Figures& figures) {
  Scene scene;
  scene.pose.emplace();
  const PoseResult result = pose(case_bar(), scene);
  figures["no_handles"] = miss(result, {});
  figures["no_handles_message"] = static_cast<double>(
      std::count_if(result.report.notes.begin(), result.report.notes.end(),
                    [](const std::string& note) { return note.find("no handles") == 0; }));
}

/// Three points at like places of the bar's cells lie on a line, which is turned and moved.
void measure_collinear_handles(Figures& figures) {
  std::string handles;
  for (const double z : {1.02, 2.02, 3.02})
    handles += fmt::format(
        "    - move: nearest(0.55, 0, {})\n      by: [10%, 20%, 0]\n"
        "      turn: {{axis: [1, 0, 0], degrees: 40, about: [0.5, 0, 2]}}\n",
        z);
  const PoseResult result = pose_with(case_bar(), handles);
  const Points &rest = result.handle_rest, &targets = result.handle_targets;
  const auto direction = [](const Points& p) -> Vec3 {
    return (p.row(2) - p.row(0)).transpose().normalized();
  };
  const Vec3 line = direction(rest), turned_line = direction(targets);
  const Vec3 to_middle = (rest.row(1) - rest.row(0)).transpose();
  figures["collinear_handles_off_line"] =
      to_middle.cross(line).norm() / diagonal_of(result.rest) + double(rest.rows() - 3);
  const RigidMotion motion = best_fit_motion(result.rest.positions, result.mesh.positions,
                                             Eigen::VectorXd::Ones(result.rest.positions.rows()));
  const Mat3 without_spin = Eigen::Quaterniond::FromTwoVectors(line, turned_line).matrix();
  const Eigen::AngleAxisd rest_turn(Mat3(motion.R * without_spin.transpose()));
  figures["collinear_spin"] = std::abs(rest_turn.angle() * rest_turn.axis().dot(turned_line));
}

void measure_few_handles(Figures& figures) {
  measure_one_handle(figures);
  measure_no_handles(figures);
  measure_collinear_handles(figures);
}

/// One point with two targets 1 L apart, along x.
void measure_two_targets(Figures& figures) {
  const PoseResult result =
      pose_with(case_bar(),
                "    - {move: 'nearest(0.5, 0, 2)', by: [-50%, 0, 0]}\n"
                "    - {move: 'nearest(0.5, 0, 2)', by: [50%, 0, 0], weight: 3}\n");
  // Free otherwise, the bar goes along as it is.
  figures["off_mean"] =
      miss(result, {Mat3::Identity(), diagonal_of(result.rest) * Vec3(0.25, 0, 0)});
  figures["residuals"] = static_cast<double>(result.handles.size());
}

/// The line of scene.yaml at which a pose with these handles is refused; 0 for none.
int line_of_refusal(const std::string& handles) {
  try {
    pose_with(case_bar(), handles);
  } catch (const UsageError& error) {
    constexpr std::string_view file = "scene.yaml:";
    const std::string message = error.what();
    if (message.rfind(file, 0) == 0) return std::stoi(message.substr(file.size()));
  }
  return 0;
}

void measure_bad_handles(Figures& figures) {
  const auto line = [](const char* region, const char* by, const char* weight) {
    return line_of_refusal(
        fmt::format("    - fix: z<10%\n    - move: {}\n      by: [{}, 0, 0]\n"
                    "      weight: {}\n",
                    region, by, weight));
  };
  figures["nan_rejected_in_line"] = line("z>90%", ".nan", "1");
  figures["inf_rejected_in_line"] = line("z>90%", ".inf", "1");
  figures["minus_inf_rejected_in_line"] = line("z>90%", "-.inf", "1");
  figures["overflow_rejected_in_line"] = line("z>90%", "1e400", "1");
  figures["weight_rejected_in_line"] = line("z>90%", "0.5", "-1");
  figures["nan_weight_rejected_in_line"] = line("z>90%", "0.5", ".nan");
  figures["empty_region_rejected_in_line"] = line("z>110%", "0.5", "1");
}

constexpr Case cases[] = {{"C1", measure_rest},        {"C2", measure_rigid_motions},
                          {"C3", measure_twist},       {"C6", measure_two_targets},
                          {"C7", measure_few_handles}, {"C17", measure_bad_handles}};

}  // namespace

std::span<const Case> pose_cases() {
  return cases;
}

}  // namespace supple
