#include "io/import/child_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace supple {
namespace {

/// A pipe from the child; its ends close themselves.
class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0) ends_ = {-1, -1};
  }
  ~Pipe() {
    close_reader();
    close_writer();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int reader() const { return ends_[0]; }
  int writer() const { return ends_[1]; }
  void close_reader() { close(ends_[0]); }
  void close_writer() { close(ends_[1]); }

 private:
  static void close(int& end) {
    if (end >= 0) ::close(std::exchange(end, -1));
  }
  std::array<int, 2> ends_{-1, -1};
};

/// Only the first of what a child says on standard error is of use.
constexpr std::size_t most_error_bytes = 1 << 16;

class Child {
 public:
  Child(const std::vector<std::string>& words, const ChildLimits& limits)
      : limits_(limits),
        end_of_time_(Clock::now() + std::chrono::duration_cast<Clock::duration>(limits.time)) {
    start(words);
  }
  ~Child() {
    if (process_ > 0) kill_and_wait();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  ChildResult run() {
    if (result_.end == ChildEnd::cannot_start) return std::move(result_);
    while (result_.end == ChildEnd::done && (out_.reader() >= 0 || err_.reader() >= 0))
      wait_for_bytes();
    finish();
    return std::move(result_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  void start(const std::vector<std::string>& words) {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, out_.writer(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err_.writer(), STDERR_FILENO);
    const int error =
        out_.writer() < 0 || err_.writer() < 0
            ? EMFILE
            : ::posix_spawn(&process_, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    out_.close_writer();
    err_.close_writer();
    if (error == 0) return;
    process_ = 0;
    result_.end = ChildEnd::cannot_start;
    result_.code = error;
  }

  void wait_for_bytes() {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(end_of_time_ - Clock::now()).count();
    if (left <= 0) {
      result_.end = ChildEnd::too_long;
      return;
    }
    std::array<pollfd, 2> pipes{{{out_.reader(), POLLIN, 0}, {err_.reader(), POLLIN, 0}}};
    constexpr long long longest_wait = 60'000;
    if (::poll(pipes.data(), pipes.size(),
               static_cast<int>(std::min<long long>(left, longest_wait))) < 0)
      return;  // a signal; there is time for another look
    if (pipes[0].revents != 0) take(out_, result_.out, limits_.output_bytes);
    if (pipes[1].revents != 0) take(err_, result_.err, most_error_bytes);
  }

  void take(Pipe& pipe, std::string& bytes, std::size_t most) {
    std::array<char, 1 << 16> buffer;
    const ssize_t got = ::read(pipe.reader(), buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) return;
    if (got <= 0) return pipe.close_reader();
    const auto count = static_cast<std::size_t>(got);
    if (&bytes == &result_.out && count > most - bytes.size()) result_.end = ChildEnd::too_much;
    bytes.append(buffer.data(), std::min(count, most - bytes.size()));
  }

  void finish() {
    if (result_.end != ChildEnd::done) return kill_and_wait();
    const int status = wait_for_end();
    if (result_.end != ChildEnd::done) return;
    if (WIFSIGNALED(status)) result_.end = ChildEnd::killed;
    result_.code = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
  }

  /// A child may close its pipes and still not end.
  int wait_for_end() {
    int status = 0;
    for (;;) {
      const pid_t ended = ::waitpid(process_, &status, WNOHANG);
      if (ended == process_ || (ended < 0 && errno != EINTR)) {
        if (ended < 0) result_.end = ChildEnd::unknown;
        process_ = 0;
        return status;
      }
      if (Clock::now() > end_of_time_) {
        result_.end = ChildEnd::too_long;
        kill_and_wait();
        return 0;
      }
      ::usleep(1000);
    }
  }

  void kill_and_wait() {
    ::kill(process_, SIGKILL);
    while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
    process_ = 0;
  }

  ChildLimits limits_;
  Clock::time_point end_of_time_;
  Pipe out_, err_;
  pid_t process_ = 0;
  ChildResult result_;
};

}  // namespace

ChildResult run_child(const std::vector<std::string>& words, const ChildLimits& limits) {
  return Child(words, limits).run();
}

}  // namespace supple
