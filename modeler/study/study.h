#pragma once

#include <optional>
#include <string>
#include <vector>

#include "modeler/study/fit.h"
#include "modeler/study/reference.h"
#include "modeler/study/sweeps.h"

namespace supple {

/// One value of one knob. Errors are root mean squares of |x − x_ref| over the deformed surface's
/// vertices, over the shape's diagonal.
struct StudyRow {
  std::string knob, value;
  std::size_t trial = 0;
  bool own = false;                  ///< the scene's own value
  std::string reference = {};        ///< what `error` is against; empty where there is none
  std::optional<double> error = {};  ///< from this knob's reference
  double uncertainty = 0;            ///< of that reference
  std::optional<double> total = {};  ///< from the one reference that all knobs share
  std::optional<double> order = {};  ///< observed, from the row before
  bool reference_too_coarse = false, noisy = false, pareto = false;
};

/// A part of the error of the scene as it is.
struct ErrorSource {
  std::string knob;
  double error = 0;
};

/// What a study found. Settings that are not ok stand in no recommendation.
struct Study {
  std::vector<Trial> trials;
  std::vector<StudyRow> rows;          ///< knob by knob, from coarse to fine
  std::optional<Reference> reference;  ///< that all knobs share; without its positions
  std::vector<std::size_t> pareto;     ///< rows, from the fastest to the most accurate
  std::optional<std::size_t> own;      ///< a row with the scene as it is
  std::vector<std::size_t> better;     ///< rows that are faster and as accurate, or more
  std::optional<PowerLaw> cost;        ///< time over error as the particles grow
  std::vector<ErrorSource> sources;    ///< the dominant one first

  const Trial& trial(const StudyRow& row) const { return trials[row.trial]; }
  double seconds(const StudyRow& row) const { return median(trial(row).seconds); }
  /// The error that settings of different knobs can be compared by.
  static std::optional<double> compared(const StudyRow& row) {
    return row.total ? row.total : row.error;
  }
};

/// Sweeps the `chosen` of a scene's `knobs` and measures what accuracy costs. Where one of them is
/// compared with the converged result, the knob that converges runs too.
Study study(const std::vector<Knob>& knobs, const std::vector<Knob>& chosen, const Runner& run,
            const SweepOptions& options = {});

}  // namespace supple
