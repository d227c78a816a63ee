#include "solver/minimize/hard_constraints.h"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>

#include "solver/core/check.h"

namespace supple {
namespace {

/// Singular values below this share of the greatest are rounding.
constexpr double no_rank = 1e-10;

/// Where targets contradict each other, directions below this share would be driven to large
/// displacements to follow both as well as they can.
constexpr double contradicted_rank = 0.1;

/// What no displacements can meet, over how far the targets move.
constexpr double contradiction = 1e-6;

std::vector<int> particles_of(const Samples& samples) {
  std::vector<int> particles = samples.particles;
  std::sort(particles.begin(), particles.end());
  particles.erase(std::unique(particles.begin(), particles.end()), particles.end());
  return particles;
}

/// √W Φ over the particles that the samples feel.
Eigen::MatrixXd weighted_rows(const Samples& samples, const Eigen::VectorXd& roots,
                              const std::vector<int>& particles) {
  Eigen::MatrixXd rows =
      Eigen::MatrixXd::Zero(samples.size(), static_cast<Index>(particles.size()));
  for (Index k = 0; k < samples.size(); ++k)
    for (int at = samples.row_begin(k); at < samples.row_end(k); ++at) {
      const auto entry = static_cast<std::size_t>(at);
      const auto place =
          std::lower_bound(particles.begin(), particles.end(), samples.particles[entry]);
      rows(k, place - particles.begin()) = roots[k] * samples.values[entry];
    }
  return rows;
}

}  // namespace

HardConstraints::HardConstraints(const Samples& samples, const Eigen::VectorXd& weights,
                                 const Points& targets, const Preconditioner& preconditioner)
    : samples_(samples), preconditioner_(preconditioner), particles_(particles_of(samples)) {
  SUPPLE_CHECK(weights.size() == samples.size(), "one weight a sample");
  const Eigen::VectorXd roots = weights.cwiseSqrt();
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(weighted_rows(samples, roots, particles_),
                                           Eigen::ComputeThinU | Eigen::ComputeThinV);
  const auto above = [&](double share) {
    return (svd.singularValues().array() > share * svd.singularValues()[0]).count();
  };
  const Eigen::MatrixXd way = roots.asDiagonal() * (targets - samples.points);
  const auto U = svd.matrixU().leftCols(above(no_rank));
  const double missed = (way - U * (U.transpose() * way)).norm();
  const Index tied =
      missed > contradiction * way.norm() ? above(contradicted_rank) : above(no_rank);
  left_free_ = above(no_rank) - tied;
  V_ = svd.matrixV().leftCols(tied);
  from_places_ = svd.singularValues().head(tied).cwiseInverse().asDiagonal() *
                 svd.matrixU().leftCols(tied).transpose() * roots.asDiagonal();

  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(rows_by_unknowns());
  Q_ = qr.householderQ() * Eigen::MatrixXd::Identity(preconditioner.particles(), V_.cols());
  R_ = qr.matrixQR().topRows(V_.cols()).triangularView<Eigen::Upper>();
}

/// L⁻¹ P V: what y has to do with the tied directions.
Eigen::MatrixXd HardConstraints::rows_by_unknowns() const {
  Eigen::MatrixXd rows(preconditioner_.particles(), V_.cols());
  for (Index first = 0; first < V_.cols(); first += 3) {
    const Index count = std::min<Index>(3, V_.cols() - first);
    Points columns = Points::Zero(rows.rows(), 3);
    for (std::size_t i = 0; i < particles_.size(); ++i)
      columns.row(particles_[i]).leftCols(count) =
          V_.row(static_cast<Index>(i)).segment(first, count);
    preconditioner_.to_gradient(columns);
    rows.middleCols(first, count) = columns.leftCols(count);
  }
  return rows;
}

void HardConstraints::project(PaddedPoints& y, PaddedPoints& along) const {
  along.setZero(tied(), 4);
  for (Index i = 0; i < Q_.rows(); ++i)
    for (Index j = 0; j < Q_.cols(); ++j) along.row(j) += Q_(i, j) * y.row(i);
  for (Index i = 0; i < Q_.rows(); ++i) {
    Eigen::RowVector4d sum = Eigen::RowVector4d::Zero();
    for (Index j = 0; j < Q_.cols(); ++j) sum += Q_(i, j) * along.row(j);
    y.row(i) -= sum;
  }
}

void HardConstraints::meet(const Points& targets, Points& u) const {
  const Points wanted = from_places_ * (targets - samples_.points);
  const Points missing = wanted - V_.transpose() * u(particles_, Eigen::all);
  Points y = Q_ * R_.transpose().triangularView<Eigen::Lower>().solve(missing);
  preconditioner_.to_displacements(y);
  u += y;
}

}  // namespace supple
