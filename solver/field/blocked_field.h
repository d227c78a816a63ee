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

/// Points in single precision, as what draws them takes them, n×3.
using FloatPoints = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

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
  /// The same in single precision throughout, which reads and writes half as much.
  void displace(const RigidMotion& rigid, const ParticleValues<3>& d, FloatPoints& out) const;

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
  using Lanes = Eigen::Array<float, lanes, 1>;

  /// Some consecutive blocks, built by one thread; members as below.
  struct Chunk {
    std::vector<int> block_starts{0}, particles;
    std::vector<float> weights, slopes;
    std::vector<Samples::ShortSpan> short_spans;
    Index entries = 0;
    long uncovered = 0, rank_lost = 0;
  };

  Chunk build_chunk(const MovingLeastSquares<3>& field, const Points& points, Index first_block,
                    Index last_block) const;
  static void add_block(const Samples& rows, Chunk& chunk);
  void join(std::vector<Chunk>& chunks);

  /// Block by block: add(entry, particle, lane, sums) for all its entries and some lanes
  /// from that one on, sums born zero; then store(sums, block), with [sum][lane] floats.
  template <std::size_t Sums, class Add, class Store>
  void for_each_block(const Add& add, const Store& store) const;
  template <std::size_t Sums, int Width, class Add>
  auto sum_entries(std::size_t block, int lane, const Add& add) const;

  /// As above, where the sums are a matrix that comes on top of the rigid motion's.
  template <class Add>
  void sum_gradients(const RigidMotion& rigid, const Add& add, std::vector<Mat3>& out) const;

  Index size_ = 0;
  std::vector<int> order_;            ///< the point in each lane of each block; −1 pads
  bool own_order_ = false;            ///< lanes hold points in the points' own order
  std::vector<Vec3> rest_;            ///< the lanes' points at rest
  std::vector<float> rest_lanes_;     ///< the same, [block][axis][lane]
  std::vector<int> block_starts_{0};  ///< blocks+1 offsets into particles_
  std::vector<int> particles_;
  std::vector<float> weights_;                   ///< [entry][lane] φ
  std::vector<float> slopes_;                    ///< [entry][axis][lane] ∇φ
  std::vector<Samples::ShortSpan> short_spans_;  ///< of points whose particles do not span space
  Index entries_ = 0;
  long uncovered_ = 0, rank_lost_ = 0;
};

}  // namespace supple
