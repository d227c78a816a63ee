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

  /// R + Σ d_j ∇φ_jᵀ: the deformation gradient of displace(), a 3×3 matrix a point, row by row.
  void displace_gradients(const RigidMotion& rigid, const ParticleValues<3>& d,
                          std::vector<Mat3>& out) const;

  /// R + Σ φ_j B_j: the first-order deformation gradient of blend().
  void blend_gradients(const RigidMotion& rigid, const ParticleValues<12>& maps,
                       std::vector<Mat3>& out) const;

  Index size() const { return size_; }
  long uncovered() const;
  long rank_lost() const;

  /// Numbers stored for one value of φ at every point, without and with padding.
  Index entries() const;
  Index padded_entries() const;

 private:
  using Lanes = Eigen::Array<float, lanes, 1>;

  /// Some consecutive blocks, built and walked by one thread.
  struct Chunk {
    Index first_block = 0;
    std::vector<int> block_starts{0};  ///< blocks+1 offsets into particles
    std::vector<int> particles;
    std::vector<float> weights;  ///< [entry][lane] φ
    std::vector<float> slopes;   ///< [entry][axis][lane] ∇φ
    Index entries = 0;
    long uncovered = 0, rank_lost = 0;
  };

  Chunk build_chunk(const MovingLeastSquares<3>& field, const Points& points, Index first_block,
                    Index last_block) const;
  static void add_block(const Samples& rows, Chunk& chunk);

  /// Block by block: add(chunk, entry, particle, sums) for all its entries, sums born zero, and
  /// then store(sums, lane, point, rest) for its points.
  template <std::size_t Sums, class Add, class Store>
  void for_each_block(const Add& add, const Store& store) const;

  /// As above, where the sums are a matrix that comes on top of the rigid motion's.
  template <class Add>
  void sum_gradients(const RigidMotion& rigid, const Add& add, std::vector<Mat3>& out) const;

  Index size_ = 0;
  std::vector<int> order_;  ///< the point in each lane of each block; −1 pads
  std::vector<Vec3> rest_;  ///< the lanes' points at rest
  std::vector<Chunk> chunks_;
};

}  // namespace supple
