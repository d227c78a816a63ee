#include <functional>
#include <numeric>

#include "modeler/pose/pose_solver.h"
#include "solver/field/supports.h"
#include "tests/cases/cases.h"
#include "tests/support/lattice.h"

namespace supple {
namespace {

/// A bar of 64 particles whose ends are held where they are: its pose is its rest, whatever state
/// the solve starts from.
class HeldBar {
 public:
  HeldBar()
      : particles_(lattice_particles({1, 1, 1}, 0.25)),
        field_(
            particles_.positions,
            choose_supports(particles_.positions, particles_.spacing, particles_.positions).radii),
        quadrature_(
            sample_field(field_, particles_.positions, SampleContent::values_and_gradients)),
        ends_(point_samples(ends(), Eigen::VectorXd::Ones(32))),
        handles_(ends_held()),
        solver_(field_, quadrature_, particles_.volumes, handles_, {}) {}

  const Points& positions() const { return particles_.positions; }

  /// Whether a solve from there ends at rest: min J > 0.9, rigidity < 1e-2.
  bool recovers_from(Points u) {
    const Report report = solver_.solve(
        {}, [](double) {}, u);
    double rigidity = 1;
    for (const auto& [name, value] : report.energies)
      if (name == "rigidity") rigidity = value;
    return count_inversions(quadrature_, u).min_det_F > 0.9 && rigidity < 1e-2;
  }

 private:
  static Points ends() {
    Points points(32, 3);
    Index row = 0;
    for (const double z : {0.0, 1.0})
      for (int x = 0; x < 4; ++x)
        for (int y = 0; y < 4; ++y) points.row(row++) << 0.125 + 0.25 * x, 0.125 + 0.25 * y, z;
    return points;
  }

  std::vector<PoseHandle> ends_held() {
    PoseHandle handle;
    handle.spec = &spec_;
    handle.samples = &ends_;
    handle.selected.resize(32);
    std::iota(handle.selected.begin(), handle.selected.end(), 0);
    handle.thinned = {handle.selected, ends_.areas};
    return {handle};
  }

  HandleSpec spec_;
  Particles particles_;
  MovingLeastSquares<3> field_;
  Samples quadrature_;
  SurfaceSamples ends_;
  HandleSamples handles_;
  PoseSolver solver_;
};

/// Share of `seeds` starts that end at rest; `place` says where a particle starts.
double recovered(int seeds, const std::function<Vec3(const Vec3& rest, Random& random)>& place) {
  HeldBar bar;
  int count = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed) + 1);
    Points u(bar.positions().rows(), 3);
    for (Index i = 0; i < u.rows(); ++i) {
      const Vec3 rest = bar.positions().row(i).transpose();
      u.row(i) = (place(rest, random) - rest).transpose();
    }
    if (bar.recovers_from(u)) ++count;
  }
  return static_cast<double>(count) / seeds;
}

/// `keep` 1 for the axes that are not pressed to 1/2.
double recovered_from_pressed(const Vec3& keep, double jitter) {
  const Vec3 middle = Vec3::Constant(0.5);
  return recovered(10, [&](const Vec3& rest, Random& random) -> Vec3 {
    return middle + keep.cwiseProduct(rest - middle) + random.in_cube(-jitter, jitter);
  });
}

void measure_flattened(Figures& figures) {
  figures["exactly"] = recovered_from_pressed({1, 0, 1}, 0);
  figures["jitter_1e_6"] = recovered_from_pressed({1, 0, 1}, 1e-6);
  figures["jitter_1e_2"] = recovered_from_pressed({1, 0, 1}, 1e-2);
}

void measure_collapsed(Figures& figures) {
  figures["line"] = recovered_from_pressed({0, 0, 1}, 0);
  figures["point"] = recovered_from_pressed({0, 0, 0}, 0);
}

void measure_random(Figures& figures) {
  for (const auto& [name, size] : {std::pair{"in_the_box", 1.0}, {"in_10_boxes", 10.0}})
    figures[name] = recovered(20, [&, size = size](const Vec3&, Random& random) -> Vec3 {
      return Vec3::Constant(0.5) + size * random.in_cube(-0.5, 0.5);
    });
}

void measure_mirrored(Figures& figures) {
  figures["mirrored"] = recovered(20, [](const Vec3& rest, Random& random) -> Vec3 {
    return Vec3(1 - rest.x(), rest.y(), rest.z()) + random.in_cube(-1e-3, 1e-3);
  });
}

constexpr Case cases[] = {{"C8", measure_flattened},
                          {"C9", measure_collapsed},
                          {"C10", measure_random},
                          {"C11", measure_mirrored}};

}  // namespace

std::span<const Case> destroyed_start_cases() {
  return cases;
}

}  // namespace supple
