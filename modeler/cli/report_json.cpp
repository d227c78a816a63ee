#include "modeler/cli/report_json.h"

#include "io/output_file.h"
#include "modeler/cli/json_text.h"
#include "modeler/cli/machine.h"

namespace supple {
namespace {

Json pairs_json(const std::vector<std::pair<std::string, double>>& pairs) {
  Json json = Json::object();
  for (const auto& [name, value] : pairs) json[name] = value;
  return json;
}

Json seconds_json(const PoseRun& run) {
  Json json = {{"load", run.load_seconds}};
  for (const char* stage : {"sample", "field", "solve", "deform"}) json[stage] = 0.0;
  if (run.result)
    for (const auto& [stage, seconds] : run.result->report.seconds) json[stage] = seconds;
  json["write"] = run.write_seconds;
  json["total"] = run.total_seconds;
  return json;
}

Json effects_json(const std::vector<Effect>& effects) {
  Json active = Json::object(), off = Json::object();
  for (const Effect& effect : effects) {
    if (effect.active)
      active[effect.name] = {{"because", effect.why}, {"seconds", effect.seconds}};
    else
      off[effect.name] = effect.why;
  }
  return {{"active", active}, {"off", off}};
}

Json handles_json(const PoseResult& result) {
  Json each = Json::array();
  for (const HandleResidual& handle : result.handles)
    each.push_back({{"place", to_string(handle.place)},
                    {"selection", handle.selection},
                    {"samples", handle.samples},
                    {"max_error", handle.max_error},
                    {"rms_error", handle.rms_error}});
  return {{"max_error", result.handle_max_error},
          {"rms_error", result.handle_rms_error},
          {"each", each}};
}

Json volume_json(const PoseResult& result) {
  const double before = result.volume_before, after = result.volume_after;
  return {{"before", before}, {"after", after}, {"change", (after - before) / before}};
}

void add_result(const PoseResult& result, Json& json) {
  const Report& report = result.report;
  for (const Reason& reason : report.reasons) {
    const std::string code(enum_name(reason.code));
    json["reasons"].push_back(code);
    json["details"].push_back({{"reason", code},
                               {"count", reason.count},
                               {"value", reason.value},
                               {"limit", reason_limit(reason.code)},
                               {"text", reason.detail}});
  }
  json["notes"] = report.notes;
  json["particles"] = result.particles.size();
  json["vertices"] = result.mesh.positions.rows();
  json["iterations"] = report.iterations;
  json["energies"] = pairs_json(report.energies);
  json["handles"] = handles_json(result);
  json["volume"] = volume_json(result);
  json["min_det_F"] = result.min_det_F;
  json["effects"] = effects_json(result.effects);
}

}  // namespace

std::string report_json(const PoseRun& run) {
  Json json = {
      {"command", "pose"},        {"version", SUPPLE_VERSION},         {"input", run.input},
      {"outputs", Json::array()}, {"status", enum_name(run.status())}, {"reasons", Json::array()},
      {"details", Json::array()}};
  for (const std::filesystem::path& path : run.outputs) json["outputs"].push_back(path.string());
  if (!run.result) {
    json["reasons"].push_back("shape");
    json["details"].push_back({{"reason", "shape"}, {"text", run.failure}});
  }
  json["seconds"] = seconds_json(run);
  if (run.result) add_result(*run.result, json);
  json["memory_peak_bytes"] = peak_memory();
  return json_text(json);
}

std::string plan_json(const Plan& plan) {
  Json effects = effects_json(plan.effects);
  for (Json& active : effects["active"]) active.erase("seconds");
  return json_text({{"command", "plan"}, {"version", SUPPLE_VERSION}, {"effects", effects}});
}

void write_text(const std::string& text, const std::filesystem::path& path) {
  OutputFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace supple
