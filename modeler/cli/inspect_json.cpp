#include <cmath>

#include "modeler/cli/inspect_run.h"
#include "modeler/cli/json_text.h"
#include "modeler/cli/likely_size.h"

namespace supple {
namespace {

constexpr std::size_t most_components = 100;

Json vector_json(const Vec3& x) {
  return {x.x(), x.y(), x.z()};
}

Json box_json(const Box& box) {
  return {{"lower", vector_json(box.lower)}, {"upper", vector_json(box.upper)}};
}

Json shape_json(const InspectRun& run) {
  const Mesh& mesh = run.mesh;
  Json json = {{"kind", run.inspection.mesh ? "mesh" : "points"},
               {"vertices", mesh.positions.rows()},
               {"faces", mesh.face_count()}};
  json["triangles"] = run.inspection.mesh ? run.inspection.mesh->triangles : 0;
  json["faces_by_sides"] = Json::object();
  if (run.inspection.mesh)
    for (const auto& [sides, count] : run.inspection.mesh->faces_by_sides)
      json["faces_by_sides"][std::to_string(sides)] = count;
  json["normals"] = !mesh.normals.empty();
  json["texture_coordinates"] = !mesh.texcoords.empty();
  json["colors"] = !mesh.colors.empty();
  json["radii"] = mesh.radii.size() > 0;
  json["notes"] = mesh.notes;
  return json;
}

Json size_json(const InspectRun& run) {
  const Box& box = run.inspection.box;
  Json units = Json::array();
  for (const auto& [unit, name] : enum_names(FileUnit{})) {
    const double size = metres(unit) * box.diagonal();
    units.push_back({{"unit", name}, {"diagonal_m", size}, {"likely", is_likely_size(size)}});
  }
  return {{"box", box_json(box)},
          {"extent", vector_json(box.size())},
          {"diagonal", box.diagonal()},
          {"units", units}};
}

Json topology_json(const Topology& topology) {
  Json json = {{"watertight", topology.watertight()},
               {"closed", topology.closed()},
               {"manifold", topology.manifold()},
               {"orientable", topology.orientable},
               {"components", topology.components},
               {"edges", topology.edges},
               {"boundary_edges", topology.boundary_edges},
               {"nonmanifold_edges", topology.nonmanifold_edges},
               {"nonmanifold_vertices", topology.nonmanifold_vertices.size()},
               {"inconsistent_edges", topology.inconsistent_edges},
               {"euler_characteristic", topology.euler_characteristic()}};
  json["genus"] = topology.has_genus() ? Json(topology.genus()) : Json();
  return json;
}

Json defects_json(const MeshSurvey& survey) {
  Json json = Json::object();
  for (const Defect& defect : survey.defects) {
    Json where = Json::array();
    for (const DefectPlace& place : defect.places)
      where.push_back({{"vertices", place.vertices},
                       {"faces", place.faces},
                       {"position", vector_json(place.position)}});
    json[std::string(enum_name(defect.kind))] = {
        {"count", defect.count}, {"estimated", defect.estimated}, {"where", where}};
  }
  return json;
}

Json surface_json(const MeshSurvey& survey) {
  Json json = topology_json(survey.topology);
  json["loose_faces"] = survey.loose;
  json["area"] = survey.area;
  json["signed_volume"] = survey.volume;
  json["defects"] = defects_json(survey);
  json["welded"] = topology_json(survey.welded);
  return json;
}

Json components_json(const MeshSurvey& survey) {
  Json largest = Json::array();
  for (const Component& component : survey.components) {
    if (largest.size() == most_components) break;
    largest.push_back({{"vertices", component.vertices},
                       {"faces", component.faces},
                       {"closed", component.closed},
                       {"area", component.area},
                       {"signed_volume", component.volume},
                       {"volume_share", component.volume_share},
                       {"box", box_json(component.box)}});
  }
  return {{"count", survey.components.size()}, {"largest", largest}};
}

Json points_json(const PointSpacing& spacing) {
  return {{"nearest_median", spacing.median},
          {"nearest_least", spacing.least},
          {"nearest_greatest", spacing.greatest},
          {"density", spacing.density},
          {"area", spacing.area},
          {"duplicated", spacing.duplicated}};
}

Json thickness_json(const ThinParts& thin) {
  Json quantiles = Json::object();
  for (const int percent : {1, 5, 10, 25, 50, 75, 90})
    quantiles[std::to_string(percent)] = thin.thickness.quantile(0.01 * percent);
  return {{"quantiles_percent", quantiles},
          {"particles", thin.particles},
          {"spacing", thin.spacing},
          {"thinner_share", thin.thinner_share},
          {"wanted_spacing", thin.wanted_spacing},
          {"wanted_particles", thin.wanted_particles}};
}

Json solid_json(const SolidVerdict& verdict) {
  Json json = {{"status", verdict.poses() ? "ok" : "refused"}, {"reason", verdict.reason}};
  json["notes"] = verdict.poses() ? verdict.solid->notes() : std::vector<std::string>();
  json["degraded"] = Json::array();
  json["volume"] = Json();
  if (!verdict.poses()) return json;
  for (const Reason& reason : verdict.solid->reasons())
    json["degraded"].push_back({{"reason", enum_name(reason.code)}, {"text", reason.detail}});
  json["volume"] = verdict.solid->region().volume() * std::pow(verdict.solid->unit(), 3);
  return json;
}

Json selection_json(const InspectRun& run) {
  const SelectedPart& part = *run.selected;
  return {{"text", run.selection},
          {"vertices", part.vertices},
          {"area", part.area},
          {"area_share", part.area_share},
          {"box", box_json(part.box)}};
}

Json seconds_json(const InspectRun& run) {
  Json json = {{"load", run.load_seconds}};
  for (const auto& [stage, seconds] : run.inspection.seconds) json[stage] = seconds;
  json["total"] = run.total_seconds;
  return json;
}

}  // namespace

std::string inspect_json(const InspectRun& run) {
  const Inspection& found = run.inspection;
  Json json = {{"command", "inspect"}, {"version", SUPPLE_VERSION}, {"input", run.input}};
  json["shape"] = shape_json(run);
  json["size"] = size_json(run);
  json["surface"] = found.mesh ? surface_json(*found.mesh) : Json();
  json["components"] = found.mesh ? components_json(*found.mesh) : Json();
  json["points"] = found.points ? points_json(*found.points) : Json();
  json["solid"] = solid_json(found.verdict);
  json["thickness"] = found.thin ? thickness_json(*found.thin) : Json();
  json["advice"] = advice(run);
  json["selection"] = run.selected ? selection_json(run) : Json();
  json["seconds"] = seconds_json(run);
  return json_text(json);
}

}  // namespace supple
