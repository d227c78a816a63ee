// How near posing is to the limit of the machine. Every benchmark runs what it compares by turns,
// step for step, so that its ratios hold on a busy machine too; energies stand beside the times.
#include <Eigen/Geometry>
#include <algorithm>

#include <benchmark/benchmark.h>

#include "io/scene/scene_reader.h"
#include "modeler/domain/surface_measures.h"
#include "modeler/pose/pose.h"
#include "modeler/pose/pose_session.h"
#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
#include "solver/minimize/lbfgs.h"
#include "tests/bench/bench_shapes.h"
#include "tests/bench/references/as_rigid_as_possible.h"
#include "tests/bench/references/limit.h"
#include "tests/bench/references/trust_region.h"

namespace supple::bench {
namespace {

constexpr double drag_tolerance = 1e-4;
constexpr int drag_steps = 24;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double milliseconds(const std::vector<double>& seconds) {
  return 1e3 * median(seconds);
}

template <class Work>
double timed(const Work& work) {
  const Stopwatch watch;
  work();
  return watch.seconds();
}

/// The k-th step of a drag: 1.5 % of the size and 1° further than the one before.
HandlePath drag_path(int step, const Vec3& about, double size) {
  HandlePath path;
  path.center = path.about = about;
  path.by = 0.015 * step * size * Vec3(0.95, 0, 0.3).normalized();
  path.radians = step * EIGEN_PI / 180;
  return path;
}

ShapeSpec with_particles(int particles) {
  ShapeSpec spec;
  spec.particles = particles;
  return spec;
}

/// A shape whose lowest tenth is held and whose top is dragged, as the solvers see it.
struct DragShape {
  Solid solid;
  std::unique_ptr<SolidField> field;
  Points held, led;
  Samples handles;
  DragProblem problem;
  HandleEnergy handle_energy;
  RigidityEnergy rigidity;
  VolumeEnergy volume;
  EnergySum energy;

  DragShape(const Mesh& mesh, int particles, double width = 0.5)
      : solid(mesh, with_particles(particles)),
        handle_energy(Points()),
        energy(solid.particles().size()) {
    const ShapeSpec spec = with_particles(particles);
    solid.choose_particle_supports(spec);
    field = std::make_unique<SolidField>(solid, spec, SurfaceKind::field);
    const Box box = bounding_box(solid.vertices());
    const auto height = [&](Index i) {
      return (solid.surface().positions(i, 1) - box.lower.y()) / box.size().y();
    };
    held = thinned([&](Index i) { return height(i) < 0.1; }, width);
    led = thinned([&](Index i) { return height(i) > 0.85; }, width);
    Points rest(held.rows() + led.rows(), 3);
    rest << held, led;
    handles = sample_field(field->mls, rest, SampleContent::values);
    problem = {.particles = solid.particles().size(),
               .quadrature = &field->quadrature,
               .volumes = field->points.volumes / field->points.volumes.sum(),
               .handles = &handles,
               .handle_weights = Eigen::VectorXd::Constant(rest.rows(), 1.0 / double(rest.rows()))};
    handle_energy.set_targets(rest);
    energy.add(handle_energy, handles, problem.handle_weights, problem.handle);
    energy.add(rigidity, field->quadrature, problem.volumes, problem.rigidity);
    energy.add(volume, field->quadrature, problem.volumes, problem.volume);
  }

  template <class Chosen>
  Points thinned(const Chosen& chosen, double width) const {
    std::vector<int> rows;
    for (Index i = 0; i < solid.surface().size(); ++i)
      if (chosen(i)) rows.push_back(static_cast<int>(i));
    const ThinnedSamples thin =
        thin_samples(solid.surface(), rows, width * solid.particles().spacing);
    return solid.surface().positions(thin.indices, Eigen::all);
  }

