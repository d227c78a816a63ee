#include <cstdio>

#include <fmt/format.h>

#include "io/mesh/mesh_files.h"
#include "modeler/cli/commands.h"
#include "modeler/cli/interrupt.h"
#include "modeler/cli/likely_size.h"
#include "modeler/cli/messages.h"
#include "modeler/cli/pose_arguments.h"
#include "modeler/cli/pose_files_reader.h"
#include "modeler/cli/progress_line.h"
#include "modeler/cli/read_shape.h"
#include "modeler/cli/report_json.h"
#include "modeler/cli/summary.h"
#include "modeler/domain/shape_error.h"
#include "solver/core/stopwatch.h"

namespace supple {
namespace {

constexpr Color held_color{0.10f, 0.30f, 0.75f}, moved_color{0.85f, 0.05f, 0.05f};

PoseResult solve(const Mesh& shape, const Scene& scene, const PoseFiles& files,
                 ProgressLine& line) {
  const Progress progress = [&](const std::string& stage, double share) {
    line.show(stage, share);
    return InterruptWatch::signal() == 0;
  };
  PoseResult result = pose(shape, scene, progress, files);
  line.clear();
  for (std::string& note : size_notes(result.rest, scene.shape))
    result.report.notes.push_back(std::move(note));
  result.report.notes.insert(result.report.notes.begin(), shape.notes.begin(), shape.notes.end());
  return result;
}

/// The handles' samples at `points`: those that stay in blue, those that move in red.
std::vector<Markers> handle_markers(const Points& points, const PoseResult& result) {
  std::vector<Index> held, moved;
  const double still = 1e-9 * bounding_box(result.rest.positions).diagonal();
  for (Index i = 0; i < points.rows(); ++i) {
    const double way = (result.handle_targets.row(i) - result.handle_start.row(i)).norm();
    (way <= still ? held : moved).push_back(i);
  }
  return {{points(held, Eigen::all), held_color}, {points(moved, Eigen::all), moved_color}};
}

void write_picture(const PoseResult& result, const PoseArguments& arguments) {
  PictureItem before, after;
  before.mesh = &result.rest;
  before.label = "before";
  before.markers = handle_markers(result.handle_rest, result);
  after.mesh = &result.mesh;
  after.label = "after";
  after.markers = handle_markers(result.handle_targets, result);
  write_png(render({before, after}, arguments.picture_view.options()), arguments.picture);
}

void write_outputs(const PoseArguments& arguments, const Scene& scene, ProgressLine& line,
                   PoseRun& run) {
  const Stopwatch watch;
  line.show("write", 0);
  InterruptWatch::check();
  if (!arguments.mesh.empty()) {
    const std::string format = arguments.mesh_format(scene.shape.file());
    for (std::string& sentence : left_out_by(arguments.mesh, run.result->mesh, format))
      run.result->report.notes.push_back(std::move(sentence));
    write_mesh(run.result->mesh, arguments.mesh, format);
    run.outputs.push_back(arguments.mesh);
  }
  InterruptWatch::check();
  if (!arguments.picture.empty()) {
    write_picture(*run.result, arguments);
    run.outputs.push_back(arguments.picture);
  }
  line.clear();
  run.write_seconds = watch.seconds();
}

void print(const PoseRun& run, std::FILE* stream) {
  for (const std::string& note : run.result->report.notes) tell("note", note);
  fmt::print(stream, "{}", summary(run));
}

/// Whether the run ends well; says on standard error why it does not.
bool judge(const Report& report, const Allowance& allowance) {
  if (report.usable() && allowance.covers(report)) return true;
  for (const Reason& reason : report.reasons)
    tell("supple", fmt::format("{}: {}", enum_name(reason.code), reason.detail));
  tell("supple", report.usable() ? "the pose is degraded, but written; --allow-degraded accepts it"
                                 : "the pose failed; nothing is written");
  return false;
}

}  // namespace

int run_pose(Words words) {
  PoseArguments arguments;
  if (!arguments.parse(words)) return exit_done;
  const InterruptWatch interrupts;
  arguments.run.limit_threads();
  ProgressLine line(arguments.run.quiet ? ProgressLine::Mode::silent
                                        : ProgressLine::Mode::if_terminal);
  const Stopwatch watch;
  PoseRun run;
  run.input = arguments.scene.path();
  Scene scene = arguments.scene.take();
  if (!scene.pose) scene.pose.emplace().place = scene.shape.place;
  arguments.check_outputs();
  line.show("load", 0);
  const Mesh shape = read_shape(scene);
  const PoseFiles files = read_pose_files(scene, shape.positions.rows());
  run.load_seconds = watch.seconds();

  const auto write_report = [&] {
    run.total_seconds = watch.seconds();
    if (!arguments.report.empty()) write_text(report_json(run), arguments.report);
  };
  try {
    run.result = solve(shape, scene, files, line);
  } catch (const ShapeError& error) {
    run.failure = error.what();
    write_report();
    throw;
  }
  if (run.result->report.usable()) write_outputs(arguments, scene, line, run);
  write_report();
  if (!arguments.report.empty()) run.outputs.push_back(arguments.report);
  if (!arguments.run.quiet)
    print(run, text_stream({arguments.mesh, arguments.picture, arguments.report}));
  std::fflush(stdout);
  return judge(run.result->report, arguments.allowance) ? exit_done : exit_failed;
}

}  // namespace supple
