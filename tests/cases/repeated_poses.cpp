#include <Eigen/Geometry>
#include <cfenv>
#include <chrono>
#include <mutex>
#include <numeric>
#include <set>
#include <thread>

#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>
#include <xmmintrin.h>

#include "modeler/domain/shape_error.h"
#include "modeler/pose/pose_solver.h"
#include "solver/core/parallel.h"
#include "solver/field/supports.h"
#include "tests/cases/cases.h"
#include "tests/cases/posed_bar.h"
#include "tests/support/lattice.h"
#include "tests/support/run_program.h"

namespace supple {
namespace {

constexpr double degree = EIGEN_PI / 180;

bool same_bits(const Points& a, const Points& b) {
  return a.rows() == b.rows() && (a.array() == b.array()).all();
}

bool same_bits(const PoseResult& a, const PoseResult& b) {
  return same_bits(a.mesh.positions, b.mesh.positions) &&
         same_bits(a.displacements, b.displacements) && a.min_det_F == b.min_det_F &&
         a.report.energies == b.report.energies && a.report.iterations == b.report.iterations;
}

/// The bar bent and turned, by so many particles.
Scene bent(const char* solver, int particles) {
  Scene scene =
      read_scene_text(scene_text("    - fix: z<10%\n    - move: z>90%\n      by: [10%, 5%, 0]\n"
                                 "      turn: {axis: [1, 0, 1], degrees: 30}\n") +
                          fmt::format("  solver: {}\n", solver),
                      "scene.yaml", "");
  scene.shape.particles = particles;
  return scene;
}

// ---- L4

template <class Work>
auto with_threads(int threads, const Work& work) {
  const ThreadLimit limit(threads);
  return tbb::task_arena(threads).execute(work);
}

std::size_t threads_at_work(int threads) {
  std::mutex mutex;
  std::set<std::thread::id> seen;
  with_threads(threads, [&] {
    parallel_chunks(64, 1, [&](Index, Index) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      const std::lock_guard lock(mutex);
      seen.insert(std::this_thread::get_id());
    });
  });
  return seen.size();
}

/// How many of the runs' results differ from the first one's.
template <class Work>
int count_differences(const Work& work) {
  const auto first = with_threads(1, work);
  int differences = 0;
  for (const int threads : {1, 2, 3, 4, 8})
    for (int run = 0; run < 3; ++run) differences += !same_bits(with_threads(threads, work), first);
  return differences;
}

/// φ and ∇φ at many points, a row each.
Points sampled() {
  const Particles particles = lattice_particles({1, 1, 4}, 0.25);
  const MovingLeastSquares<3> field(
      particles.positions, choose_supports(particles.positions, 0.25, particles.positions).radii);
  Random random(3);
  Points points(3000, 3);
  for (Index i = 0; i < points.rows(); ++i) points.row(i) = random.in_cube(0.1, 0.9).transpose();
  const Samples samples = sample_field(field, points, SampleContent::values_and_gradients);
  Points rows(2 * static_cast<Index>(samples.particles.size()), 3);
  for (std::size_t e = 0; e < samples.particles.size(); ++e) {
    const auto row = 2 * static_cast<Index>(e);
    rows.row(row) << samples.particles[e], samples.values[e], 0;
    rows.row(row + 1) = samples.gradients[e].transpose();
  }
  return rows;
}

void measure_threads(Figures& figures) {
  const Mesh bar = case_bar();
  figures["threads_at_work"] = static_cast<double>(threads_at_work(8));
  figures["samples_differ"] = count_differences(sampled);
  figures["poses_differ"] = count_differences([&] { return pose(bar, bent("lbfgs", 300)); });
  figures["trust_region_differs"] =
      count_differences([&] { return pose(bar, bent("trust_region", 40)); });
}

// ---- L7

/// Another rounding or treatment of denormal numbers than usual, as long as it lives.
class Environment {
 public:
  Environment(int rounding, unsigned flush) {
    std::fegetenv(&before_);
    std::fesetround(rounding);
    _mm_setcsr(_mm_getcsr() | flush);
  }
  ~Environment() { std::fesetenv(&before_); }
  Environment(const Environment&) = delete;