  Points targets(int step) const {
    Points targets(held.rows() + led.rows(), 3);
    const HandlePath path = drag_path(step, led.colwise().mean(), 1);
    targets.topRows(held.rows()) = held;
    for (Index k = 0; k < led.rows(); ++k)
      targets.row(held.rows() + k) = path(led.row(k).transpose(), 1).transpose();
    return targets;
  }
};

/// One drag step at so many particles: ours, the trust region, the limit.
void drag(benchmark::State& state) {
  const int particles = static_cast<int>(state.range(0));
  const bool with_trust_region = particles <= 1000;
  DragShape shape(real_shape(), particles);
  const Preconditioner preconditioner(shape.energy);
  for (auto _ : state) {
    Lbfgs lbfgs;
    Limit limit(shape.problem, preconditioner);
    TrustRegion trust_region(shape.problem);
    PaddedPoints u = PaddedPoints::Zero(shape.problem.particles, 4);
    std::vector<double> ours, limits, trusts;
    double energy = 0, limit_energy = 0, trust_energy = 0;
    for (int step = 1; step <= drag_steps; ++step) {
      const Points targets = shape.targets(step);
      ours.push_back(timed([&] {
        shape.handle_energy.set_targets(targets);
        energy +=
            lbfgs.minimize(shape.energy, preconditioner, {.tolerance = drag_tolerance}, nullptr, u)
                .energy;
      }));
      limits.push_back(timed([&] { limit_energy += limit.solve(targets, drag_tolerance); }));
      if (with_trust_region)
        trusts.push_back(
            timed([&] { trust_energy += trust_region.solve(targets, drag_tolerance); }));
    }
    state.counters["ms"] = milliseconds(ours);
    state.counters["limit_ms"] = milliseconds(limits);
    state.counters["over_limit"] = milliseconds(ours) / milliseconds(limits);
    state.counters["energy"] = energy;
    state.counters["limit_energy"] = limit_energy;
    if (!with_trust_region) continue;
    state.counters["trust_region_ms"] = milliseconds(trusts);
    state.counters["faster_than_trust_region"] = milliseconds(trusts) / milliseconds(ours);
    state.counters["trust_region_energy"] = trust_energy;
  }
}

/// A drag step with hard handles beside one with soft ones.
void hard_handles(benchmark::State& state) {
  constexpr double hard_width = 0.1;
  const int particles = static_cast<int>(state.range(0));
  DragShape soft(real_shape(), particles), hard(real_shape(), particles, hard_width);
  const Preconditioner soft_preconditioner(soft.energy), hard_preconditioner(hard.energy);
  const Stopwatch watch;
  HardConstraints constraints(hard.handles, hard.problem.handle_weights, hard.handles.points,
                              hard_preconditioner);
  state.counters["set_up_ms"] = 1e3 * watch.seconds();
  for (auto _ : state) {
    Lbfgs soft_lbfgs, hard_lbfgs;
    PaddedPoints u = PaddedPoints::Zero(soft.problem.particles, 4), v = u;
    std::vector<double> soft_seconds, hard_seconds;
    double miss = 0;
    for (int step = 1; step <= drag_steps; ++step) {
      const Points targets = soft.targets(step), hard_targets = hard.targets(step);
      soft_seconds.push_back(timed([&] {
        soft.handle_energy.set_targets(targets);
        soft_lbfgs.minimize(soft.energy, soft_preconditioner, {.tolerance = drag_tolerance},
                            nullptr, u);
      }));
      hard_seconds.push_back(timed([&] {
        hard.handle_energy.set_targets(hard_targets);
        constraints.decide(hard_targets);
        Points met = v.leftCols<3>();
        constraints.meet(hard_targets, met);
        v.leftCols<3>() = met;
        hard_lbfgs.minimize(hard.energy, hard_preconditioner, {.tolerance = drag_tolerance},
                            &constraints, v);
      }));
      const Points plain = v.leftCols<3>();
      for (Index k = 0; k < hard_targets.rows(); ++k)
        miss = std::max(miss,
                        (hard.handles.position(k, plain) - hard_targets.row(k).transpose()).norm());
    }
    state.counters["ms"] = milliseconds(hard_seconds);
    state.counters["soft_ms"] = milliseconds(soft_seconds);
    state.counters["over_soft"] = milliseconds(hard_seconds) / milliseconds(soft_seconds);
    state.counters["miss_over_size"] = miss;
    state.counters["tied"] = static_cast<double>(constraints.tied());
  }
}

/// A half turn in one request, bent or twisted, beside the trust region on the same way.
void half_turn(benchmark::State& state, const char* turn) {
  const Mesh bar = make_bar({1, 1, 4}, {8, 8, 32});
  Scene scene = read_scene_text(
      std::string("shape: {mesh: bar.obj, particles: 200}\npose:\n  handles:\n    - fix: z<2%\n    "
                  "- {move: z>98%, ") +
          turn + "}\n",
      "bench", "");
  const auto energy = [](const PoseResult& result) {
    double sum = 0;
    for (const auto& [name, value] : result.report.energies) sum += value;
    return sum;
  };
  const auto solve_seconds = [](const PoseResult& result) {
    for (const auto& [name, seconds] : result.report.seconds)
      if (name == "solve") return seconds;
    return 0.0;
  };
  for (auto _ : state) {
    const PoseResult ours = pose(bar, scene);
    Scene by_trust_region = scene;
    by_trust_region.pose->solver = MinimizerKind::trust_region;
    const PoseResult reference = pose(bar, by_trust_region);
    state.counters["ms"] = 1e3 * solve_seconds(ours);
    state.counters["trust_region_ms"] = 1e3 * solve_seconds(reference);
    state.counters["energy"] = energy(ours);
    state.counters["trust_region_energy"] = energy(reference);
    state.counters["min_det_F"] = ours.min_det_F;
  }
}

/// A sparse row of doubles a vertex, as one would write it first.
class PlainRows {
 public:
  explicit PlainRows(Samples samples) : samples_(std::move(samples)) {}

