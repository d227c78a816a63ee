#pragma once

#include <optional>
#include <vector>

#include "io/mesh/vertex_places.h"
#include "io/scene/pose_spec.h"
#include "modeler/domain/select.h"
#include "modeler/domain/surface_samples.h"
#include "modeler/pose/mirror_plane.h"

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

/// Where a handle comes from: the user, its mirror image, or a region that holds what is outside.
enum class HandleOrigin { user, mirror, region };

/// A handle's surface samples and where they shall go, all in the scaled shape's coordinates.
struct PoseHandle {
  const HandleSpec* spec = nullptr;
  const SurfaceSamples* samples =
      nullptr;                ///< that it is chosen from: the surface's, or its vertices
  std::vector<int> selected;  ///< all of these that it holds or leads, ascending
  ThinnedSamples thinned;     ///< those that the energy sees, with their area
  HandlePath path;
  Points start;       ///< where the way of each of `selected` begins; empty: at rest
  Points places;      ///< where `to` wants each of `selected`; else empty
  Points remainders;  ///< of the places, beyond where the path leads; else empty
  std::optional<MirrorPlane> mirror;  ///< the path is that of the images
  HandleOrigin origin = HandleOrigin::user;

  Points rest() const { return samples->positions(selected, Eigen::all); }

  Vec3 start_of(Index row) const;
  /// Where the selected sample of that row is after that share of the way.
  Vec3 target(Index row, double share) const;
};

/// What handles are chosen from: a shape scaled by 1/`unit` about `origin`.
struct HandleContext {
  SelectionContext selection;      ///< in the user's coordinates
  const SurfaceSamples& surface;   ///< scaled
  const SurfaceSamples& vertices;  ///< scaled, with their area; needed where handles have `to`
  Vec3 origin;
  double unit;          ///< length of the scaled shape's 1 [m]
  double sample_width;  ///< of the thinned samples, scaled
  double hold_width;    ///< of those of what is held around a region

  /// In the user's coordinates: selections speak of them.
  SurfaceSamples restored(const SurfaceSamples& scaled) const;
};

/// `targets`: what the handles' `to` files say [user's coordinates], one a handle.
/// Errors: UsageError for a selection that selects nothing, a listed vertex off the surface.
std::vector<PoseHandle> make_handles(const std::vector<HandleSpec>& specs,
                                     const std::vector<VertexPlaces>& targets,
                                     const HandleContext& context);

/// The path of a handle from where it starts, once its samples are chosen.
void find_path(const HandleContext& context, PoseHandle& handle);

/// Lets a handle's way begin at `start`, one a selected sample, instead of at rest.
void begin_at(Points start, const HandleContext& context, PoseHandle& handle);

/// Holds these samples of the surface, ascending, as `spec` says: what a region leaves out.
PoseHandle make_hold(const HandleSpec& spec, std::vector<int> samples,
                     const HandleContext& context);

/// All handles' thinned samples in a row: rest points, weights ω_k and targets on the way.
class HandleSamples {
 public:
  /// ω_k = w_h · (area of k / area of the handle) / Σ w_h; the sum is over the user's handles, so
  /// that what a region holds leaves them their weight.
  explicit HandleSamples(std::vector<PoseHandle> handles);

  const Points& rest() const { return rest_; }
  const Eigen::VectorXd& weights() const { return weights_; }
  Points start() const;
  Points targets(double share) const;
  /// The same into `out`, which is allocated only where its size changes.
  void targets(double share, Points& out) const;

  /// Gives a handle that moves along a path another one.
  void lead(std::size_t handle, const HandlePath& path) { handles_[handle].path = path; }

  bool empty() const { return rest_.rows() == 0; }
  const std::vector<PoseHandle>& handles() const { return handles_; }

 private:
  /// The handle of a sample, and its row there.
  struct Owner {
    std::size_t handle;
    Index row;
  };

  std::vector<PoseHandle> handles_;
  std::vector<Owner> owners_;  ///< of each sample
  Points rest_;
  Eigen::VectorXd weights_;
};

/// How many steps the handles' way takes, so that none turns by more than 15° a step (less with
/// many particles) nor bends the shape by more than a twentieth of its size.
int substeps_needed(const HandleSamples& handles, Index particles);

}  // namespace supple
