#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "modeler/cli/inspect_run.h"
#include "modeler/cli/likely_size.h"
#include "modeler/cli/messages.h"

namespace supple {
namespace {

using Buffer = fmt::memory_buffer;

constexpr int label_width = 11;
constexpr std::size_t most_components = 5, most_places = 2;
constexpr double most_advised = 5000;  // particles; more are slow

template <class... Values>
void add(Buffer& text, fmt::format_string<Values...> form, Values&&... values) {
  fmt::format_to(std::back_inserter(text), form, std::forward<Values>(values)...);
}

/// A line of the section `label`, which stands before its first line only.
template <class... Values>
void line(Buffer& text, std::string_view label, fmt::format_string<Values...> form,
          Values&&... values) {
  add(text, "{:<{}}", label, label_width);
  fmt::format_to(std::back_inserter(text), form, std::forward<Values>(values)...);
  add(text, "\n");
}

/// "1 vertex", "2 vertices".
std::string counted(long count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string percent(double share) {
  if (share <= 0) return "none";
  if (share < 0.0005) return "less than 0.1 %";
  return fmt::format("{:.{}f} %", 100 * share, share < 0.0995 ? 1 : 0);
}

std::string position_text(const Vec3& x) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", x.x(), x.y(), x.z());
}

std::string numbers_text(std::string_view one, std::string_view many,
                         const std::vector<int>& numbers) {
  return fmt::format("{} {}", numbers.size() == 1 ? one : many, fmt::join(numbers, ", "));
}

std::string place_text(const DefectPlace& place) {
  return fmt::format("{} at {}",
                     place.vertices.empty() ? numbers_text("face", "faces", place.faces)
                                            : numbers_text("vertex", "vertices", place.vertices),
                     position_text(place.position));
}

struct DefectWords {
  std::string_view one, many;
};

DefectWords words(DefectKind kind) {
  switch (kind) {
    case DefectKind::boundary_edges:
      return {"boundary edge", "boundary edges"};
    case DefectKind::nonmanifold_edges:
      return {"edge of more than two faces", "edges of more than two faces"};
    case DefectKind::nonmanifold_vertices:
      return {"vertex where separate fans touch", "vertices where separate fans touch"};
    case DefectKind::inconsistent_edges:
      return {"edge whose faces look to opposite sides",
              "edges whose faces look to opposite sides"};
    case DefectKind::duplicate_faces:
      return {"duplicate face", "duplicate faces"};
    case DefectKind::zero_area_triangles:
      return {"triangle without area", "triangles without area"};
    case DefectKind::repeated_index_faces:
      return {"face that names a vertex twice", "faces that name a vertex twice"};
    case DefectKind::unreferenced_vertices:
      return {"vertex of no face", "vertices of no face"};
    case DefectKind::duplicated_vertices:
      return {"vertex at the place of another", "vertices at the place of others"};
    case DefectKind::self_intersections:
      return {"pair of intersecting triangles", "pairs of intersecting triangles"};
  }
  return {"defect", "defects"};
}

void add_shape(const InspectRun& run, Buffer& text) {
  const Mesh& mesh = run.mesh;
  std::string what = counted(static_cast<long>(mesh.positions.rows()), "vertex", "vertices");
  if (const std::optional<MeshSurvey>& survey = run.inspection.mesh) {
    what += ", " + counted(survey->faces, "face", "faces");
    std::vector<std::string> sides;
    for (const auto& [count, faces] : survey->faces_by_sides)
      sides.push_back(fmt::format("{} of {} sides", faces, count));
    if (sides.size() > 1 || survey->faces_by_sides.begin()->first != 3)
      what += fmt::format(" ({})", fmt::join(sides, ", "));
  } else {
    what = counted(static_cast<long>(mesh.positions.rows()), "point", "points") + " without faces";
  }
  const std::pair<bool, const char*> extras[] = {{!mesh.normals.empty(), "normals"},
                                                 {!mesh.texcoords.empty(), "texture coordinates"},
                                                 {!mesh.colors.empty(), "colours"},
                                                 {mesh.radii.size() > 0, "radii"}};
  for (const auto& [present, name] : extras)
    if (present) what += fmt::format(", {}", name);
  line(text, "shape", "{}", what);
  for (const std::string& note : mesh.notes) line(text, "", "{}", one_line(note));
}

void add_size(const InspectRun& run, Buffer& text) {
  const Box& box = run.inspection.box;
  const Vec3 size = box.size();
  line(text, "size", "{:.4g} x {:.4g} x {:.4g}, diagonal {:.4g}; from {} to {}", size.x(), size.y(),
       size.z(), box.diagonal(), position_text(box.lower), position_text(box.upper));
  std::vector<std::string> units;
  for (const auto& [unit, name] : enum_names(FileUnit{})) {
    const double large = metres(unit) * box.diagonal();
    units.push_back(fmt::format("{}{} if it is in {}", length_text(large),
                                is_likely_size(large) ? "" : " (unlikely)", name));
  }
  line(text, "", "{}", fmt::join(units, ", "));
}

void add_defects(const MeshSurvey& survey, Buffer& text) {
  for (const Defect& defect : survey.defects) {
    if (defect.count == 0) continue;
    std::vector<std::string> places;
    for (const DefectPlace& place : defect.places)
      if (places.size() < most_places) places.push_back(place_text(place));
    line(text, "", "{}{}: {}{}", defect.estimated ? "about " : "",
         counted(defect.count, words(defect.kind).one, words(defect.kind).many),
         fmt::join(places, "; "), defect.count > static_cast<long>(places.size()) ? " ..." : "");
  }
}

/// "closed, consistent, manifold", "open", ...
std::string state(const Topology& topology) {
  if (topology.watertight()) {
    std::string text = "watertight";
    if (topology.has_genus()) text += fmt::format(", genus {}", topology.genus());
    return text;
  }
  std::vector<std::string_view> wrong;
  if (!topology.closed()) wrong.push_back("open");
  if (topology.nonmanifold_edges > 0) wrong.push_back("not manifold");
  if (!topology.orientable)
    wrong.push_back("not orientable");
  else if (topology.inconsistent_edges > 0)
    wrong.push_back("faces not turned one way");
  return fmt::format("not watertight: {}", fmt::join(wrong, ", "));
}

void add_surface(const MeshSurvey& survey, Buffer& text) {
  line(text, "surface", "{}{}", state(survey.topology),
       survey.loose ? " (loose triangles; those at one place taken for joined)" : "");
  if (!survey.loose && state(survey.welded) != state(survey.topology))
    line(text, "", "with vertices at one place joined: {}", state(survey.welded));
  add_defects(survey, text);
  line(text, "", "area {:.4g}{}", survey.area,
       survey.welded.closed() ? fmt::format(", signed volume {:.4g}", survey.volume) : "");
}

void add_components(const MeshSurvey& survey, Buffer& text) {
  const auto count = static_cast<long>(survey.components.size());
  line(text, "components", "{}{}", count,
       survey.topology.components == count
           ? ""
           : fmt::format("; {} as the file joins its faces", survey.topology.components));
  if (count < 2) return;
  for (std::size_t i = 0; i < std::min(survey.components.size(), most_components); ++i) {
    const Component& c = survey.components[i];
    line(text, "", "{}, {}, {}, {} of the area{}", counted(c.faces, "face", "faces"),
         counted(c.vertices, "vertex", "vertices"), c.closed ? "closed" : "open",
         percent(c.area / survey.area),
         c.closed ? fmt::format(", {} of the volume", percent(c.volume_share)) : "");
  }
  if (survey.components.size() > most_components)
    line(text, "", "... and {} smaller", survey.components.size() - most_components);
}

void add_points(const PointSpacing& points, Buffer& text) {
  line(text, "points", "{:.3g} apart ({:.3g} to {:.3g}); {:.3g} a unit of area, on about {:.3g}",
       points.median, points.least, points.greatest, points.density, points.area);
  if (points.duplicated > 0)
    line(text, "", "{}",
         counted(points.duplicated, "point at the place of another",
                 "points at the place of others"));
}

void add_thickness(const ThinParts& thin, const Box& box, Buffer& text) {
  if (thin.thickness.empty()) return;
  std::vector<std::string> parts;
  for (const int share : {1, 10, 50}) {
    const double below = thin.thickness.quantile(0.01 * share);
    parts.push_back(fmt::format("{:.3g} ({:.1f} %)", below, 100 * below / box.diagonal()));
  }
  line(text, "thickness", "1, 10 and 50 % of the surface are thinner than {} of the diagonal",
       fmt::join(parts, ", "));
}

void add_solid(const SolidVerdict& verdict, Buffer& text) {
  if (!verdict.poses()) {
    line(text, "solid", "no: {}", verdict.reason);
    return;
  }
  line(text, "solid", "poses as a solid of volume {:.4g}",
       verdict.solid->region().volume() * std::pow(verdict.solid->unit(), 3));
  for (const Reason& reason : verdict.solid->reasons())
    line(text, "", "degraded: {}: {}", enum_name(reason.code), reason.detail);
  for (const std::string& note : verdict.solid->notes()) line(text, "", "{}", note);
}

void add_selection(const InspectRun& run, Buffer& text) {
  const SelectedPart& part = *run.selected;
  line(text, "selection", "{}: {}, {} of the area ({:.4g}), from {} to {}", run.selection,
       counted(part.vertices, "vertex", "vertices"), percent(part.area_share), part.area,
       position_text(part.box.lower), position_text(part.box.upper));
}

/// Two digits, upwards.
double rounded_up(double count) {
  const double unit = std::pow(10, std::max(0.0, std::floor(std::log10(count)) - 1));
  return unit * std::ceil(count / unit);
}

/// The spacing that so many particles would have.
double spacing_of(const ThinParts& thin, double particles) {
  return thin.spacing * std::cbrt(static_cast<double>(thin.particles) / particles);
}

std::string particle_advice(const ThinParts& thin, double diagonal) {
  const std::string lie = fmt::format(
      "{} particles lie {:.1f} % of the diagonal apart ({:.3g}); {} of the surface is "
      "thinner than that",
      thin.particles, 100 * thin.spacing / diagonal, thin.spacing, percent(thin.thinner_share));
  if (thin.thinner_share <= most_thin_share) return lie;
  const double wanted = rounded_up(thin.wanted_particles);
  if (wanted <= 2 * most_advised)
    return fmt::format("{}: --particles {} or --spacing {:.2g}% follow it", lie, wanted,
                       std::floor(1000 * thin.wanted_spacing / diagonal) / 10);
  const double left = thin.thickness.share_below(spacing_of(thin, most_advised));
  return fmt::format("{}: --particles {} leave {} thinner; all but {} would take {}, which is slow",
                     lie, most_advised, percent(left), percent(most_thin_share), wanted);
}

}  // namespace

std::vector<std::string> advice(const InspectRun& run) {
  std::vector<std::string> sentences;
  const double diagonal = run.inspection.box.diagonal();
  if (run.inspection.thin && !run.inspection.thin->thickness.empty())
    sentences.push_back(particle_advice(*run.inspection.thin, diagonal));
  if (!is_likely_size(diagonal)) {
    std::vector<std::string_view> likely;
    for (const auto& [unit, name] : enum_names(FileUnit{}))
      if (is_likely_size(metres(unit) * diagonal)) likely.push_back(name);
    sentences.push_back(fmt::format("{:.3g} m is an unlikely size{}", diagonal,
                                    likely.empty()
                                        ? std::string("; --set shape.size=1 gives it another")
                                        : fmt::format("; say --units {} where that is meant",
                                                      fmt::join(likely, " or --units "))));
  }
  return sentences;
}

std::string inspect_text(const InspectRun& run) {
  Buffer text;
  const Inspection& found = run.inspection;
  add_shape(run, text);
  add_size(run, text);
  if (found.mesh) {
    add_surface(*found.mesh, text);
    add_components(*found.mesh, text);
  }
  if (found.points) add_points(*found.points, text);
  add_solid(found.verdict, text);
  if (found.thin) add_thickness(*found.thin, found.box, text);
  std::string_view label = "advice";
  for (const std::string& sentence : advice(run)) {
    line(text, label, "{}", sentence);
    label = "";
  }
  if (run.selected) add_selection(run, text);
  for (const std::string& path : run.outputs) line(text, "wrote", "{}", one_line(path));
  return fmt::to_string(text);
}

}  // namespace supple
