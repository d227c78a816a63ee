#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "modeler/pose/handles.h"
#include "solver/core/deadline.h"
#include "solver/core/report.h"
#include "solver/energy/energy_sum.h"
#include "solver/energy/handle.h"
#include "solver/energy/inversion_barrier.h"
#include "solver/energy/rigidity.h"
#include "solver/energy/volume.h"
#include "solver/minimize/minimize.h"

namespace supple {

struct PoseSolveOptions {
  MinimizeOptions minimize;
  int substeps = 1;
  bool hard_handles = false;  ///< met exactly, as far as they can be
  double most_seconds = std::numeric_limits<double>::infinity();  ///< for the handles' whole way
};

/// The pose energy of one shape, E = λ1 E_handles + λ2 E_rigidity + λ3 E_volume
/// (Adams & Wicke 2009, Eq. 78), and the way to its minimum.
class PoseSolver {
 public:
  /// `quadrature` are samples with gradients, each standing for one of `volumes`; all of it
  /// outlives the solver. `stiffness`: a factor on each sample's rigidity and volume, or empty.
  PoseSolver(const MovingLeastSquares<3>& field, const Samples& quadrature,
             const Eigen::VectorXd& volumes, const HandleSamples& handles,
             const PoseWeights& weights, const Eigen::VectorXd& stiffness = {});
  /// From now on no point where energies are summed may turn inside out.
  void forbid_inversion();
  /// Nor may these points of the rest shape [m], n×3.
  void forbid_inversion_at(const MovingLeastSquares<3>& field, const Points& points);

  PoseSolver(const PoseSolver&) = delete;
  PoseSolver& operator=(const PoseSolver&) = delete;

  /// Walks the handles from rest to their places in substeps, each starting from the one
  /// before; `u` [N×3] holds the pose then. A step after which the shape sprang to another pose
  /// is taken again in halves; where that does not help the report says turn_lost. `on_step` is
  /// told the share done. Where points are turned inside out in the end, the shape is repaired and
  /// solved again. What `u` holds is where the way starts. Where the time is over before, `u` holds
  /// the best pose so far, and the report says out_of_time.
  Report solve(const PoseSolveOptions& options, const std::function<void(double share)>& on_step,
               Points& u);

  /// To the minimum nearest to `u`, with the handles where they shall be at last; points that are
  /// inside out there are repaired.
  Report polish(const PoseSolveOptions& options, Points& u);

  /// Takes points that are inside out in `u` back, with the handles where they shall be at last.
  Report repair(const PoseSolveOptions& options, Points& u);

  /// One step of a drag: as polish(), from `u` [N×4], by L-BFGS alone and without repair. With soft
  /// handles only the first one allocates.
  Lbfgs::Result drag(const PoseSolveOptions& options, PaddedPoints& u);

  /// Each energy of `u` by its name, with the handles where they shall be at last.
  std::vector<std::pair<std::string, double>> energies_at_end(const Points& u);

  const Samples& handle_samples() const { return handle_samples_; }

  /// Particles in pieces of the shape without any handle: nothing moves them.
  long loose_particles() const { return std::count(held_.begin(), held_.end(), false); }

  /// An estimate of each term's share in the solve, by the time that one evaluation takes.
  std::vector<std::pair<std::string, double>> time_shares(const Points& u) const;

 private:
  /// What stays the same on the whole way.
  struct Way {
    const Preconditioner& preconditioner;
    std::optional<HardConstraints> constraints;
    MinimizeOptions options;
    Deadline deadline;
  };

  Way way_of(const PoseSolveOptions& options) const;
  /// Whether the volume weighs so much that L-BFGS is not sure to get to the minimum.
  bool heavy() const;
  /// Brings the handles from one share of their way to the next and minimises.
  Report step(const Way& way, double from, double to, Points& u);
  /// The time was over in the step after `share`, whose unfinished pose `u` takes, unless more
  /// points are inside out there.
  void end_early(double share, const Report& step, const Points& unfinished, Points& u,
                 Report& way);
  /// Takes points that are turned inside out back, where that can be.
  void mend(const Way& way, Points& u, Report& report);
  Report minimize_at(const Way& way, const MinimizeOptions& options, const Points& targets,
                     Points& u) const;

  /// Says which points of handles no particle reaches.
  void judge_reach(Report& report) const;

  /// Moves what hangs together with handles along with them as one body, where that is nearer to
  /// the new minimum.
  void predict(const Points& targets_before, const Points& targets, Points& u) const;

  const Points& particles_;
  const Samples& quadrature_;
  const HandleSamples& handles_;
  PoseWeights weights_;
  Eigen::VectorXd volume_shares_;
  Samples handle_samples_;
  HandleEnergy handle_energy_;
  RigidityEnergy rigidity_;
  VolumeEnergy volume_;
  InversionBarrier barrier_;
  std::deque<Samples> barrier_samples_;  ///< beside the quadrature's
  EnergySum energy_;
  std::optional<Preconditioner> preconditioner_;
  std::vector<bool> held_;  ///< particles that hang together with a handle

  // Of drags:
  Lbfgs lbfgs_;
  std::optional<HardConstraints> constraints_;
  Points targets_;
};

}  // namespace supple
