#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <span>
#include <string_view>
#include <system_error>
#include <typeinfo>
#include <vector>

#include <cxxabi.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "io/errors.h"
#include "io/scene/complaint.h"
#include "io/unfinished.h"
#include "modeler/cli/commands.h"
#include "modeler/cli/interrupt.h"
#include "modeler/cli/messages.h"
#include "modeler/domain/shape_error.h"
#include "modeler/pose/pose.h"
#include "solver/core/arithmetic.h"
#include "solver/core/check.h"
#include "solver/core/installation_error.h"

namespace supple {
namespace {

struct Command {
  std::string_view name;
  int (*run)(Words);  ///< null: not available yet
  std::string_view summary;
};

constexpr std::array<Command, 9> commands{{
    {"pose", run_pose, "deform a shape by handles"},
    {"inspect", run_inspect, "what a shape file holds, and whether it can be posed"},
    {"render", run_render, "draw a mesh into a picture"},
    {"plan", run_plan, "which effects a scene calls for, and why"},
    {"study", run_study, "what accuracy costs in time, for a scene"},
    {"animate", nullptr, ""},
    {"simulate", nullptr, ""},
    {"modes", nullptr, ""},
    {"convert", nullptr, ""},
}};

std::string help() {
  std::string text =
      "Supple poses shapes with physical energies, without meshing their inside.\n\n"
      "Usage: supple COMMAND ...\n\nCommands:\n";
  for (const Command& command : commands)
    if (command.run) text += fmt::format("  {:<8} {}\n", command.name, command.summary);
  return text +
         "\nsupple COMMAND --help says more; supple --version prints the version.\n\n"
         "Example:\n"
         "  supple pose bunny.obj --fix 'y<10%' --move 'y>85%' --by 15%,0,0 -o posed.obj\n";
}

int dispatch(const std::string& name, Words words) {
  std::vector<std::string_view> names;
  for (const Command& command : commands) {
    if (command.run) names.push_back(command.name);
    if (command.name != name) continue;
    if (!command.run) throw UsageError(fmt::format("{} is not available yet", name));
    return command.run(words);
  }
  throw UsageError(
      fmt::format("{} is not a command{}", in_quotes(name), allowed_names(name, names)));
}

int run(const std::vector<std::string>& words) {
  if (words.empty()) {
    fmt::print(stderr, "{}", help());
    return exit_usage;
  }
  const std::string& first = words.front();
  if (first == "--help" || first == "-h" || first == "help") {
    fmt::print("{}", help());
    return exit_done;
  }
  if (first == "--version") {
    fmt::print("supple {}\n", SUPPLE_VERSION);
    return exit_done;
  }
  return dispatch(first, Words(words).subspan(1));
}

/// Text that is still on its way to standard output must arrive.
int flushed(int code) {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw OutputError("standard output: cannot be written");
  return code;
}

int report_error(std::string_view message, int code) {
  tell("supple", message);
  return code;
}

int report_bug(std::string_view message) {
  tell("supple", message);
  return report_error(
      "this is a bug in Supple, not in what you asked; please report it with the command that "
      "led here",
      exit_failed);
}

/// What fails once a signal came fails for it.
int report_unless_stopped(const std::exception& error, int code) {
  const int signal = InterruptWatch::signal();
  return report_error(error.what(), signal == 0 ? code : 128 + signal);
}

constexpr std::string_view no_memory =
    "the memory of this machine does not suffice; fewer particles and fewer --threads need less";

/// At once: the clean-up of libraries needs memory, or waits for threads that never had any.
[[noreturn]] void leave_without_memory() {
  Unfinished::remove_all();
  tell("supple", no_memory);
  std::fflush(stdout);
  ::_exit(exit_failed);
}

/// What oneTBB throws where the system grants no further thread.
bool lacks_threads(const std::exception& error) {
  return std::string_view(error.what()).starts_with("pthread_create");
}

/// Where an exception cannot get out, as one that a library throws as it cleans up.
[[noreturn]] void end_in_the_middle() {
  const std::type_info* thrown = abi::__cxa_current_exception_type();
  if (!thrown || *thrown != typeid(std::bad_alloc)) std::abort();
  leave_without_memory();
}

int run_and_map_errors(std::span<char*> words) {
  try {
    return flushed(run({words.begin(), words.end()}));
  } catch (const UsageError& error) {
    return report_error(error.what(), exit_usage);
  } catch (const InputError& error) {
    return report_unless_stopped(error, exit_file);
  } catch (const ImporterError& error) {
    return report_unless_stopped(error, exit_importer);
  } catch (const OutputError& error) {
    return report_unless_stopped(error, exit_file);
  } catch (const InstallationError& error) {
    return report_error(error.what(), exit_file);
  } catch (const ShapeError& error) {
    return report_error(error.what(), exit_failed);
  } catch (const Interrupted& error) {
    return report_error(error.what(), 128 + InterruptWatch::signal());
  } catch (const std::bad_alloc&) {
    leave_without_memory();
  } catch (const std::system_error& error) {  // a file or a stream that broke
    return report_unless_stopped(error, exit_file);
  } catch (const std::exception& error) {
    if (lacks_threads(error)) leave_without_memory();
    return report_bug(error.what());
  }
}

volatile std::sig_atomic_t code_to_leave_with = 0;

/// Ends the program soon, also where the clean-up of libraries hangs, as that of OpenBLAS does
/// whose threads got no memory.
int leave(int code) {
  constexpr unsigned seconds = 5;
  code_to_leave_with = code;
  std::signal(SIGALRM, [](int) { ::_exit(code_to_leave_with); });
  ::alarm(seconds);
  return code;
}

/// No file may get the number of a standard stream that the caller closed: what is said would go
/// into it. What stands in for one refuses to be read or written, as a closed one does.
void replace_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0)
      ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

}  // namespace
}  // namespace supple

int main(int count, char** words) {
  std::signal(SIGCHLD, SIG_DFL);  // callers may have it ignored; the importer's end is to be told
  std::signal(SIGXFSZ, SIG_IGN);  // a file beyond the limit for files is an error as others are
  std::set_terminate(supple::end_in_the_middle);
  supple::replace_closed_streams();
  const supple::PlainArithmetic arithmetic;
  return supple::leave(supple::run_and_map_errors({words + std::min(count, 1), words + count}));
}