 private:
  std::fenv_t before_;
};

/// Sums that show how numbers are rounded, and whether denormal ones are.
Points rounded() {
  volatile double one = 1, three = 3, ten = 10, denormal = 1e-310;
  Points rows(1, 3);
  rows << one / three, one / ten, denormal * three;
  return rows;
}

constexpr unsigned flush_denormals = 0x8040;  // FTZ and DAZ

/// What comes of a pose in another environment, to be looked at outside it.
struct Elsewhere {
  PoseResult pose;
  Points rounded;
  bool kept;  ///< the environment, by the pose
};

Elsewhere posed_elsewhere(const Mesh& mesh, const Scene& scene, int rounding, unsigned flush) {
  const Environment environment(rounding, flush);
  PoseResult result = pose(mesh, scene);
  const bool kept = std::fegetround() == rounding && (_mm_getcsr() & flush_denormals) == flush;
  return {std::move(result), rounded(), kept};
}

void measure_environments(Figures& figures) {
  const Mesh bar = case_bar();
  const Scene scene = bent("lbfgs", 150);
  const PoseResult expected = pose(bar, scene);
  for (const auto& [rounding, flush] : {std::pair{FE_UPWARD, 0u},
                                        {FE_DOWNWARD, 0u},
                                        {FE_TOWARDZERO, 0u},
                                        {FE_TONEAREST, flush_denormals}}) {
    const Elsewhere there = posed_elsewhere(bar, scene, rounding, flush);
    figures["environments_felt"] += !same_bits(there.rounded, rounded());
    figures["environments_kept"] += there.kept;
    figures["poses_differ"] += !same_bits(there.pose, expected);
  }
}

bool compiles(const char* flag) {
  const TemporaryFolder folder;
  return Program(SUPPLE_COMPILER,
                 {"-std=c++20", flag, "-fsyntax-only", "-I", SUPPLE_SOURCE_DIR,
                  SUPPLE_SOURCE_DIR "/solver/core/arithmetic.cpp"},
                 folder.path())
             .wait()
             .code == 0;
}

/// Shapes whose coordinates are denormal numbers.
bool refuses_denormal_shape() {
  Mesh bar = case_bar();
  bar.positions *= 1e-310;
  try {
    pose(bar, bent("lbfgs", 100));
  } catch (const ShapeError&) {
    return true;
  }
  return false;
}

void measure_arithmetic(Figures& figures) {
  measure_environments(figures);
  figures["denormal_shape_refused"] = refuses_denormal_shape();
  figures["fast_math_compiles"] = compiles("-ffast-math");
  figures["without_it_compiles"] = compiles("-O2");
}

// ---- L8

/// A twisted bar of particles, in another order and turned as a whole.
class TurnedBar {
 public:
  TurnedBar(const std::vector<int>& order, const Mat3& R)
      : order_(order),
        R_(R),
        particles_(lattice_particles({1, 1, 3}, 0.25)),
        positions_(particles_.positions(order, Eigen::all) * R.transpose()),
        field_(positions_, choose_supports(positions_, particles_.spacing, positions_).radii),
        quadrature_(sample_field(field_, positions_, SampleContent::values_and_gradients)),
        ends_(point_samples(ends() * R.transpose(), Eigen::VectorXd::Ones(32))),
        handles_(handles()),
        solver_(field_, quadrature_, particles_.volumes, handles_, {}) {}

  /// Displacements in the first order, turned back.
  Points solved() {
    Points u = Points::Zero(positions_.rows(), 3);
    solver_.solve(
        {.minimize = {.tolerance = 1e-16}, .substeps = 4}, [](double) {}, u);
    Points back(u.rows(), 3);
    back(order_, Eigen::all) = u * R_;
    return back;
  }

 private:
  static Points ends() {
    Points points(32, 3);
    Index row = 0;
    for (const double z : {0.0, 3.0})
      for (int x = 0; x < 4; ++x)
        for (int y = 0; y < 4; ++y) points.row(row++) << 0.125 + 0.25 * x, 0.125 + 0.25 * y, z;
    return points;
  }

