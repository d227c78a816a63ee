#pragma once

#include <vector>

#include "io/scene/pose_spec.h"
#include "solver/field/blocked_field.h"
#include "solver/field/samples.h"

namespace supple {

/// A deformed surface: its vertices and the deformation gradient at each.
struct DeformedSurface {
  Points positions;             ///< [m], n×3
  std::vector<Mat3> gradients;  ///< F, n
};

/// Vertices tied to a field once, so that they follow the particles of every frame.
///
/// SurfaceKind::field evaluates the moving least squares field at the vertex, f(x) = x + Σ φ_j u_j
/// (Adams & Wicke 2009, section 7.2, alternative 1). SurfaceKind::particle_gradients blends the
/// affine maps of the particles nearby, Σ ω̄_j (f(x_j) + F(x_j)(x − x_j)) (alternative 2, Eq. 68).
class SurfaceEmbedding {
 public:
  /// `quadrature` are samples with gradients whose first ones are at the particles themselves,
  /// in their order; they outlive the embedding.
  SurfaceEmbedding(const MovingLeastSquares<3>& field, const Samples& quadrature,
                   const Points& vertices, SurfaceKind kind);

  /// Follows displacements `u` [m] N×3; `volumes` weigh the particles in the rigid part.
  DeformedSurface deform(const Points& u, const Eigen::VectorXd& volumes) const;

  /// Where a pose's positions go to: x ↦ origin + unit·x.
  struct Frame {
    Vec3 origin = Vec3::Zero();
    double unit = 1;
  };

  /// What positions() needs on the way; held by the caller, so that only the first call allocates.
  struct Scratch {
    Points moved;
    ParticleValues<3> remainder;
    ParticleValues<12> maps;
    Points blended;  ///< of SurfaceKind::particle_gradients
  };

  /// The positions of deform() alone, in `frame` and in single precision.
  void positions(const Points& u, const Eigen::VectorXd& volumes, const Frame& frame,
                 Scratch& scratch, FloatPoints& out) const;

  /// Vertices outside all supports: they follow the nearest particle.
  long uncovered() const { return blocks_.uncovered(); }
  long rank_lost() const { return kind_ == SurfaceKind::field ? blocks_.rank_lost() : 0; }

 private:
  RigidMotion rigid_part(const Points& u, const Eigen::VectorXd& volumes, Points& moved) const;
  /// What the particles do beside the rigid motion, times `unit`: their displacements, or the
  /// affine maps about them.
  void find_remainder(const Points& u, const RigidMotion& rigid, double unit,
                      Scratch& scratch) const;

  SurfaceKind kind_;
  BasisOrder order_;
  const Points particles_;  ///< at rest
  const Samples& quadrature_;
  BlockedField blocks_;
};

}  // namespace supple
