#include <fmt/format.h>

#include "modeler/cli/commands.h"
#include "modeler/cli/report_json.h"
#include "modeler/cli/scene_arguments.h"
#include "modeler/cli/summary.h"

namespace supple {
namespace {

constexpr const char* description =
    "Says which effects a scene calls for, and which of its lines asks for each. Solves nothing.";

constexpr const char* examples = R"(Examples:
  supple plan scene.yaml
  supple plan bunny.obj --fix 'y<10%' --move 'y>85%' --by 15%,0,0 --json)";

}  // namespace

int run_plan(Words words) {
  SceneArguments scene;
  bool json = false;
  CommandLine line("supple plan", description);
  scene.declare(line);
  line.begin_group("Output");
  line.flag("--json", "as JSON", [&] { json = true; });
  line.examples(examples);
  if (!line.parse(words)) return exit_done;
  const Plan plan = make_plan(scene.take());
  fmt::print("{}", json ? plan_json(plan) : effects_table(plan.effects));
  return exit_done;
}

}  // namespace supple
