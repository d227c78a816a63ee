#include "modeler/cli/pose_arguments.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "io/mesh/mesh_files.h"
#include "io/output_file.h"
#include "io/scene/complaint.h"

namespace supple {
namespace {

constexpr const char* description =
    "Deforms a shape: parts of its surface are held or led elsewhere, the rest follows and keeps "
    "its shape and volume.";

constexpr const char* examples =
    R"(Selections: y<10%   x>0.2   y:85%..   box(0,0,0,1,1,1)   sphere(0,0,0,1)
  nearest(0,1,0)   vertices(FILE)   group(NAME), joined by and, or, not.
  In quotes, for the shell. Percents in a selection are of the shape's box along
  that axis, elsewhere of the box's diagonal.

Examples:
  supple pose bunny.obj --fix 'y<10%' --move 'y>85%' --by 15%,0,0 -o posed.obj
  supple pose bunny.obj --fix 'y<10%' --move 'y>85%' --turn 0,1,0,30 --picture posed.png
  supple pose bunny.obj --fix 'y<10%' --move 'y>85%' --by 0,5%,0 --scale 1.1 -o posed.ply
  supple pose bunny.obj --region 'y>50%' --move 'y>85%' --by 5%,0,0 -o posed.obj
  supple pose scene.yaml -o posed.obj --report posed.json --set pose.weights.volume=10)";

void check_distinct(const std::vector<std::string>& paths) {
  for (std::size_t i = 0; i < paths.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!paths[i].empty() && !paths[j].empty() &&
          std::filesystem::weakly_canonical(paths[i]) ==
              std::filesystem::weakly_canonical(paths[j]))
        throw UsageError(fmt::format("{} is named for two outputs", paths[i]));
}

}  // namespace

bool Allowance::covers(const Report& report) const {
  const auto covered = [&](const Reason& reason) {
    return everything || std::find(reasons.begin(), reasons.end(), reason.code) != reasons.end();
  };
  return std::all_of(report.reasons.begin(), report.reasons.end(), covered);
}

bool PoseArguments::parse(Words words) {
  CommandLine line("supple pose", description);
  scene.declare(line);
  declare_outputs(line);
  picture_view.declare(line);
  run.declare(line);
  line.option_with_optional_value(
      "--allow-degraded", {"REASON,...", "end well in spite of these losses of quality, or of all"},
      [this](const std::string& value) { allow(value); });
  line.examples(examples);
  if (!line.parse(words)) return false;
  check();
  return true;
}

void PoseArguments::declare_outputs(CommandLine& line) {
  line.begin_group("Output");
  line.option("-o,--output",
              {"FILE", fmt::format("the posed mesh ({}); - is standard output", mesh_formats())},
              [this](const std::string& value) { mesh = value; });
  line.option("--format", {"NAME", "the mesh's format, where its name does not say"},
              [this](const std::string& value) { format = value; });
  line.option("--picture", {"FILE.png", "the shape before and after, with its handles"},
              [this](const std::string& value) { picture = value; });
  line.option("--report", {"FILE.json", "what the run did, and how well"},
              [this](const std::string& value) { report = value; });
}

void PoseArguments::allow(const std::string& reasons) {
  allowance.everything = reasons.empty();
  std::vector<std::string_view> names;
  for (const auto& [code, name] : enum_names(ReasonCode{})) names.push_back(name);
  for (std::size_t start = 0; start < reasons.size();) {
    const std::size_t end = std::min(reasons.find(',', start), reasons.size());
    const std::string wanted = reasons.substr(start, end - start);
    const auto found = std::find(names.begin(), names.end(), wanted);
    if (found == names.end())
      throw UsageError(fmt::format("--allow-degraded: {} is not a reason{}", in_quotes(wanted),
                                   allowed_names(wanted, names)));
    allowance.reasons.push_back(enum_names(ReasonCode{})[found - names.begin()].first);
    start = end + 1;
  }
}

void PoseArguments::check() const {
  if (mesh.empty() && picture.empty() && report.empty())
    throw UsageError("nothing to write; give -o FILE, --picture FILE.png or --report FILE.json");
  if (!format.empty() && !can_write_mesh("x." + format))
    throw UsageError(fmt::format("--format {}: not a mesh format that can be written; allowed: {}",
                                 in_quotes(format), mesh_formats()));
  if (!mesh.empty() && mesh != "-" && format.empty() && !can_write_mesh(mesh))
    throw UsageError(fmt::format("-o {}: not a mesh format that can be written; allowed: {}", mesh,
                                 mesh_formats()));
  if (!picture.empty()) check_picture_name(picture, "--picture");
  check_distinct({mesh, picture, report});
}

std::string PoseArguments::mesh_format(const std::filesystem::path& input) const {
  if (!format.empty() || mesh != "-") return format;
  return can_write_mesh(input) ? input.extension().string().substr(1) : "obj";
}

void PoseArguments::check_outputs() const {
  for (const std::string& path : {mesh, picture, report})
    if (!path.empty()) check_writable(path);
}

}  // namespace supple
