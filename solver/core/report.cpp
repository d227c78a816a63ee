#include "solver/core/report.h"

#include <algorithm>
#include <array>
#include <utility>

#include "solver/core/check.h"

namespace supple {

EnumNames<Status> enum_names(Status) {
  static constexpr std::array<std::pair<Status, std::string_view>, 4> names{{
      {Status::not_run, "not run"},
      {Status::ok, "ok"},
      {Status::degraded, "degraded"},
      {Status::failed, "failed"},
  }};
  return names;
}

EnumNames<ReasonCode> enum_names(ReasonCode) {
  static constexpr std::array<std::pair<ReasonCode, std::string_view>, 12> names{{
      {ReasonCode::inverted, "inverted"},
      {ReasonCode::handle_miss, "handle_miss"},
      {ReasonCode::uncovered, "uncovered"},
      {ReasonCode::rank_lost, "rank_lost"},
      {ReasonCode::max_iterations, "max_iterations"},
      {ReasonCode::not_converged, "not_converged"},
      {ReasonCode::out_of_time, "out_of_time"},
      {ReasonCode::turn_lost, "turn_lost"},
      {ReasonCode::not_finite, "not_finite"},
      {ReasonCode::thin, "thin"},
      {ReasonCode::from_miss, "from_miss"},
      {ReasonCode::self_contact, "self_contact"},
  }};
  return names;
}

std::span<const ReasonLimit> reason_limits() {
  static constexpr std::array<ReasonLimit, 12> limits{{
      {ReasonCode::inverted, 0.0, "det F at or below this"},
      {ReasonCode::handle_miss, 0.01, "a handle sample's miss over the bounding-box diagonal"},
      {ReasonCode::uncovered, 0.0, "number of points outside all supports"},
      {ReasonCode::rank_lost, 0.01, "share of points whose neighbours do not span the basis"},
      {ReasonCode::max_iterations, 0.0, "solves stopped by the iteration limit"},
      {ReasonCode::not_converged, 0.0, "solves that the minimiser gave up"},
      {ReasonCode::out_of_time, 0.0, "solves stopped because the time was over"},
      {ReasonCode::turn_lost, 0.2, "share of the energy lost in one step of the handles' way"},
      {ReasonCode::not_finite, 0.0, "number of values that are not finite"},
      {ReasonCode::thin, 0.05, "share of the surface further from all particles than it should"},
      {ReasonCode::from_miss, 0.01, "miss of the pose to start from over the diagonal"},
      {ReasonCode::self_contact, 0.005, "share of the surface within or against its own part"},
  }};
  return limits;
}

double reason_limit(ReasonCode code) {
  for (const ReasonLimit& entry : reason_limits())
    if (entry.code == code) return entry.limit;
  fail_check("reason has a limit", __FILE__, __LINE__, std::string(enum_name(code)));
}

void Report::finish() {
  if (status == Status::not_run) status = Status::ok;
}

void Report::degrade(Reason reason) {
  if (status != Status::failed) status = Status::degraded;
  reasons.push_back(std::move(reason));
}

void Report::fail(Reason reason) {
  status = Status::failed;
  reasons.push_back(std::move(reason));
}

double Report::total_energy() const {
  double sum = 0;
  for (const auto& [name, value] : energies) sum += value;
  return sum;
}

const Reason* Report::find(ReasonCode code) const {
  const auto found = std::find_if(reasons.begin(), reasons.end(),
                                  [&](const Reason& reason) { return reason.code == code; });
  return found == reasons.end() ? nullptr : &*found;
}

Reason* Report::find(ReasonCode code) {
  return const_cast<Reason*>(std::as_const(*this).find(code));
}

}  // namespace supple
