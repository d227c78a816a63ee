#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string_view>
#include <thread>
#include <vector>

#include "solver/core/stopwatch.h"
#include "solver/energy/energy.h"

/// Energies of places that are hard on minimisers.
namespace supple {

inline constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// |f − x|² with one x for all samples; those below are the same but for what they say.
class PlaceEnergy : public Energy {
 public:
  std::string_view name() const override { return "place"; }
  Argument argument() const override { return Argument::position; }
  int rows() const override { return 3; }
  double stiffness() const override { return 2; }
  void evaluate(const LocalField& at, LocalResidual& out) const override {
    out.r.head<3>() = at.f - Vec3(1, 0, 0);
    out.jacobian.setZero();
    out.jacobian.topLeftCorner<3, 3>().setIdentity();
  }
};

/// NaN beyond a fence on the way to the minimum.
class FencedEnergy final : public PlaceEnergy {
 public:
  explicit FencedEnergy(double fence) : fence_(fence) {}
  void evaluate(const LocalField& at, LocalResidual& out) const override {
    PlaceEnergy::evaluate(at, out);
    if (at.f.x() > fence_) out.r[0] = no_number;
  }

 private:
  double fence_;
};

/// A number only where its first sample is at rest.
class IslandEnergy final : public PlaceEnergy {
 public:
  explicit IslandEnergy(const Vec3& rest) : rest_(rest) {}
  void evaluate(const LocalField& at, LocalResidual& out) const override {
    PlaceEnergy::evaluate(at, out);
    if (at.sample == 0 && at.f != rest_) out.r[0] = no_number;
  }

 private:
  Vec3 rest_;
};

/// (|f|² − 1)²: its Hessian is indefinite within the sphere |f|² = 1/3.
class RingEnergy final : public PlaceEnergy {
 public:
  int rows() const override { return 1; }
  double stiffness() const override { return 8; }
  void evaluate(const LocalField& at, LocalResidual& out) const override {
    out.r[0] = at.f.squaredNorm() - 1;
    out.jacobian.row(0).setZero();
    out.jacobian.row(0).head<3>() = 2 * at.f.transpose();
  }
};

/// |f_x − 0.1| + |f_y − 0.2|: kinks at which no line search finds what it wants.
class KinkEnergy final : public PlaceEnergy {
 public:
  void evaluate(const LocalField& at, LocalResidual& out) const override {
    out.r.head<3>().setZero();
    out.jacobian.setZero();
    for (int axis = 0; axis < 2; ++axis) {
      const double off = at.f[axis] - 0.1 * (axis + 1);
      out.r[axis] = std::sqrt(std::abs(off));
      if (off != 0) out.jacobian(axis, axis) = 0.5 / out.r[axis] * (off > 0 ? 1 : -1);
    }
  }
};

/// Of one sample alone: nearly all directions are without any Hessian.
class CornerEnergy final : public PlaceEnergy {
 public:
  void evaluate(const LocalField& at, LocalResidual& out) const override {
    PlaceEnergy::evaluate(at, out);
    if (at.sample == 0) return;
    out.r.head<3>().setZero();
    out.jacobian.setZero();
  }
};

/// Takes its time, and keeps when each evaluation began.
class SlowEnergy final : public PlaceEnergy {
 public:
  explicit SlowEnergy(double seconds) : seconds_(seconds) {}
  void evaluate(const LocalField& at, LocalResidual& out) const override {
    PlaceEnergy::evaluate(at, out);
    if (at.sample != 0) return;
    begun_.push_back(watch_.seconds());
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds_));
  }
  void start() {
    begun_.clear();
    watch_ = {};
  }
  long begun_after(double seconds) const {
    return std::count_if(begun_.begin(), begun_.end(), [=](double at) { return at > seconds; });
  }

 private:
  double seconds_;
  Stopwatch watch_;
  mutable std::vector<double> begun_;
};

}  // namespace supple
