#include "tests/bench/references/trust_region.h"

#include <Eigen/Geometry>

#include <ceres/cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

namespace supple::bench {
namespace {

using Row = Eigen::Matrix<double, 1, 9>;

/// What the costs of one sample share: its row, and the unknowns in it.
class SampleCost : public ceres::CostFunction {
 public:
  SampleCost(const Samples& samples, Index sample, int residuals)
      : samples_(samples), sample_(sample) {
    set_num_residuals(residuals);
    for (int at = samples.row_begin(sample); at < samples.row_end(sample); ++at)
      mutable_parameter_block_sizes()->push_back(3);
  }

 protected:
  std::size_t blocks() const { return parameter_block_sizes().size(); }
  std::size_t entry(std::size_t j) const {
    return static_cast<std::size_t>(samples_.row_begin(sample_)) + j;
  }

  const Samples& samples_;
  const Index sample_;
};

class HandleCost final : public SampleCost {
 public:
  HandleCost(const Samples& samples, Index sample, const Points& targets, double factor)
      : SampleCost(samples, sample, 3), targets_(targets), factor_(factor) {}

  bool Evaluate(double const* const* u, double* residuals, double** jacobians) const override {
    Vec3 f = samples_.points.row(sample_).transpose();
    for (std::size_t j = 0; j < blocks(); ++j)
      f += samples_.values[entry(j)] * Eigen::Map<const Vec3>(u[j]);
    Eigen::Map<Vec3> r(residuals);
    r = factor_ * (f - targets_.row(sample_).transpose());
    for (std::size_t j = 0; jacobians && j < blocks(); ++j) {
      if (!jacobians[j]) continue;
      Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> by_u(jacobians[j]);
      by_u = factor_ * samples_.values[entry(j)] * Mat3::Identity();
    }
    return true;
  }

 private:
  const Points& targets_;
  const double factor_;
};

/// √2λ2V·(the six entries of FᵀF − I) and √2λ3V·(det F − 1).
class ShapeCost final : public SampleCost {
 public:
  ShapeCost(const Samples& samples, Index sample, double rigidity, double volume)
      : SampleCost(samples, sample, volume > 0 ? 7 : 6), rigidity_(rigidity), volume_(volume) {}

  bool Evaluate(double const* const* u, double* residuals, double** jacobians) const override {
    Mat3 F = Mat3::Identity();
    for (std::size_t j = 0; j < blocks(); ++j)
      F += Eigen::Map<const Vec3>(u[j]) * samples_.gradients[entry(j)].transpose();
    Row by_F[7];
    int row = 0;
    for (int a = 0; a < 3; ++a)
      for (int b = a; b < 3; ++b, ++row) {
        const double factor = rigidity_ * (a == b ? 1 : std::sqrt(2.0));
        residuals[row] = factor * (F.col(a).dot(F.col(b)) - (a == b ? 1 : 0));
        by_F[row].setZero();
        for (int i = 0; i < 3; ++i) {
          by_F[row][3 * i + a] += factor * F(i, b);
          by_F[row][3 * i + b] += factor * F(i, a);
        }
      }
    if (volume_ > 0) {
      const Vec3 a = F.row(0), b = F.row(1), c = F.row(2);
      residuals[6] = volume_ * (a.dot(b.cross(c)) - 1);
      by_F[6] << volume_ * b.cross(c).transpose(), volume_ * c.cross(a).transpose(),
          volume_ * a.cross(b).transpose();
    }
    for (std::size_t j = 0; jacobians && j < blocks(); ++j)
      if (jacobians[j])
        for (int k = 0; k < num_residuals(); ++k)
          for (int a = 0; a < 3; ++a)
            jacobians[j][3 * k + a] = by_F[k].segment<3>(3 * a).dot(samples_.gradients[entry(j)]);
    return true;
  }

 private:
  const double rigidity_, volume_;
};

std::vector<double*> blocks_of(const Samples& samples, Index k, Points& u) {
  std::vector<double*> blocks;
  for (int at = samples.row_begin(k); at < samples.row_end(k); ++at)
    blocks.push_back(u.row(samples.particles[static_cast<std::size_t>(at)]).data());
  return blocks;
}

}  // namespace

struct TrustRegion::Implementation {
  Points u, targets;
  ceres::Problem problem;
  int iterations = 0;
};

TrustRegion::TrustRegion(const DragProblem& problem)
    : implementation_(std::make_unique<Implementation>()) {
  Implementation& here = *implementation_;
  here.u = Points::Zero(problem.particles, 3);
  here.targets = problem.handles->points;
  // Ceres halves the squares.
  for (Index k = 0; k < problem.handles->size(); ++k)
    here.problem.AddResidualBlock(
        new HandleCost(*problem.handles, k, here.targets,
                       std::sqrt(2 * problem.handle * problem.handle_weights[k])),
        nullptr, blocks_of(*problem.handles, k, here.u));
  for (Index k = 0; k < problem.quadrature->size(); ++k)
    here.problem.AddResidualBlock(
        new ShapeCost(*problem.quadrature, k, std::sqrt(2 * problem.rigidity * problem.volumes[k]),
                      std::sqrt(2 * problem.volume * problem.volumes[k])),
        nullptr, blocks_of(*problem.quadrature, k, here.u));
}

TrustRegion::~TrustRegion() = default;

double TrustRegion::solve(const Points& targets, double tolerance) {
  implementation_->targets = targets;
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 500;
  options.function_tolerance = tolerance;
  options.gradient_tolerance = 1e-14;
  options.parameter_tolerance = 0;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &implementation_->problem, &summary);
  implementation_->iterations = static_cast<int>(summary.iterations.size()) - 1;
  return summary.final_cost;
}

int TrustRegion::iterations() const {
  return implementation_->iterations;
}

}  // namespace supple::bench
