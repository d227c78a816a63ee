#pragma once

#include <string>
#include <utility>
#include <vector>

#include "solver/core/describe.h"
#include "solver/core/export.h"

namespace supple {

enum class Status { not_run, ok, degraded, failed };

/// Why a run is less than ok. The limits stand in `reason_limits()`.
enum class ReasonCode {
  inverted,        ///< some det F ≤ 0
  handle_miss,     ///< a handle missed its target
  uncovered,       ///< a point lies outside all supports
  rank_lost,       ///< a point's neighbours do not span the basis
  max_iterations,  ///< the minimiser stopped before it converged
  not_converged,   ///< the minimiser gave up before it converged
  out_of_time,     ///< the minimiser stopped because its time was over
  turn_lost,       ///< the shape fell back from a turn on the handles' way
  not_finite,      ///< a number became NaN or infinite
  thin,            ///< a part is thinner than the particles can follow
  from_miss,       ///< the pose to start from is not one that the particles can take
  self_contact,    ///< the surface lies within or against itself
};

EnumNames<Status> SUPPLE_API enum_names(Status);
EnumNames<ReasonCode> SUPPLE_API enum_names(ReasonCode);

struct Reason {
  ReasonCode code;
  long count = 0;      ///< how many particles, points, handles ... are concerned
  double value = 0;    ///< the worst of them, in the unit of the limit
  std::string detail;  ///< one sentence for a person
};

/// The limit beyond which `code` counts, and the unit it is in.
struct ReasonLimit {
  ReasonCode code;
  double limit;
  std::string_view meaning;
};
std::span<const ReasonLimit> SUPPLE_API reason_limits();
double SUPPLE_API reason_limit(ReasonCode code);

/// What came of a run. Born as "not run", so that silence cannot look like success.
struct SUPPLE_API Report {
  Status status = Status::not_run;
  std::vector<Reason> reasons;
  std::vector<std::string> notes;  ///< worth saying, but no loss of quality
  int iterations = 0;
  std::vector<std::pair<std::string, double>> energies;  ///< weighted, dimensionless
  std::vector<std::pair<std::string, double>> seconds;   ///< by stage

  /// The run reached its end; stays degraded or failed where it is so already.
  void finish();
  void degrade(Reason reason);
  void fail(Reason reason);
  bool usable() const { return status == Status::ok || status == Status::degraded; }

  double total_energy() const;
  /// The reason with that code; null where there is none.
  const Reason* find(ReasonCode code) const;
  Reason* find(ReasonCode code);
};

}  // namespace supple
