#pragma once

#include <memory>
#include <vector>

#include "solver/core/export.h"
#include "solver/core/types.h"

namespace supple {

/// One point a row. (Eigen takes a single column only as column-major, which is the same.)
template <int Dim>
using PointsOf =
    Eigen::Matrix<double, Eigen::Dynamic, Dim, Dim == 1 ? Eigen::ColMajor : Eigen::RowMajor>;

template <int Dim>
using VectorOf = Eigen::Matrix<double, Dim, 1>;

/// Finds particles near a point: kd-trees over particles of like reach, so that a few wide
/// supports do not slow the search among many narrow ones.
template <int Dim>
class SUPPLE_API Neighbors {
 public:
  /// `positions` [m] n×Dim; `reaches` [m] n, all positive and finite.
  Neighbors(const PointsOf<Dim>& positions, const Eigen::VectorXd& reaches);
  ~Neighbors();
  Neighbors(Neighbors&&) noexcept;
  Neighbors& operator=(Neighbors&&) noexcept;

  /// Particles i with |x − x_i| < reach_i, ascending.
  void reaching(const VectorOf<Dim>& x, std::vector<int>& particles) const;

  /// Particles i with |x − x_i| < radius [m], ascending, whatever their reach.
  void within(const VectorOf<Dim>& x, double radius, std::vector<int>& particles) const;

  /// The `count` particles nearest to x (fewer where there are fewer), nearest first.
  std::vector<int> nearest(const VectorOf<Dim>& x, int count) const;

 private:
  struct Trees;
  std::unique_ptr<Trees> trees_;
};

}  // namespace supple
