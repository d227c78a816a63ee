#pragma once

#include <csignal>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/temporary_folder.h"

namespace supple {

/// What a program said and how it ended.
struct ProgramResult {
  int code = -1;  ///< exit code; 128 + n where signal n killed it
  std::string out, err;
};

/// A program that was started in `folder`, with what it says going to files there.
class Program {
 public:
  Program(const std::string& file, std::vector<std::string> words, std::filesystem::path folder)
      : folder_(std::move(folder)) {
    words.insert(words.begin(), file);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder_.c_str());
    const int flags = O_WRONLY | O_CREAT | O_TRUNC;
    posix_spawn_file_actions_addopen(&actions, 1, (folder_ / ".out").c_str(), flags, 0600);
    posix_spawn_file_actions_addopen(&actions, 2, (folder_ / ".err").c_str(), flags, 0600);
    const int error =
        posix_spawn(&process_, file.c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) throw std::runtime_error("cannot start " + file);
  }

  void signal(int number) const { ::kill(process_, number); }

  ProgramResult wait() const {
    int status = 0;
    ::waitpid(process_, &status, 0);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return {code, bytes_of(folder_ / ".out"), bytes_of(folder_ / ".err")};
  }

 private:
  std::filesystem::path folder_;
  pid_t process_ = 0;
};

}  // namespace supple
