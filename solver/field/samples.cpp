#include "solver/field/samples.h"

#include <Eigen/LU>
#include <algorithm>

#include "solver/core/check.h"
#include "solver/core/parallel.h"

namespace supple {
namespace {

constexpr Index points_per_chunk = 256;

/// Rows of one chunk of points, before all chunks are put together.
struct Chunk {
  std::vector<int> row_sizes;
  std::vector<int> particles;
  std::vector<double> values;
  std::vector<Vec3> gradients;
  std::vector<Samples::ShortSpan> short_spans;
  long uncovered = 0, rank_lost = 0;
};

/// The share of ∇φ_j in the gradients of a short span: 1 where all is kept, 0 from one half on.
double share_of_full_gradient(double least_share) {
  const double t = std::max(0.0, 2 * least_share - 1);
  return t * t * (3 - 2 * t);
}

/// g_j + b (∇φ_j − Qᵀ P⁻¹ g_j), with the fit's gradients g_j, Q = Σ x_j ∇φ_jᵀ and P = Σ x_j g_jᵀ:
/// they carry P of an affine map whatever b is. Takes ∇φ_j and g_j; b = 0 where P has no inverse.
void blend_gradients(const MovingLeastSquares<3>& field, const Vec3& x, const Span& span,
                     const ShapeFunctions<3>& full, ShapeFunctions<3>& fitted) {
  const double b = share_of_full_gradient(span.shares.minCoeff());
  if (b == 0) return;
  Mat3 Q = Mat3::Zero();
  for (std::size_t j = 0; j < full.particles.size(); ++j)
    Q += (field.positions().row(full.particles[j]).transpose() - x) *
         full.gradients.row(static_cast<Index>(j));
  const Mat3 over_P = span.axes * span.shares.cwiseInverse().asDiagonal() * span.axes.transpose();
  const Mat3 correction = b * over_P * Q;
  fitted.gradients += b * full.gradients - fitted.gradients * correction;
}

Span span_of(const ShapeFunctions<3>& at_x) {
  Span span{at_x.axes, at_x.shares};
  if (span.axes.determinant() < 0) span.axes.col(2) *= -1;
  return span;
}

/// Gradients that carry turns also where the particles near x do not span space; returns the span.
Span gradients_at(const MovingLeastSquares<3>& field, const Vec3& x, ShapeFunctions<3>& at_x) {
  field.evaluate(x, Derivatives::first, at_x);
  if (!at_x.covered()) return {};
  const Span span = span_of(at_x);
  if (span.full()) return span;
  ShapeFunctions<3> fitted;
  field.evaluate_fitted(x, fitted);
  if (field.options().gradient == GradientKind::full) blend_gradients(field, x, span, at_x, fitted);
  at_x.gradients = fitted.gradients;
  return span;
}

/// φ_j(x) ≈ φ_j(x_p) + ∇φ_j(x_p)·(x − x_p) with p the particle nearest to x: keeps the sum 1 and
/// affine fields exact.
Span extrapolate(const MovingLeastSquares<3>& field, const Vec3& x, ShapeFunctions<3>& at_x) {
  const int nearest = field.neighbors().nearest(x, 1).front();
  const Vec3 from = field.positions().row(nearest).transpose();
  const Span span = gradients_at(field, from, at_x);
  at_x.values += at_x.gradients * (x - from);
  return span;
}

void append_row(const MovingLeastSquares<3>& field, const Vec3& x, SampleContent content,
                ShapeFunctions<3>& at_x, Chunk& chunk) {
  const bool wants_gradients = content == SampleContent::values_and_gradients;
  Span span;
  if (wants_gradients)
    span = gradients_at(field, x, at_x);
  else
    field.evaluate(x, Derivatives::none, at_x);
  if (!at_x.covered()) {
    ++chunk.uncovered;
    span = extrapolate(field, x, at_x);
  } else if (at_x.rank < MovingLeastSquares<3>::basis_size(field.options().order)) {
    ++chunk.rank_lost;
  }
  if (wants_gradients && !span.full())
    chunk.short_spans.push_back({static_cast<Index>(chunk.row_sizes.size()), span});
  chunk.row_sizes.push_back(static_cast<int>(at_x.particles.size()));
  chunk.particles.insert(chunk.particles.end(), at_x.particles.begin(), at_x.particles.end());
  chunk.values.insert(chunk.values.end(), at_x.values.begin(), at_x.values.end());
  if (!wants_gradients) return;
  for (Index j = 0; j < at_x.gradients.rows(); ++j)
    chunk.gradients.push_back(at_x.gradients.row(j).transpose());
}

}  // namespace

Vec3 Samples::displacement(Index k, const Points& u) const {
  Vec3 sum = Vec3::Zero();
  for (int at = row_begin(k); at < row_end(k); ++at)
    sum += values[static_cast<std::size_t>(at)] *
           u.row(particles[static_cast<std::size_t>(at)]).transpose();
  return sum;
}

std::optional<Completion> Samples::completion(Index k, const Mat3& plain) const {
  const auto found =
      std::lower_bound(short_spans.begin(), short_spans.end(), k,
                       [](const ShortSpan& at, Index sample) { return at.sample < sample; });
  if (found == short_spans.end() || found->sample != k) return std::nullopt;
  return Completion(plain - found->span.missing(), found->span);
}

Mat3 Samples::deformation_gradient(Index k, const Points& u) const {
  const Mat3 plain = plain_gradient(k, u);
  const std::optional<Completion> completed = completion(k, plain);
  return completed ? completed->F() : plain;
}

Mat3 Samples::plain_gradient(Index k, const Points& u) const {
  Mat3 F = Mat3::Identity();
  for (int at = row_begin(k); at < row_end(k); ++at)
    F += u.row(particles[static_cast<std::size_t>(at)]).transpose() *
         gradients[static_cast<std::size_t>(at)].transpose();
  return F;
}

Samples sample_field(const MovingLeastSquares<3>& field, const Points& points,
                     SampleContent content) {
  const Index chunk_count = (points.rows() + points_per_chunk - 1) / points_per_chunk;
  std::vector<Chunk> chunks(static_cast<std::size_t>(chunk_count));
  parallel_chunks(points.rows(), points_per_chunk, [&](Index begin, Index end) {
    Chunk& chunk = chunks[static_cast<std::size_t>(begin / points_per_chunk)];
    ShapeFunctions<3> at_x;
    for (Index k = begin; k < end; ++k)
      append_row(field, points.row(k).transpose(), content, at_x, chunk);
  });

  Samples samples;
  samples.points = points;
  std::size_t entries = 0;
  for (const Chunk& chunk : chunks) entries += chunk.particles.size();
  samples.row_starts.reserve(static_cast<std::size_t>(points.rows()) + 1);
  samples.particles.reserve(entries);
  samples.values.reserve(entries);
  if (content == SampleContent::values_and_gradients) samples.gradients.reserve(entries);
  for (const Chunk& chunk : chunks) {
    const Index first = static_cast<Index>(samples.row_starts.size()) - 1;
    for (const Samples::ShortSpan& at : chunk.short_spans)
      samples.short_spans.push_back({first + at.sample, at.span});
    for (const int size : chunk.row_sizes)
      samples.row_starts.push_back(samples.row_starts.back() + size);
    const auto append = [](auto& to, const auto& from) {
      to.insert(to.end(), from.begin(), from.end());
    };
    append(samples.particles, chunk.particles);
    append(samples.values, chunk.values);
    append(samples.gradients, chunk.gradients);
    samples.uncovered += chunk.uncovered;
    samples.rank_lost += chunk.rank_lost;
  }
  return samples;
}

InversionCount count_inversions(const Samples& samples, const Points& u) {
  SUPPLE_CHECK(samples.gradients.size() == samples.particles.size(), "gradients were sampled");
  InversionCount count;
  for (Index k = 0; k < samples.size(); ++k) {
    const double J = samples.deformation_gradient(k, u).determinant();
    if (k == 0 || J < count.min_det_F) {
      count.min_det_F = J;
      count.worst = samples.points.row(k).transpose();
    }
    if (!(J > 0)) ++count.inverted;
  }
  return count;
}

}  // namespace supple
