#include "modeler/cli/run_arguments.h"

#include "modeler/cli/values.h"
#include "solver/core/parallel.h"

namespace supple {
namespace {

constexpr int most_threads = 1024;

}  // namespace

void RunArguments::declare(CommandLine& line) {
  line.begin_group("Run");
  line.option("--threads", {"N", "threads to work with (default: all); results are the same"},
              [this](const std::string& value) {
                threads = parse_count(value, "--threads", 1, most_threads);
              });
  line.flag("--quiet", "print nothing but errors", [this] { quiet = true; });
}

void RunArguments::limit_threads() const {
  // Never taken back: oneTBB needs memory for that, and ends the program where there is none.
  static const ThreadLimit* const limit = new ThreadLimit(threads);
  static_cast<void>(limit);
}

}  // namespace supple