  PoseHandle handle(int first) const {
    PoseHandle handle;
    handle.spec = &spec_;
    handle.samples = &ends_;
    handle.selected.resize(16);
    std::iota(handle.selected.begin(), handle.selected.end(), first);
    handle.thinned = {handle.selected, Eigen::VectorXd::Ones(16)};
    return handle;
  }

  std::vector<PoseHandle> handles() const {
    // The bar goes far and bends a little: a minimum is found to the root of rounding times the
    // root of its energy.
    PoseHandle foot = handle(0), head = handle(16);
    foot.path.about = head.path.about = R_ * Vec3(0.5, 0.5, 3);
    foot.path.axis = head.path.axis = R_ * Vec3(1, 2, 3).normalized();
    foot.path.radians = 50 * degree;
    head.path.radians = 51 * degree;
    foot.path.by = R_ * Vec3(0.4, -0.2, 0.1);
    head.path.by = R_ * Vec3(0.41, -0.2, 0.095);
    return {foot, head};
  }

  std::vector<int> order_;
  Mat3 R_;
  HandleSpec spec_;
  Particles particles_;
  Points positions_;
  MovingLeastSquares<3> field_;
  Samples quadrature_;
  SurfaceSamples ends_;
  HandleSamples handles_;
  PoseSolver solver_;
};

std::vector<int> shuffled(int count) {
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  Random random(11);
  for (std::size_t i = order.size(); i-- > 1;) std::swap(order[i], order[random.next() % (i + 1)]);
  return order;
}

/// Between vertices of the bar's poses, over L, once that of `mesh` is moved and scaled back.
double difference(const PoseResult& expected, const Mesh& mesh, double scale, const Vec3& offset) {
  const PoseResult result = pose(mesh, bent("lbfgs", 200));
  const Points back = (result.mesh.positions.rowwise() - offset.transpose()) / scale;
  return greatest_distance(back, expected.mesh.positions) / diagonal_of(expected.rest);
}

/// Every triangle with vertices of its own.
Mesh as_soup(const Mesh& mesh) {
  Mesh soup = mesh;
  soup.positions = mesh.positions(mesh.face_vertices, Eigen::all);
  std::iota(soup.face_vertices.begin(), soup.face_vertices.end(), 0);
  return soup;
}

void measure_metamorphoses(Figures& figures) {
  const int count = 4 * 4 * 12;
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  const Points expected = TurnedBar(order, Mat3::Identity()).solved();
  const double L = Vec3(1, 1, 3).norm();
  figures["moved"] = expected.rowwise().norm().maxCoeff() / L;
  figures["particles_permuted"] =
      greatest_distance(TurnedBar(shuffled(count), Mat3::Identity()).solved(), expected) / L;
  const Mat3 R = Eigen::AngleAxisd(1, Vec3(3, 1, 2).normalized()).toRotationMatrix();
  figures["field_rotated"] = greatest_distance(TurnedBar(order, R).solved(), expected) / L;

  const Mesh bar = case_bar();
  const PoseResult here = pose(bar, bent("lbfgs", 200));
  Mesh moved = bar;
  const Vec3 offset(12.3, -45.6, 7.89);
  moved.positions.rowwise() += offset.transpose();
  figures["translated"] = difference(here, moved, 1, offset);
  for (const auto& [name, scale] : {std::pair{"scaled_to_3e_7", 3e-7}, {"scaled_to_7e5", 7e5}}) {
    Mesh scaled = bar;
    scaled.positions *= scale;
    figures[name] = difference(here, scaled, scale, Vec3::Zero());
  }
  const Points soup = pose(as_soup(bar), bent("lbfgs", 200)).mesh.positions;
  figures["split_into_triangles"] =
      greatest_distance(soup, here.mesh.positions(bar.face_vertices, Eigen::all)) /
      diagonal_of(bar);
}

constexpr Case cases[] = {
    {"L4", measure_threads}, {"L7", measure_arithmetic}, {"L8", measure_metamorphoses}};

}  // namespace

std::span<const Case> repeated_pose_cases() {
  return cases;
}

}  // namespace supple
