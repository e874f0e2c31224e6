#include <fmt/core.h>

#include <csignal>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "sculpt/base/log.hpp"
#include "sculpt/deck/parse.hpp"
#include "sculpt/deck/report.hpp"
#include "sculpt/launch/launch.hpp"
#include "sculpt/pipeline/run.hpp"

namespace sculpt {
namespace {

// What -h, -vs and --print_input print instead of a run; empty when there is a run.
std::string text_instead_of_run(CommandLine& line) {
  switch (line.action) {
    case Action::kRun:
      return {};
    case Action::kHelp:
      return help_text(line.help_topic);
    case Action::kVersion:
      return version_text() + "\n";
    case Action::kPrintInput:
      break;
  }
  apply_input_defaults(line.deck);
  return echo(line.deck);
}

void print_start(const Log& log, const Deck& deck, const std::string& program) {
  log.line();
  log.line("SCULPT Version {}", SCULPT_VERSION);
  log.line("Conformal hex meshes from microstructures; Apache License 2.0");
  log.line();
  log.line("Input: {}", program);
  if (log.speaks()) std::fputs(console_table(deck).c_str(), stdout);
  log.line();
}

// Returns the exit status.
int run_rank(const Comm& comm, const std::vector<std::string>& words, const std::string& program) {
  CommandLine line = parse_command_line(words, [&](const std::string& file) {
    std::string text;
    collectively(comm, "reading " + file, [&] {
      if (comm.rank() == 0) text = read_deck_file(file);
    });
    return comm.broadcast(std::move(text), 0);
  });
  if (const std::string text = text_instead_of_run(line); line.action != Action::kRun) {
    if (comm.rank() == 0) std::fputs(text.c_str(), stdout);
    return 0;
  }
  if (const std::string mismatch = check_rank_count(line.deck, comm.size()); !mismatch.empty())
    throw Error(mismatch);
  line.deck.num_procs = comm.size();
  apply_input_defaults(line.deck);
  validate(line.deck);
  print_start(Log(comm.rank() == 0 && !line.deck.quiet), line.deck, program);
  return run(comm, line.deck);
}

int complain(const std::string& message) {
  std::fflush(stdout);
  fmt::print(stderr, "sculpt: error: {}\n", message);
  return kToldStatus;
}

// Before MPI starts: answers that need no ranks, wrong input, and the run of the ranks. The exit status, or
// nothing when this process is a rank itself.
std::optional<int> settled_without_mpi(const std::vector<std::string>& words, const std::string& program) {
  const Environment environment = process_environment();
  if (already_launched(environment)) return std::nullopt;
  CommandLine line = parse_command_line(words, read_deck_file);
  if (const std::string text = text_instead_of_run(line); line.action != Action::kRun) {
    std::fputs(text.c_str(), stdout);
    return 0;
  }
  if (!should_launch(line.deck, program, environment)) return std::nullopt;
  apply_input_defaults(line.deck);
  validate(line.deck);
  return launch(
      plan_launch(line.deck, words, find_mpiexec(line.deck, environment), this_host(), environment));
}

}  // namespace

int sculpt_main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows beyond `ulimit -f` is an error with a message
  const std::string program = argv[0];
  const std::vector<std::string> words(argv + 1, argv + argc);
  try {
    if (const std::optional<int> status = settled_without_mpi(words, program)) return *status;
  } catch (const std::exception& e) {
    return complain(e.what());
  }
  const MpiSession session(argc, argv);
  const Comm comm = Comm::world();
  try {
    return run_rank(comm, words, program);
  } catch (const Error& e) {  // every rank has the same one
    return comm.rank() == 0 ? complain(e.what()) : kToldStatus;
  } catch (...) {
    complain(fmt::format("rank {}: {}", comm.rank(), current_exception_text()));
    MPI_Abort(MPI_COMM_WORLD, kToldStatus);
  }
  return kToldStatus;
}

}  // namespace sculpt
