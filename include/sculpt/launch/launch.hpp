#pragma once
// `sculpt -j N`: start the program again as N MPI ranks. No MPI calls here; a process learns from its
// environment whether a launcher has already made it a rank. `psculpt` is a rank by its name and never
// launches.
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sculpt/deck/deck.hpp"

namespace sculpt {

// An environment variable's value; nothing when it is not set.
using Environment = std::function<std::optional<std::string>(const std::string& name)>;
[[nodiscard]] Environment process_environment();

// What the plan depends on besides the deck.
struct Host {
  std::string name;            // host name
  std::string time;            // "Fri May 24 09:05:25 2024"
  std::string self;            // path of this executable
  int cores = 1;               // cores this process may run on
  bool copies_allowed = true;  // may ranks read each other's memory (cross memory attach)?
};
// Error: the system does not tell where this executable lies.
[[nodiscard]] Host this_host();

struct LaunchPlan {
  std::vector<std::string> argv;                                 // argv[0] is the path of mpiexec
  std::vector<std::pair<std::string, std::string>> environment;  // to be added; never overrides the user's
  std::string announcement;                                      // console lines, empty with quiet
};

// Has an MPI launcher (Open MPI, MPICH, Intel MPI, MVAPICH, Slurm, PALS, ALPS, jsrun, Flux) started this
// process, or this library?
[[nodiscard]] bool already_launched(const Environment& environment);

// Is this a call of `sculpt` (path of the program as called, argv[0]) that asks for more than one rank and is
// no rank itself?
[[nodiscard]] bool should_launch(const Deck& deck, std::string_view program, const Environment& environment);

// The mpiexec to use: deck.mpi, else mpiexec or mpirun on the PATH. Error: there is none that can be run.
[[nodiscard]] std::string find_mpiexec(const Deck& deck, const Environment& environment);

// Pure: how to start deck.num_procs ranks of `host.self` with the words of the command line (without the
// program's name).
[[nodiscard]] LaunchPlan plan_launch(const Deck& deck, std::span<const std::string> words,
                                     const std::string& mpiexec, const Host& host,
                                     const Environment& environment);

// Exit status of a run whose message on stderr says what is wrong. mpiexec has other numbers for troubles of
// its own.
inline constexpr int kToldStatus = 2;
// Exit status of a run that wrote a mesh which misses require_quality.
inline constexpr int kPoorMeshStatus = 3;

// Prints the announcement, sets the environment, runs mpiexec and waits for its end, passing signals on.
// Returns 0, kToldStatus or kPoorMeshStatus. Error: mpiexec cannot be run, or the ranks ended without having
// said why.
[[nodiscard]] int launch(const LaunchPlan& plan);

// For a rank: empty, or what is wrong when -j was given and is not the number of ranks.
[[nodiscard]] std::string check_rank_count(const Deck& deck, int ranks);

}  // namespace sculpt
