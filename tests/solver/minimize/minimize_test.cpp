#include "solver/minimize/minimize.h"

#include <Eigen/Geometry>
#include <limits>

#include <gtest/gtest.h>

#include "solver/energy/handle.h"
#include "solver/energy/rigidity.h"
#include "solver/energy/volume.h"
#include "solver/field/supports.h"
#include "tests/support/lattice.h"

namespace supple {
namespace {

/// A bar along z, held at its foot, its head moved and turned.
class Bar {
 public:
  Bar(double spacing, const Vec3& by, double degrees)
      : particles_(lattice_particles({0.25, 0.25, 1}, spacing)),
        field_(particles_.positions,
               choose_supports(particles_.positions, spacing, particles_.positions).radii),
        quadrature_(
            sample_field(field_, particles_.positions, SampleContent::values_and_gradients)),
        handles_(sample_field(field_, ends(), SampleContent::values)),
        targets_(ends_moved(by, degrees)),
        handle_energy_(targets_),
        energy_(particles_.size()) {
    energy_.add(handle_energy_, handles_, handle_weights(), 1e4);
    energy_.add(rigidity_, quadrature_, particles_.volumes / particles_.volumes.sum(), 1);
    energy_.add(volume_, quadrature_, particles_.volumes / particles_.volumes.sum(), 1);
  }

  const EnergySum& energy() const { return energy_; }
  const Samples& handles() const { return handles_; }
  const Points& targets() const { return targets_; }
  Eigen::VectorXd handle_weights() const {
    return Eigen::VectorXd::Constant(handles_.size(), 1.0 / double(handles_.size()));
  }

  /// The farthest that a handle is from its target.
  double miss(const Points& u) const {
    double most = 0;
    for (Index k = 0; k < handles_.size(); ++k)
      most = std::max(most, (handles_.position(k, u) - targets_.row(k).transpose()).norm());
    return most;
  }

 private:
  static Points ends() {
    Points points(18, 3);
    Index row = 0;
    for (const double z : {0.0, 1.0})
      for (int x = 0; x < 3; ++x)
        for (int y = 0; y < 3; ++y) points.row(row++) << 0.125 * x, 0.125 * y, z;
    return points;
  }

  static Points ends_moved(const Vec3& by, double degrees) {
    Points points = ends();
    const Vec3 center(0.125, 0.125, 1);
    const Mat3 R = Eigen::AngleAxisd(degrees * EIGEN_PI / 180, Vec3(1, 1, 1).normalized()).matrix();
    for (Index k = 9; k < 18; ++k)
      points.row(k) = (center + R * (points.row(k).transpose() - center) + by).transpose();
    return points;
  }

