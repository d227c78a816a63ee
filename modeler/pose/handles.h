#pragma once

#include <vector>

#include "io/scene/pose_spec.h"
#include "modeler/domain/select.h"
#include "modeler/domain/surface_samples.h"

namespace supple {

/// The way a handle goes, from rest (share 0) to where the user wants it (share 1): scaled and
/// turned about a point, then displaced, all in proportion, so that turns beyond 180° count.
struct HandlePath {
  Vec3 center = Vec3::Zero();  ///< of the scaling
  Vec3 scale = Vec3::Ones();
  Vec3 about = Vec3::Zero();  ///< a point on the turn's axis
  Vec3 axis = Vec3::UnitZ();  ///< unit length
  double radians = 0;
  Vec3 by = Vec3::Zero();

  Vec3 operator()(const Vec3& x, double share) const;
};

/// A handle's surface samples and where they shall go. Lengths are in the same unit as `samples`.
struct PoseHandle {
  const HandleSpec* spec;
  std::vector<int> selected;  ///< all surface samples inside the selection
  ThinnedSamples thinned;     ///< those that the energy sees, with their area
  HandlePath path;
  bool moves = false;  ///< else it stays where it is
};

/// What handles are chosen from: a shape scaled by 1/`unit` about `origin`.
struct HandleContext {
  SelectionContext selection;            ///< in the user's coordinates
  const SurfaceSamples& samples;         ///< in the user's coordinates: selections speak of them
  const SurfaceSamples& scaled_samples;  ///< the same, scaled
  Vec3 origin;
  double unit;          ///< length of the scaled shape's 1 [m]
  double sample_width;  ///< of the thinned samples, scaled
};

/// Errors: UsageError for a selection that selects nothing.
std::vector<PoseHandle> make_handles(const std::vector<HandleSpec>& specs,
                                     const HandleContext& context);

/// All handles' thinned samples in a row: rest points, weights ω_k and targets on the way.
class HandleSamples {
 public:
  /// ω_k = w_h · (area of k / area of the handle) / Σ w_h.
  HandleSamples(std::vector<PoseHandle> handles, const Points& surface_points);

  const Points& rest() const { return rest_; }
  const Eigen::VectorXd& weights() const { return weights_; }
  Points targets(double share) const;
  void targets(double share, Points& out) const;

  /// Gives a handle another way; it moves then, also where it was fixed.
  void lead(std::size_t handle, const HandlePath& path);

  bool empty() const { return rest_.rows() == 0; }
  const std::vector<PoseHandle>& handles() const { return handles_; }

 private:
  std::vector<PoseHandle> handles_;
  std::vector<int> owners_;  ///< the handle of each sample
  Points rest_;
  Eigen::VectorXd weights_;
};

/// How many steps the handles' way takes, so that none turns by more than 15° a step (less with
/// many particles) nor bends the shape by more than a twentieth of its size.
int substeps_needed(const HandleSamples& handles, Index particles);

}  // namespace supple