  void displace(const Points& u, Points& out) const {
    for (Index k = 0; k < samples_.size(); ++k) out.row(k) = samples_.position(k, u).transpose();
  }
  std::size_t entries() const { return samples_.particles.size(); }

 private:
  Samples samples_;
};

/// Adds up so many bytes, by as many threads as everything else.
class ReadSum {
 public:
  explicit ReadSum(std::size_t bytes) : numbers_(Eigen::VectorXf::Ones(Index(bytes / 4))) {}

  float operator()() const {
    constexpr Index chunk = 1 << 16;
    std::vector<float> sums(static_cast<std::size_t>((numbers_.size() + chunk - 1) / chunk));
    const auto add = [&](Index begin, Index end) {
      sums[static_cast<std::size_t>(begin / chunk)] = numbers_.segment(begin, end - begin).sum();
    };
    parallel_chunks(numbers_.size(), chunk, std::cref(add));
    float sum = 0;
    for (const float part : sums) sum += part;
    return sum;
  }

 private:
  Eigen::VectorXf numbers_;
};

/// Positions of a surface of so many vertices over 60 particles, beside a read-sum over the bytes
/// that must be read, and plain rows.
void deform(benchmark::State& state) {
  const ThreadLimit threads(static_cast<int>(state.range(1)));
  Solid solid(surface_of(state.range(0)), with_particles(60));
  solid.choose_particle_supports(with_particles(60));
  const SolidField field(solid, with_particles(60), SurfaceKind::field);
  const PlainRows rows(sample_field(field.mls, solid.inner_vertices(), SampleContent::values));
  const ReadSum read_sum(4 * rows.entries() +
                         24 * static_cast<std::size_t>(solid.vertices().rows()));
  Points u = Points::Random(solid.particles().size(), 3) * 0.05;
  SurfaceEmbedding::Scratch scratch;
  FloatPoints out;
  Points plain(solid.vertices().rows(), 3);
  for (auto _ : state) {
    std::vector<double> ours, reads, plains;
    for (int turn = 0; turn < 40; ++turn) {
      ours.push_back(
          timed([&] { field.surface.positions(u, solid.particles().volumes, {}, scratch, out); }));
      reads.push_back(timed([&] { benchmark::DoNotOptimize(read_sum()); }));
      if (turn % 4 == 0) plains.push_back(timed([&] { rows.displace(u, plain); }));
    }
    state.counters["ms"] = milliseconds(ours);
    state.counters["read_sum_ms"] = milliseconds(reads);
    state.counters["over_read_sum"] = milliseconds(ours) / milliseconds(reads);
    state.counters["plain_rows_ms"] = milliseconds(plains);
    state.counters["faster_than_plain_rows"] = milliseconds(plains) / milliseconds(ours);
    state.counters["entries_per_vertex"] =
        static_cast<double>(rows.entries()) / static_cast<double>(solid.vertices().rows());
    state.counters["difference"] = (out.cast<double>() - plain).rowwise().norm().maxCoeff();
  }
}

Scene drag_scene(int particles) {
  return read_scene_text(
      "shape: {mesh: shape.off, particles: " + std::to_string(particles) +
          "}\npose:\n  handles:\n    - fix: y<10%\n    - {move: y>85%, by: [0, 0, "
          "0]}\n",
      "bench", "");
}

/// Whole frames: a drag step of 60 particles, then the surface, without and with normals.
void frames(benchmark::State& state) {
  const Mesh mesh = surface_of(state.range(0));
  PoseSession session(mesh, drag_scene(60));
  const Box box = bounding_box(mesh.positions);
  const Vec3 about(box.center().x(), box.upper.y(), box.center().z());
  FloatPoints positions, normals;
  session.deform(positions, normals);
  for (auto _ : state) {
    std::vector<double> poses, deforms, shadeds;
    for (int step = 1; step <= drag_steps; ++step) {
      session.lead(1, drag_path(step, about, box.diagonal()));
      poses.push_back(timed([&] { session.drag(); }));
      deforms.push_back(timed([&] { session.deform(positions); }));
      shadeds.push_back(timed([&] { session.deform(positions, normals); }));
    }
    state.counters["drag_ms"] = milliseconds(poses);
    state.counters["deform_ms"] = milliseconds(deforms);
    state.counters["frames_per_second"] = 1 / (median(poses) + median(deforms));
    state.counters["shaded_frames_per_second"] = 1 / (median(poses) + median(shadeds));
  }
}

/// Vertices whose height lies in a range, in shares of the box.
std::vector<int> vertices_between(const Points& vertices, double low, double high) {
  const Box box = bounding_box(vertices);
  std::vector<int> chosen;
  for (Index i = 0; i < vertices.rows(); ++i) {
    const double height = (vertices(i, 1) - box.lower.y()) / box.size().y();
    if (height > low && height < high) chosen.push_back(static_cast<int>(i));
  }
  return chosen;
}

/// Steps of the same drag on the same fine mesh by CGAL, five iterations each, and by us. CGAL
/// solves for every vertex and meets its controls exactly; we solve for 200 particles, softly.
void beside_cgal(benchmark::State& state) {
  constexpr int steps = 12, iterations = 5;
  const Mesh mesh = fine_shape();
  Scene scene = drag_scene(200);
  scene.pose->weights.volume = static_cast<double>(state.range(0));
  const Triangles triangles = triangulate(mesh).triangles;
  const Box box = bounding_box(mesh.positions);
  const double volume = signed_volume(mesh.positions, triangles);
  const std::vector<int> held = vertices_between(mesh.positions, -1, 0.1),
                         led = vertices_between(mesh.positions, 0.85, 2);
  std::vector<int> controls = held;
  controls.insert(controls.end(), led.begin(), led.end());
  const Vec3 about = mesh.positions(led, Eigen::all).colwise().mean();
  for (auto _ : state) {
    std::unique_ptr<PoseSession> session;
    std::unique_ptr<AsRigidAsPossible> cgal;
    const double set_up = timed([&] { session = std::make_unique<PoseSession>(mesh, scene); });
    const double cgal_set_up = timed(
        [&] { cgal = std::make_unique<AsRigidAsPossible>(mesh.positions, triangles, controls); });
    std::vector<double> ours, theirs;
    FloatPoints positions;
    Points targets = mesh.positions(controls, Eigen::all);
    double change = 0, cgal_change = 0;
    for (int step = 1; step <= steps; ++step) {
      const HandlePath path = drag_path(step, about, box.diagonal());
      for (std::size_t k = held.size(); k < controls.size(); ++k)
        targets.row(static_cast<Index>(k)) =
            path(mesh.positions.row(controls[k]).transpose(), 1).transpose();
      ours.push_back(timed([&] {
        session->lead(1, path);
        session->drag();
        session->deform(positions);
      }));
      theirs.push_back(timed([&] { cgal->deform(targets, iterations); }));
      const auto change_of = [&](const Points& deformed) {
        return std::abs(signed_volume(deformed, triangles) / volume - 1);
      };
      change = std::max(change, change_of(positions.cast<double>()));
      cgal_change = std::max(cgal_change, change_of(cgal->positions()));
    }
    state.counters["vertices"] = static_cast<double>(mesh.positions.rows());
    state.counters["ms"] = milliseconds(ours);
    state.counters["cgal_ms"] = milliseconds(theirs);
    state.counters["faster_than_cgal"] = milliseconds(theirs) / milliseconds(ours);
    state.counters["set_up_s"] = set_up;
    state.counters["cgal_set_up_s"] = cgal_set_up;
    state.counters["volume_change"] = change;
    state.counters["cgal_volume_change"] = cgal_change;
  }
}

BENCHMARK(drag)->Arg(60)->Arg(200)->Arg(1000)->Arg(5000)->Iterations(1);
BENCHMARK(hard_handles)->Arg(200)->Arg(1000)->Iterations(1);
BENCHMARK_CAPTURE(half_turn, twisted, "turn: {axis: [0, 0, 1], degrees: 180}")->Iterations(1);
BENCHMARK_CAPTURE(half_turn, bent, "turn: {axis: [0, 1, 0], degrees: 180, about: [1.77, 0.5, 2]}")
    ->Iterations(1);
BENCHMARK(deform)->ArgsProduct({{100'000, 500'000}, {1, 2}})->Iterations(1);
BENCHMARK(frames)->Arg(100'000)->Arg(500'000)->Iterations(1);
BENCHMARK(beside_cgal)->Arg(1)->Arg(10)->Iterations(1);

}  // namespace
}  // namespace supple::bench
