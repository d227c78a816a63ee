#include "modeler/pose/starting_pose.h"

#include <algorithm>

#include "solver/energy/energy_sum.h"
#include "solver/energy/handle.h"
#include "solver/energy/rigidity.h"
#include "solver/minimize/preconditioner.h"

namespace supple {
namespace {

/// Weight of the vertices' mean square miss against that of the gradients.
constexpr double vertex_weight = 1e8;

/// Each takes most of what the regularisation still keeps back.
constexpr int rounds = 8;

/// Vertices closer than this share of the spacing feel the same particles: one of them is enough.
constexpr double vertex_width_over_spacing = 0.125;

/// A fine surface has millions of samples: their rows are built for so many at a time.
constexpr Index points_at_a_time = 16384;

/// The vertices that the fit looks at, each with how many it stands for.
ThinnedSamples vertices_to_fit(const Solid& solid) {
  const Points& vertices = solid.inner_vertices();
  std::vector<int> used;
  for (Index i = 0; i < vertices.rows(); ++i)
    if (solid.used_vertices()[static_cast<std::size_t>(i)]) used.push_back(static_cast<int>(i));
  return thin_samples(point_samples(vertices, Eigen::VectorXd::Ones(vertices.rows())), used,
                      vertex_width_over_spacing * solid.particles().spacing);
}

/// Φᵀ W (y − f(x)) of the samples, N×3.
Points pull(const Samples& samples, const Eigen::VectorXd& weights, const Points& places,
            const Points& u) {
  Points pull = Points::Zero(u.rows(), 3);
  for (Index k = 0; k < samples.size(); ++k) {
    const Vec3 miss = weights[k] * (places.row(k).transpose() - samples.position(k, u));
    for (int at = samples.row_begin(k); at < samples.row_end(k); ++at)
      pull.row(samples.particles[static_cast<std::size_t>(at)]) +=
          samples.values[static_cast<std::size_t>(at)] * miss.transpose();
  }
  return pull;
}

double greatest_miss(const Solid& solid, const SolidField& field, const Points& posed,
                     const Points& u) {
  const Points fitted = field.surface.deform(u, solid.particles().volumes).positions;
  double miss = 0;
  for (Index i = 0; i < posed.rows(); ++i)
    if (solid.used_vertices()[static_cast<std::size_t>(i)])
      miss = std::max(miss, (fitted.row(i) - posed.row(i)).norm());
  return miss;
}

}  // namespace

StartingPose fit_pose(const Solid& solid, const SolidField& field, const Points& posed) {
  const ThinnedSamples chosen = vertices_to_fit(solid);
  const Points rest = solid.inner_vertices()(chosen.indices, Eigen::all);
  const Points places = posed(chosen.indices, Eigen::all);
  const Eigen::VectorXd weights = chosen.areas / chosen.areas.sum();
  const Samples samples = sample_field(field.mls, rest, SampleContent::values);

  const HandleEnergy vertices(places);
  const RigidityEnergy smoothness;
  EnergySum sum(solid.particles().size());
  sum.add(vertices, samples, weights, vertex_weight);
  sum.add(smoothness, field.quadrature, field.points.volumes / field.points.volumes.sum(), 1);
  const Preconditioner normal_matrix(sum);

  const RigidMotion rigid = best_fit_motion(rest, places, weights);
  const Points& particles = solid.particles().positions;
  StartingPose pose;
  pose.u = (particles * rigid.R.transpose()).rowwise() + rigid.t.transpose();
  pose.u -= particles;
  for (int round = 0; round < rounds; ++round) {
    Points change = vertices.stiffness() * vertex_weight * pull(samples, weights, places, pose.u);
    normal_matrix.to_gradient(change);
    normal_matrix.to_displacements(change);
    pose.u += change;
  }
  pose.miss = greatest_miss(solid, field, posed, pose.u);
  return pose;
}

Points carried(const SolidField& field, const Points& points, const Points& u) {
  Points carried(points.rows(), 3);
  for (Index begin = 0; begin < points.rows(); begin += points_at_a_time) {
    const Index count = std::min(points_at_a_time, points.rows() - begin);
    const Samples rows =
        sample_field(field.mls, points.middleRows(begin, count), SampleContent::values);
    for (Index k = 0; k < count; ++k) carried.row(begin + k) = rows.position(k, u).transpose();
  }
  return carried;
}

}  // namespace supple
