#include <algorithm>
#include <array>
#include <cstdio>

#include <fmt/format.h>

#include "io/output_file.h"
#include "io/scene/complaint.h"
#include "io/scene/scene_hash.h"
#include "modeler/cli/commands.h"
#include "modeler/cli/interrupt.h"
#include "modeler/cli/machine.h"
#include "modeler/cli/messages.h"
#include "modeler/cli/output_folder.h"
#include "modeler/cli/pose_files_reader.h"
#include "modeler/cli/progress_line.h"
#include "modeler/cli/read_shape.h"
#include "modeler/cli/report_json.h"
#include "modeler/cli/study_arguments.h"
#include "modeler/cli/study_chart.h"
#include "modeler/study/pose_trial.h"
#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"

namespace supple {
namespace {

constexpr std::array<const char*, 5> files{"study.csv", "study.json", "study.svg", "study.png",
                                           "study.html"};

void check_scene(const Scene& scene) {
  if (!scene.pose)
    complain(scene.shape.place, "pose is missing: a study poses the shape with other values");
  if (scene.pose->handles.empty())
    complain(scene.pose->place,
             "pose.handles is empty: nothing moves; allowed: one handle or more, also as --move");
}

void check_outputs(const OutputFolder& folder, const std::string& report) {
  for (const char* file : files) check_writable(folder / file);
  if (!report.empty()) check_writable(report);
}

/// One hash of what is computed: the scene's values and the shape's vertices and faces.
std::uint64_t hash_of(const Scene& scene, const Mesh& shape) {
  const std::span positions(shape.positions.data(),
                            static_cast<std::size_t>(shape.positions.size()));
  const std::uint64_t points = hash_bytes(std::as_bytes(positions), scene_hash(scene));
  return hash_bytes(std::as_bytes(std::span(shape.face_vertices)), points);
}

/// Poses the scene with a setting, watched by the terminal and by its memory.
Runner pose_runner(const Mesh& shape, const Scene& scene, const PoseFiles& files) {
  return [&](const SceneOverrides& settings, double most_seconds) {
    InterruptWatch::check();
    forget_peak_memory();
    TrialOutcome outcome =
        run_pose_trial(shape, scene, files, settings, most_seconds,
                       [](const std::string&, double) { return InterruptWatch::signal() == 0; });
    outcome.peak_bytes = peak_memory();
    return outcome;
  };
}

/// The study, then what the user wishes to be found.
void run_all(const StudyArguments& arguments, const Mesh& shape, const Scene& scene,
             StudyRun& run) {
  const std::vector<Knob> knobs = collect_knobs(scene, arguments.levels);
  const std::vector<Knob> chosen = choose_knobs(knobs, arguments.knobs, "--knobs");
  const PoseFiles pose_files = read_pose_files(scene, shape.positions.rows());
  const Runner runner = pose_runner(shape, scene, pose_files);
  ProgressLine line(arguments.run.quiet ? ProgressLine::Mode::silent
                                        : ProgressLine::Mode::if_terminal);
  SweepOptions options;
  options.budget = arguments.budget;
  options.progress = [&](const std::string& setting, double share) { line.show(setting, share); };
  run.study = study(knobs, chosen, runner, options);
  if (arguments.target_error) {
    line.show("verify", 0);
    run.for_error = {*arguments.target_error,
                     choose_for_error(run.study, chosen, runner, *arguments.target_error)};
  }
  if (arguments.time_budget)
    run.for_time = {*arguments.time_budget, choose_for_time(run.study, *arguments.time_budget)};
}

void write_outputs(const StudyRun& run, const OutputFolder& folder, const std::string& report) {
  const Sketch chart = study_chart(run);
  const std::string json = study_json(run);
  InterruptWatch::check();
  write_text(study_csv(run), folder / "study.csv");
  write_text(json, folder / "study.json");
  write_text(svg(chart), folder / "study.svg");
  write_png(rasterize(chart), folder / "study.png");
  write_text(study_html(run), folder / "study.html");
  if (!report.empty()) write_text(json, report);
}

bool has_result(const Study& study) {
  return std::any_of(study.rows.begin(), study.rows.end(),
                     [](const StudyRow& row) { return row.error.has_value(); });
}

}  // namespace

int run_study(Words words) {
  StudyArguments arguments;
  if (!arguments.parse(words)) return exit_done;
  const InterruptWatch interrupts;
  arguments.run.limit_threads();
  const Stopwatch watch;
  Scene scene = arguments.scene.take();
  check_scene(scene);
  choose_knobs(collect_knobs(scene, arguments.levels), arguments.knobs, "--knobs");
  const OutputFolder folder(arguments.folder);
  check_outputs(folder, arguments.report);

  StudyRun run;
  run.input = arguments.scene.path();
  run.processor = processor_name();
  run.build = SUPPLE_BUILD;
  run.threads = thread_count(arguments.run.threads);
  const Mesh shape = read_shape(scene);
  run.notes = shape.notes;
  run.scene_hash = hash_of(scene, shape);
  if (scene.shape.spacing)
    run.notes.push_back("shape.spacing is given: the study counts in particles instead");
  scene = with_counted_particles(std::move(scene), shape);
  run_all(arguments, shape, scene, run);
  run.total_seconds = watch.seconds();

  write_outputs(run, folder, arguments.report);
  for (const std::string& note : run.notes)
    if (!arguments.run.quiet) tell("note", note);
  if (!arguments.run.quiet) fmt::print("{}", study_text(run));
  std::fflush(stdout);
  if (has_result(run.study)) return exit_done;
  fmt::print(stderr, "supple: no setting came to an error that could be measured\n");
  return exit_failed;
}

}  // namespace supple
