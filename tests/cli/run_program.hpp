#pragma once
// Runs a program as a user does, in a folder of its own, with a time limit.
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace sculpt::cli {

using Words = std::vector<std::string>;

struct RunOptions {
  std::string folder{};                                            // where the program runs
  double seconds = 60;                                             // after that it is killed
  std::vector<std::pair<std::string, std::string>> environment{};  // added to that of the test
  std::int64_t largest_file = -1;                                  // bytes; -1 = no limit
};

struct RunResult {
  int status = -1;  // exit status; -signal when a signal ended the program
  bool timed_out = false;
  std::string out, error;  // what it printed
};

// The program sees the test's environment without the variables by which MPI launchers mark their processes.
[[nodiscard]] RunResult run_program(const Words& words, const RunOptions& options);

// The lines of a text, without their ends.
[[nodiscard]] std::vector<std::string> lines_of(const std::string& text);

}  // namespace sculpt::cli
