#include "modeler/cli/summary.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "modeler/cli/messages.h"

namespace supple {
namespace {

using Buffer = fmt::memory_buffer;

template <class... Args>
void add(Buffer& text, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
}

/// In percent; a dash for what was not timed on its own.
std::string share(double seconds, double total_seconds) {
  return seconds > 0 ? fmt::format("{:.1f}", 100 * seconds / total_seconds) : "-";
}

void add_handles(const PoseResult& result, Buffer& text) {
  if (result.handles.empty()) return;
  add(text, "handles    miss {:.2g} % of the diagonal at most, {:.2g} % rms\n",
      100 * result.handle_max_error, 100 * result.handle_rms_error);
  if (result.handles.size() < 2) return;
  for (const HandleResidual& handle : result.handles)
    add(text, "           {:.2g} %  {}\n", 100 * handle.max_error, handle.selection);
}

void add_seconds(const PoseRun& run, Buffer& text) {
  add(text, "seconds    load {:.2f}", run.load_seconds);
  for (const auto& [stage, seconds] : run.result->report.seconds)
    add(text, ", {} {:.2f}", stage, seconds);
  add(text, ", write {:.2f}, total {:.2f}\n", run.write_seconds, run.total_seconds);
}

void add_result(const PoseRun& run, Buffer& text) {
  const PoseResult& result = *run.result;
  add(text, "status     {}\n", enum_name(result.report.status));
  for (const Reason& reason : result.report.reasons)
    add(text, "           {}: {}\n", enum_name(reason.code), reason.detail);
  add(text, "shape      {} vertices, {} particles\n", result.mesh.positions.rows(),
      result.particles.size());
  add_handles(result, text);
  add(text, "volume     {:+.2f} %\n",
      100 * (result.volume_after - result.volume_before) / result.volume_before);
  add(text, "min det F  {:.3f}\n", result.min_det_F);
  add_seconds(run, text);
}

}  // namespace

std::string effects_table(std::span<const Effect> effects, double total_seconds) {
  std::size_t width = 6;
  for (const Effect& effect : effects) width = std::max(width, effect.name.size());
  Buffer text;
  add(text, "{:<{}}  {}used because\n", "effect", width, total_seconds > 0 ? "time %  " : "");
  for (const Effect& effect : effects) {
    if (!effect.active) continue;
    add(text, "{:<{}}  ", effect.name, width);
    if (total_seconds > 0) add(text, "{:>6}  ", share(effect.seconds, total_seconds));
    add(text, "{}\n", effect.why);
  }
  for (const Effect& effect : effects)
    if (!effect.active) add(text, "{:<{}}  off: {}\n", effect.name, width, effect.why);
  return fmt::to_string(text);
}

std::string summary(const PoseRun& run) {
  Buffer text;
  add_result(run, text);
  for (const std::filesystem::path& path : run.outputs)
    add(text, "wrote      {}\n", one_line(path.string()));
  add(text, "\n{}", effects_table(run.result->effects, run.total_seconds));
  return fmt::to_string(text);
}

}  // namespace supple
