#include <filesystem>

#include <fmt/format.h>

#include "io/mesh/mesh_files.h"
#include "io/output_file.h"
#include "modeler/cli/commands.h"
#include "modeler/cli/inside_arguments.h"
#include "modeler/cli/interrupt.h"
#include "modeler/cli/messages.h"
#include "modeler/cli/picture_arguments.h"
#include "modeler/cli/run_arguments.h"

namespace supple {
namespace {

constexpr const char* examples = R"(Examples:
  supple render bunny.obj -o bunny.png
  supple render bunny.obj -o bunny.png --camera 120,20,1.5 --size 800x600
  supple render bunny.obj -o inside.png --show particles --particles 500)";

}  // namespace

int run_render(Words words) {
  std::string file, output;
  InsideArguments inside;
  PictureArguments view;
  RunArguments run;
  CommandLine line("supple render", "Draws a mesh into a picture.");
  line.positional("FILE",
                  fmt::format("a mesh or a point cloud ({}; others by assimp)", mesh_formats()),
                  [&](const std::string& value) { file = value; });
  line.begin_group("Output");
  line.option("-o,--output", {"FILE.png", "the picture; needed"},
              [&](const std::string& value) { output = value; });
  inside.declare(line);
  view.declare(line);
  run.declare(line);
  line.examples(examples);
  if (!line.parse(words)) return exit_done;
  if (output.empty()) throw UsageError("nothing to write; give -o FILE.png");
  check_picture_name(output, "-o");
  const ShapeSpec spec = inside.spec();
  if (inside.has_particles() && !inside.shown())
    throw UsageError("--particles and --spacing: only together with --show");

  const InterruptWatch interrupts;
  run.limit_threads();
  check_writable(output);
  const Mesh mesh = read_mesh(file);
  InterruptWatch::check();
  PictureItem item;
  item.mesh = &mesh;
  item.label = std::filesystem::path(file).filename().string();
  if (inside.shown()) {
    Solid solid(mesh, spec);
    show_inside(*inside.shown(), solid, spec, view.options().camera, item);
  }
  const Picture picture = render({item}, view.options());
  InterruptWatch::check();
  write_png(picture, output);
  if (!run.quiet) {
    for (const std::string& note : mesh.notes) tell("note", note);
    fmt::print(text_stream({output}), "{} vertices, {} faces; wrote {}\n", mesh.positions.rows(),
               mesh.face_count(), one_line(output));
  }
  return exit_done;
}

}  // namespace supple
