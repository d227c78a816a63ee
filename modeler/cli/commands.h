#pragma once

#include <span>
#include <string>

namespace supple {

/// How a program ends; 128 + n where signal n stopped it.
enum ExitCode { exit_done = 0, exit_failed = 1, exit_usage = 2, exit_file = 3, exit_importer = 4 };

using Words = std::span<const std::string>;

// One a command, given the words behind its name. They return an exit code and throw what
// exit codes are made of in main.cpp.
int run_pose(Words words);
int run_inspect(Words words);
int run_render(Words words);
int run_plan(Words words);
int run_study(Words words);

}  // namespace supple
