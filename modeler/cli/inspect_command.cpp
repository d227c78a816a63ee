#include <filesystem>

#include <fmt/format.h>

#include "io/mesh/mesh_files.h"
#include "io/output_file.h"
#include "io/picture/axes.h"
#include "modeler/cli/commands.h"
#include "modeler/cli/inside_arguments.h"
#include "modeler/cli/inspect_run.h"
#include "modeler/cli/interrupt.h"
#include "modeler/cli/messages.h"
#include "modeler/cli/picture_arguments.h"
#include "modeler/cli/progress_line.h"
#include "modeler/cli/report_json.h"
#include "modeler/cli/run_arguments.h"
#include "modeler/domain/shape_error.h"
#include "solver/core/stopwatch.h"

namespace supple {
namespace {

constexpr const char* description =
    "Says what a shape file holds: counts, size, whether its surface is closed or which defects it "
    "has and where, its parts, how thin they are, and whether it can be posed.";

constexpr const char* examples = R"(Examples:
  supple inspect bunny.obj
  supple inspect bunny.obj --json --particles 500
  supple inspect bunny.obj --select 'y>85%' -o bunny.png
  supple inspect bunny.obj --show slice -o inside.png)";

constexpr Color selected_color{0.85f, 0.05f, 0.05f};

struct InspectArguments {
  std::string file, selection, picture, report;
  bool json = false;
  InsideArguments inside;
  PictureArguments picture_view;
  RunArguments run;

  bool parse(Words words) {
    CommandLine line("supple inspect", description);
    line.positional("FILE",
                    fmt::format("a mesh or a point cloud ({}; others by assimp)", mesh_formats()),
                    [this](const std::string& value) { file = value; });
    line.option("--select", {"SELECTION", "say what this part of the surface is, and mark it"},
                [this](const std::string& value) { selection = value; });
    inside.declare(line);
    line.begin_group("Output");
    line.flag("--json", "as JSON", [this] { json = true; });
    line.option("--report", {"FILE.json", "the same JSON into a file"},
                [this](const std::string& value) { report = value; });
    line.option("-o,--output", {"FILE.png", "a picture, with the axes that selections count along"},
                [this](const std::string& value) { picture = value; });
    picture_view.declare(line);
    run.declare(line);
    line.examples(examples);
    if (!line.parse(words)) return false;
    check();
    return true;
  }

  void check() const {
    if (!picture.empty()) check_picture_name(picture, "-o");
    if (picture.empty() && inside.shown())
      throw UsageError("--show needs a picture; give -o FILE.png");
    if (!picture.empty() && picture == report)
      throw UsageError(fmt::format("{} is named for two outputs", picture));
    for (const std::string& path : {picture, report})
      if (!path.empty()) check_writable(path);
  }
};

/// The shape with its axes, what was selected, and its inside where that is asked for.
PictureItem make_item(const InspectArguments& arguments, const ShapeSpec& spec,
                      const InspectRun& run) {
  const Camera& camera = arguments.picture_view.options().camera;
  PictureItem item;
  item.mesh = &run.mesh;
  item.label = std::filesystem::path(run.input).filename().string();
  if (arguments.inside.shown()) {
    if (!run.inspection.verdict.poses()) throw ShapeError(run.inspection.verdict.reason);
    show_inside(*arguments.inside.shown(), *run.inspection.verdict.solid, spec, camera, item);
  }
  if (run.selected) item.markers.push_back({run.selected->samples, selected_color});
  add_axes(run.inspection.box, camera, item);
  return item;
}

}  // namespace

int run_inspect(Words words) {
  InspectArguments arguments;
  if (!arguments.parse(words)) return exit_done;
  const ShapeSpec spec = arguments.inside.spec();
  std::optional<Selection> selection;
  if (!arguments.selection.empty()) selection = parse_selection(arguments.selection, {"--select"});

  const InterruptWatch interrupts;
  arguments.run.limit_threads();
  ProgressLine line(arguments.run.quiet ? ProgressLine::Mode::silent
                                        : ProgressLine::Mode::if_terminal);
  const Stopwatch watch;
  const auto on_stage = [&](const std::string& stage) {
    InterruptWatch::check();
    line.show(stage, 0);
  };
  InspectRun run;
  run.input = arguments.file;
  on_stage("load");
  run.mesh = read_mesh(arguments.file);
  run.load_seconds = watch.seconds();
  run.inspection = inspect(run.mesh, spec, on_stage);
  if (selection) {
    run.selection = arguments.selection;
    run.selected = select_part(run.mesh, run.inspection, *selection, {});
  }
  if (!arguments.picture.empty()) {
    on_stage("picture");
    write_png(render({make_item(arguments, spec, run)}, arguments.picture_view.options()),
              arguments.picture);
    run.outputs.push_back(arguments.picture);
  }
  run.total_seconds = watch.seconds();
  if (!arguments.report.empty()) {
    write_text(inspect_json(run), arguments.report);
    run.outputs.push_back(arguments.report);
  }
  line.clear();
  std::FILE* const stream = text_stream({arguments.picture, arguments.report});
  if (arguments.json)
    fmt::print(stream, "{}", inspect_json(run));
  else if (!arguments.run.quiet)
    fmt::print(stream, "{}", inspect_text(run));
  return exit_done;
}

}  // namespace supple
