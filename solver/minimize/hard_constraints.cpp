#include "solver/minimize/hard_constraints.h"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "solver/core/check.h"

namespace supple {
namespace {

/// Singular values below this share of the greatest are rounding.
constexpr double no_rank = 1e-10;

/// Where targets contradict each other, directions below this share would be driven to large
/// displacements to follow both as well as they can.
constexpr double contradicted_rank = 0.1;

/// What no displacements can meet, over how far the targets move; ways below a share of the size
/// contradict nothing.
constexpr double contradiction = 1e-6, no_way = 1e-6;

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
    : samples_(samples),
      preconditioner_(preconditioner),
      particles_(particles_of(samples)),
      roots_(weights.cwiseSqrt()) {
  SUPPLE_CHECK(weights.size() == samples.size(), "one weight a sample");
  // Of many more rows than columns: those of R have the same σ and V.
  const Eigen::HouseholderQR<Eigen::MatrixXd> rows(weighted_rows(samples, roots_, particles_));
  const Index square = std::min(rows.rows(), rows.cols());
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(
      Eigen::MatrixXd(rows.matrixQR().topRows(square).triangularView<Eigen::Upper>()),
      Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Index rank = (svd.singularValues().array() > no_rank * svd.singularValues()[0]).count();
  sigma_ = svd.singularValues().head(rank);
  V_ = svd.matrixV().leftCols(rank);
  Eigen::MatrixXd U = Eigen::MatrixXd::Zero(samples.size(), rank);
  U.topRows(square) = svd.matrixU().leftCols(rank);
  U.applyOnTheLeft(rows.householderQ());
  from_places_ = U.transpose() * roots_.asDiagonal();
  decide(targets);
}

void HardConstraints::decide(const Points& targets) {
  const Points way = targets - samples_.points;
  const double squared = (roots_.asDiagonal() * way).squaredNorm();
  const double met = (from_places_ * way).squaredNorm();
  const double size = (roots_.asDiagonal() * samples_.points).norm();
  const double missed = std::sqrt(std::max(0.0, squared - met));
  const bool contradict = missed > contradiction * std::max(std::sqrt(squared), no_way * size);
  tie(contradict ? (sigma_.array() > contradicted_rank * sigma_[0]).count() : sigma_.size());
}

void HardConstraints::tie(Index count) {
  if (count == tied()) return;
  left_free_ = sigma_.size() - count;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(rows_by_unknowns(count));
  Q_ = qr.householderQ() * Eigen::MatrixXd::Identity(preconditioner_.particles(), count);
  R_ = qr.matrixQR().topRows(count).triangularView<Eigen::Upper>();
}

/// L⁻¹ P V: what y has to do with the tied directions.
Eigen::MatrixXd HardConstraints::rows_by_unknowns(Index tied) const {
  Eigen::MatrixXd rows(preconditioner_.particles(), tied);
  for (Index first = 0; first < tied; first += 3) {
    const Index count = std::min<Index>(3, tied - first);
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
  const Points wanted = sigma_.head(tied()).cwiseInverse().asDiagonal() *
                        (from_places_.topRows(tied()) * (targets - samples_.points));
  const Points missing = wanted - V_.leftCols(tied()).transpose() * u(particles_, Eigen::all);
  Points y = Q_ * R_.transpose().triangularView<Eigen::Lower>().solve(missing);
  preconditioner_.to_displacements(y);
  u += y;
}

}  // namespace supple
