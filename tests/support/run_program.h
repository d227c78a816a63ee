#pragma once

#include <chrono>
#include <csignal>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/temporary_folder.h"

namespace supple {

/// What a program said and how it ended.
struct ProgramResult {
  int code = -1;  ///< exit code; 128 + n where signal n killed it
  std::string out, err;
  double seconds = 0;     ///< from its start to its end
  double peak_bytes = 0;  ///< of memory, resident
};

/// A program that was started in `folder`, with what it says going to files there, the signals that
/// end it as usual, and `variables` ("NAME=value") before those of this process.
class Program {
 public:
  Program(const std::string& file, std::vector<std::string> words, std::filesystem::path folder,
          std::vector<std::string> variables = {})
      : folder_(std::move(folder)) {
    words.insert(words.begin(), file);
    std::vector<char*> arguments = pointers_to(words), environment = pointers_to(variables);
    arguments.push_back(nullptr);
    for (char** variable = environ; *variable; ++variable) environment.push_back(*variable);
    environment.push_back(nullptr);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t usual;
    sigfillset(&usual);
    posix_spawnattr_setsigdefault(&attributes, &usual);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder_.c_str());
    const int flags = O_WRONLY | O_CREAT | O_TRUNC;
    posix_spawn_file_actions_addopen(&actions, 1, (folder_ / ".out").c_str(), flags, 0600);
    posix_spawn_file_actions_addopen(&actions, 2, (folder_ / ".err").c_str(), flags, 0600);
    const int error = posix_spawn(&process_, file.c_str(), &actions, &attributes, arguments.data(),
                                  environment.data());
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    if (error != 0) throw std::runtime_error("cannot start " + file);
  }

  pid_t process() const { return process_; }
  void signal(int number) const { ::kill(process_, number); }

  ProgramResult wait() const {
    int status = 0;
    rusage used{};
    ::wait4(process_, &status, 0, &used);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return {code, said(".out"), said(".err"), seconds(), 1024.0 * used.ru_maxrss};
  }

  /// Since its start.
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  static std::vector<char*> pointers_to(std::vector<std::string>& words) {
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    return pointers;
  }

  /// What it wrote; nothing where that went to a device.
  std::string said(std::string_view name) const {
    return std::filesystem::is_regular_file(folder_ / name) ? bytes_of(folder_ / name)
                                                            : std::string();
  }

  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::filesystem::path folder_;
  pid_t process_ = 0;
};

}  // namespace supple
