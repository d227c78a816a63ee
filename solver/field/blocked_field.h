#pragma once

#include <array>
#include <vector>

#include "solver/core/export.h"
#include "solver/core/rigid_motion.h"
#include "solver/field/moving_least_squares.h"
#include "solver/field/samples.h"

namespace supple {

/// Values that a blocked field sums over particles: one row a particle, in single precision.
/// Three columns: a displacement. Twelve: an affine map, offset first, then rows of the matrix.
template <int Columns>
using ParticleValues = Eigen::Matrix<float, Eigen::Dynamic, Columns, Eigen::RowMajor>;

/// Shape functions at many points, laid out for speed: blocks of 32 points that lie together
/// share one list of particles, and a block's weights for a particle stand side by side. One
/// evaluation reads every weight once, at the memory's speed.
///
/// Weights are single precision: they sum to 1 ± 1e-7, so a large rigid motion is applied in
/// double precision outside, and weights multiply only what remains.
class SUPPLE_API BlockedField {
 public:
  static constexpr int lanes = 32;

  /// `points` [m] n×3. Points outside all supports follow the particle nearest to them.
  BlockedField(const MovingLeastSquares<3>& field, const Points& points);

  /// R x + t + Σ φ_j d_j [m], n×3.
  void displace(const RigidMotion& rigid, const ParticleValues<3>& d, Points& out) const;

  /// R x + t + Σ φ_j (b_j + B_j x) [m], n×3, with maps {b, B} a particle.
  void blend(const RigidMotion& rigid, const ParticleValues<12>& maps, Points& out) const;

  /// R + Σ d_j ∇φ_jᵀ: the deformation gradient of displace(), a 3×3 matrix a point, row by row;
  /// completed by a rotation where the particles do not span space.
  void displace_gradients(const RigidMotion& rigid, const ParticleValues<3>& d,
                          std::vector<Mat3>& out) const;

  /// R + Σ φ_j B_j: the first-order deformation gradient of blend().
  void blend_gradients(const RigidMotion& rigid, const ParticleValues<12>& maps,
                       std::vector<Mat3>& out) const;

  Index size() const { return size_; }
  long uncovered() const { return uncovered_; }
  long rank_lost() const { return rank_lost_; }

  /// Numbers stored for one value of φ at every point, without and with padding.
  Index entries() const { return entries_; }
  Index padded_entries() const { return static_cast<Index>(weights_.size()); }

 private:
  struct Chunk;
  using Lanes = Eigen::Array<float, lanes, 1>;

  Chunk build_chunk(const MovingLeastSquares<3>& field, const Points& points, Index first_block,
                    Index last_block) const;
  static void add_block(const Samples& rows, Chunk& chunk);
  void append(const Chunk& chunk);
  Index blocks() const { return static_cast<Index>(block_starts_.size()) - 1; }
  template <class Body>
  void for_each_block(const Body& body) const;
  template <class Body>
  void for_each_point(Index block, const Body& body) const;
  void store_gradients(Index block, const RigidMotion& rigid, const std::array<Lanes, 9>& sum,
                       std::vector<Mat3>& out) const;
  const float* entry_weights(int entry) const { return &weights_[std::size_t(entry) * lanes]; }

  Index size_ = 0, entries_ = 0;
  long uncovered_ = 0, rank_lost_ = 0;
  std::vector<int> order_;            ///< the point in each lane of each block; −1 pads
  std::vector<Vec3> rest_;            ///< the lanes' points at rest
  std::vector<int> block_starts_{0};  ///< blocks+1 offsets into particles_
  std::vector<int> particles_;
  std::vector<float> weights_;                   ///< [entry][lane] φ
  std::vector<float> slopes_;                    ///< [entry][axis][lane] ∇φ
  std::vector<Samples::ShortSpan> short_spans_;  ///< of points whose particles do not span space
};

}  // namespace supple