  Particles particles_;
  MovingLeastSquares<3> field_;
  Samples quadrature_, handles_;
  Points targets_;
  HandleEnergy handle_energy_;
  RigidityEnergy rigidity_;
  VolumeEnergy volume_;
  EnergySum energy_;
};

double total(const Report& report) {
  double sum = 0;
  for (const auto& [name, value] : report.energies) sum += value;
  return sum;
}

TEST(Minimize, TrustRegionAndLbfgsAgreeOnTenPoses) {
  Random random(4);
  for (int pose = 0; pose < 10; ++pose) {
    const Bar bar(0.09, random.in_cube(-0.25, 0.25), random.uniform(-60, 60));
    const Preconditioner preconditioner(bar.energy());
    Points a = Points::Zero(bar.energy().particles(), 3), b = a;
    MinimizeOptions options;
    options.tolerance = 1e-7;
    const Report lbfgs = minimize(bar.energy(), preconditioner, options, a);
    options.kind = MinimizerKind::trust_region;
    options.tolerance = 1e-9;
    const Report reference = minimize(bar.energy(), preconditioner, options, b);
    EXPECT_EQ(lbfgs.status, Status::ok);
    EXPECT_EQ(reference.status, Status::ok);
    EXPECT_NEAR(total(lbfgs), total(reference), 1e-3 * total(reference)) << "pose " << pose;
  }
}

TEST(Minimize, ServesManyParticlesAsWellAsFew) {
  const Bar bar(0.05, {0.1, 0, 0}, 30);
  ASSERT_GT(bar.energy().particles(), 400);
  const Preconditioner preconditioner(bar.energy());
  Points u = Points::Zero(bar.energy().particles(), 3), gradient;
  const Report report = minimize(bar.energy(), preconditioner, {.tolerance = 1e-8}, u);
  EXPECT_EQ(report.status, Status::ok);
  EXPECT_LT(report.iterations, 300);
  Points start_gradient;
  bar.energy().evaluate(Points::Zero(u.rows(), 3), &start_gradient);
  bar.energy().evaluate(u, &gradient);
  EXPECT_LT(gradient.norm(), 2e-3 * start_gradient.norm());
}

TEST(Minimize, NloptFindsTheSamePose) {
  const Bar bar(0.125, {0.1, 0.05, 0.02}, 30);
  const Preconditioner preconditioner(bar.energy());
  Points a = Points::Zero(bar.energy().particles(), 3), b = a;
  const Report lbfgs = minimize(bar.energy(), preconditioner, {.tolerance = 1e-9}, a);
  const Report nlopt =
      minimize(bar.energy(), preconditioner, {.kind = MinimizerKind::nlopt, .tolerance = 1e-9}, b);
  EXPECT_EQ(lbfgs.status, Status::ok);
  EXPECT_EQ(nlopt.status, Status::ok);
  EXPECT_NEAR(total(nlopt), total(lbfgs), 1e-5 * total(lbfgs));
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 1e-3);
}

/// Both go on from a pose that meets the handles.
TEST(HardConstraints, AreMetExactlyByBothMinimisers) {
  const Bar bar(0.125, {0.1, 0.05, 0.02}, 30);
  const Preconditioner preconditioner(bar.energy());
  const HardConstraints constraints(bar.handles(), bar.handle_weights(), bar.targets(),
                                    preconditioner);
  EXPECT_GT(constraints.tied(), 7);
  EXPECT_EQ(constraints.left_free(), 0);
  Points start = Points::Zero(bar.energy().particles(), 3);
  constraints.meet(bar.targets(), start);
  EXPECT_LT(bar.miss(start), 1e-12);
  Points a = start, b = start;
  const Report lbfgs = minimize(bar.energy(), preconditioner, {.tolerance = 1e-9}, a, &constraints);
  const Report nlopt = minimize(bar.energy(), preconditioner,
                                {.kind = MinimizerKind::nlopt, .tolerance = 1e-9}, b, &constraints);
  EXPECT_EQ(lbfgs.status, Status::ok);
  EXPECT_EQ(nlopt.status, Status::ok);
  EXPECT_LT(bar.miss(a), 1e-12);
  EXPECT_LT(bar.miss(b), 1e-9);
  EXPECT_NEAR(total(nlopt), total(lbfgs), 1e-5 * total(lbfgs));
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(HardConstraints, WhatIsTiedIsForTheTargetsToSay) {
  const Bar bar(0.125, {0.1, 0.05, 0.02}, 30);
  const Preconditioner preconditioner(bar.energy());
  HardConstraints constraints(bar.handles(), bar.handle_weights(), bar.handles().points,
                              preconditioner);
  const Index tied = constraints.tied();
  EXPECT_EQ(constraints.left_free(), 0);  // at rest: rounding contradicts nothing
  Points contradicting = bar.targets();
  contradicting(0, 0) += 0.3;
  constraints.decide(contradicting);
  EXPECT_GT(constraints.left_free(), 0);
  constraints.decide(bar.targets());
  EXPECT_EQ(constraints.tied(), tied);
  Points u = Points::Zero(bar.energy().particles(), 3);
  constraints.meet(bar.targets(), u);
  EXPECT_LT(bar.miss(u), 1e-12);
}

TEST(HardConstraints, TargetsThatContradictEachOtherAreMetInTheMean) {
  const Bar bar(0.125, Vec3::Zero(), 0);
  const Preconditioner preconditioner(bar.energy());
  const Particles particles = lattice_particles({0.25, 0.25, 1}, 0.125);
  const MovingLeastSquares<3> field(
      particles.positions, choose_supports(particles.positions, 0.125, particles.positions).radii);
  Points twice(2, 3);
  twice << 0.1, 0.1, 0.9, 0.1, 0.1, 0.9;
  const Samples samples = sample_field(field, twice, SampleContent::values);
  Points targets = twice;
  targets(0, 0) += 0.1;
  targets(1, 0) += 0.2;
  const HardConstraints constraints(samples, Eigen::Vector2d(0.5, 0.5), targets, preconditioner);
  EXPECT_EQ(constraints.tied(), 1);
  Points u = Points::Zero(particles.size(), 3);
  constraints.meet(targets, u);
  EXPECT_LT((samples.position(0, u) - Vec3(0.25, 0.1, 0.9)).norm(), 1e-12);
}

/// |f − target|², but NaN where f goes beyond a fence on its way there.
class FencedEnergy final : public Energy {
 public:
  std::string_view name() const override { return "fenced"; }
  Argument argument() const override { return Argument::position; }
  int rows() const override { return 3; }
  double stiffness() const override { return 2; }
  void evaluate(const LocalField& at, LocalResidual& out) const override {
    out.r.head<3>() = at.f - Vec3(1, 0, 0);
    if (at.f.x() > 0.5) out.r[0] = std::numeric_limits<double>::quiet_NaN();
    out.jacobian.setZero();
    out.jacobian.topLeftCorner<3, 3>().setIdentity();
  }
};

TEST(Minimize, AnEnergyThatBecomesNaNIsSurvivedAndTold) {
  const Particles particles = lattice_particles({0.25, 0.25, 0.5}, 0.125);
  const MovingLeastSquares<3> field(
      particles.positions, choose_supports(particles.positions, 0.125, particles.positions).radii);
  const Samples samples =
      sample_field(field, particles.positions, SampleContent::values_and_gradients);
  const FencedEnergy fenced;
  const RigidityEnergy rigidity;
  const Eigen::VectorXd weights =
      Eigen::VectorXd::Constant(samples.size(), 1 / double(samples.size()));
  EnergySum energy(particles.size());
  energy.add(fenced, samples, weights, 1);
  energy.add(rigidity, samples, weights, 1);
  const Preconditioner preconditioner(energy);
  for (const MinimizerKind kind :
       {MinimizerKind::lbfgs, MinimizerKind::trust_region, MinimizerKind::nlopt}) {
    Points u = Points::Zero(particles.size(), 3);
    const double before = energy.evaluate(u);
    const Report report =
        minimize(energy, preconditioner, {.kind = kind, .max_iterations = 500}, u);
    EXPECT_TRUE(u.allFinite());
    EXPECT_LE(energy.evaluate(u), before) << static_cast<int>(kind);
    EXPECT_EQ(report.status, Status::degraded);
    ASSERT_FALSE(report.reasons.empty());
    EXPECT_EQ(report.reasons[0].code, ReasonCode::not_finite);
  }
}

TEST(Minimize, DoesNothingAtAMinimum) {
  const Bar bar(0.12, Vec3::Zero(), 0);
  const Preconditioner preconditioner(bar.energy());
  Points u = Points::Zero(bar.energy().particles(), 3);
  const Report report = minimize(bar.energy(), preconditioner, {}, u);
  EXPECT_EQ(report.status, Status::ok);
  EXPECT_LE(report.iterations, 1);
  EXPECT_EQ(u.norm(), 0);
}

TEST(Minimize, ReportsTheIterationLimit) {
  const Bar bar(0.12, {0.3, 0, 0}, 90);
  const Preconditioner preconditioner(bar.energy());
  Points u = Points::Zero(bar.energy().particles(), 3);
  const Report report = minimize(bar.energy(), preconditioner, {.max_iterations = 2}, u);
  EXPECT_EQ(report.status, Status::degraded);
  ASSERT_FALSE(report.reasons.empty());
  EXPECT_EQ(report.reasons[0].code, ReasonCode::max_iterations);
}

TEST(Minimize, FailsOnAStartThatIsNotFinite) {
  const Bar bar(0.12, {0.3, 0, 0}, 0);
  const Preconditioner preconditioner(bar.energy());
  Points u = Points::Zero(bar.energy().particles(), 3);
  u(0, 0) = std::numeric_limits<double>::quiet_NaN();
  const Report report = minimize(bar.energy(), preconditioner, {}, u);
  EXPECT_EQ(report.status, Status::failed);
}

TEST(Report, IsBornNotRun) {
  EXPECT_EQ(Report().status, Status::not_run);
}

}  // namespace
}  // namespace supple
