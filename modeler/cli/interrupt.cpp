#include "modeler/cli/interrupt.h"

#include <csignal>

#include "modeler/pose/pose.h"

namespace supple {
namespace {

// A signal handler has nothing else to write to.
volatile std::sig_atomic_t received = 0;

void remember(int signal) {
  received = signal;
}

void handle_both(void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  // Without SA_RESTART: who waits for a pipe's other end is to wait no longer.
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

InterruptWatch::InterruptWatch() {
  handle_both(remember);
}
InterruptWatch::~InterruptWatch() {
  handle_both(SIG_DFL);
}

int InterruptWatch::signal() {
  return received;
}

void InterruptWatch::check() {
  if (received != 0) throw Interrupted("stopped by a signal");
}

}  // namespace supple
