#include "solver/minimize/repair.h"

#include "solver/minimize/preconditioner.h"

namespace supple {
namespace {

constexpr int rounds = 80;

}  // namespace

void repair(const EnergySum& energy, NearestRotationEnergy& rotations, const Samples& samples,
            const Deadline& deadline, Points& u) {
  // Of squares of linear residuals the preconditioner is a bound of the Hessian, nearly itself.
  const Preconditioner hessian(energy);
  Points step;
  for (int round = 0; round < rounds && !deadline.over(); ++round) {
    rotations.turn_to(samples, u);
    energy.evaluate(u, &step);
    hessian.to_gradient(step);
    hessian.to_displacements(step);
    u -= step;
  }
}

}  // namespace supple
