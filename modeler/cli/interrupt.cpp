#include "modeler/cli/interrupt.h"

#include <csignal>
#include <string_view>

#include <unistd.h>

#include "io/unfinished.h"
#include "modeler/pose/pose.h"

namespace supple {
namespace {

// A signal handler has nothing else to write to.
volatile std::sig_atomic_t received = 0;

constexpr unsigned seconds_to_end = 1;

/// Ends a run that is busy where it asks for no signal.
void end_now(int) {
  constexpr std::string_view message = "supple: stopped by a signal\n";
  Unfinished::remove_all();
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, message.data(), message.size());
  ::_exit(128 + received);
}

void remember(int signal) {
  const bool again = received != 0;
  received = signal;
  if (again) end_now(signal);
  ::alarm(seconds_to_end);
}

/// Signals that the caller has ignored (nohup, a shell's background) stay so.
void handle_stops(void (*handler)(int)) {
  struct sigaction action = {}, old;
  action.sa_handler = handler;
  // Without SA_RESTART: who waits for a pipe's other end is to wait no longer.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT})
    if (sigaction(signal, nullptr, &old) == 0 && old.sa_handler != SIG_IGN)
      sigaction(signal, &action, nullptr);
}

/// Stays until the program ends: that may take its time too.
void handle_alarm() {
  struct sigaction action = {};
  action.sa_handler = end_now;
  sigaction(SIGALRM, &action, nullptr);
}

}  // namespace

InterruptWatch::InterruptWatch() {
  handle_alarm();
  handle_stops(remember);
}
InterruptWatch::~InterruptWatch() {
  handle_stops(SIG_DFL);
}

int InterruptWatch::signal() {
  return received;
}

void InterruptWatch::check() {
  if (received != 0) throw Interrupted("stopped by a signal");
}

}  // namespace supple
