#include "sculpt/launch/launch.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <charconv>
#include <cstdlib>
#include <filesystem>

#include "sculpt/base/error.hpp"

namespace sculpt {

namespace {

constexpr const char* kOwnMark = "SCULPT_LAUNCHED";

// Each is set by a launcher for the processes it starts, and only for them.
constexpr const char* kRankVariables[] = {
    "OMPI_COMM_WORLD_SIZE",  // Open MPI
    "OMPI_COMM_WORLD_RANK",  // Open MPI
    "PMIX_RANK",             // PMIx: Open MPI, PRRTE, Slurm
    "PMI_RANK",              // MPICH, Intel MPI, Cray, Slurm with pmi2
    "PMI_SIZE",              // the same
    "PMI_ID",                // older MPICH
    "MPI_LOCALRANKID",       // Hydra
    "MV2_COMM_WORLD_RANK",   // MVAPICH
    "PALS_RANKID",           // HPE Cray PALS
    "ALPS_APP_PE",           // Cray aprun
    "JSM_NAMESPACE_RANK",    // IBM jsrun
    "FLUX_TASK_RANK",        // Flux
    kOwnMark,
};

// The batch script, an interactive shell and Slurm's own containers are steps too, with reserved ids at the
// end of the 32-bit range. Only other steps were started by srun for the program.
constexpr unsigned long kFirstReservedSlurmStep = 0xfffffff0UL;

bool in_srun_step(const Environment& environment) {
  const std::optional<std::string> step = environment("SLURM_STEP_ID");
  if (!step || !environment("SLURM_PROCID")) return false;
  unsigned long id = 0;
  const auto [end, code] = std::from_chars(step->data(), step->data() + step->size(), id);
  return code == std::errc() && end == step->data() + step->size() && id < kFirstReservedSlurmStep;
}

bool can_run(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored) && ::access(path.c_str(), X_OK) == 0;
}

// Full path of a program on PATH; empty when it is not there.
std::string search_path(const std::string& program, const Environment& environment) {
  std::string folders = environment("PATH").value_or("/usr/local/bin:/usr/bin:/bin");
  folders += ':';
  for (std::size_t begin = 0, end; (end = folders.find(':', begin)) != std::string::npos; begin = end + 1) {
    const std::string folder = folders.substr(begin, end - begin);
    const std::string path = (folder.empty() ? "." : folder) + "/" + program;
    if (can_run(path)) return path;
  }
  return "";
}

std::string shell_text(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) {
    const bool plain = !word.empty() && word.find_first_of(" \t\"'$&;|<>()*?#\\") == std::string::npos;
    const std::string quote = word.find('\'') == std::string::npos ? "'" : "\"";
    line += (line.empty() ? "" : " ") + (plain ? word : quote + word + quote);
  }
  return line;
}

}  // namespace

Environment process_environment() {
  return [](const std::string& name) -> std::optional<std::string> {
    const char* value = std::getenv(name.c_str());
    return value == nullptr ? std::nullopt : std::optional<std::string>(value);
  };
}

bool already_launched(const Environment& environment) {
  for (const char* variable : kRankVariables)
    if (environment(variable)) return true;
  return in_srun_step(environment);
}

bool should_launch(const Deck& deck, std::string_view program, const Environment& environment) {
  const std::string name = std::filesystem::path(program).filename().string();
  return deck.num_procs > 1 && !name.starts_with("psculpt") && !already_launched(environment);
}

std::string find_mpiexec(const Deck& deck, const Environment& environment) {
  if (!deck.mpi.empty()) {
    const bool is_path = deck.mpi.find('/') != std::string::npos;
    const std::string path = is_path ? deck.mpi : search_path(deck.mpi, environment);
    if (path.empty() || !can_run(path))
      throw Error(fmt::format("option '-mpi': '{}' is not a program that can be run", deck.mpi));
    return path;
  }
  for (const char* program : {"mpiexec", "mpirun"})
    if (std::string path = search_path(program, environment); !path.empty()) return path;
  throw Error(
      fmt::format("option '-j': cannot start {0} processes, there is no mpiexec on the PATH; name one with "
                  "'-mpi <path>' or leave '-j' out to run on one process",
                  deck.num_procs));
}

LaunchPlan plan_launch(const Deck& deck, std::span<const std::string> words, const std::string& mpiexec,
                       const Host& host, const Environment& environment) {
  LaunchPlan plan;
  plan.argv = {mpiexec, "-n", std::to_string(deck.num_procs), host.self};
  plan.argv.insert(plan.argv.end(), words.begin(), words.end());

  const auto add = [&](const char* name, const char* value) {
    if (!environment(name)) plan.environment.emplace_back(name, value);
  };
  add(kOwnMark, "1");
  // Open MPI 3 and 4 read OMPI_*, Open MPI 5 the PRTE_* ones; other launchers ignore both. Its remarks on
  // ranks that fail would hide the one message that tells why; launch() speaks up where there was none.
  add("OMPI_MCA_orte_execute_quiet", "1");
  add("PRTE_MCA_prte_execute_quiet", "1");
  add("OMPI_ALLOW_RUN_AS_ROOT", "1");
  add("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
  add("OMPI_MCA_rmaps_base_oversubscribe", "1");
  add("PRTE_MCA_rmaps_default_mapping_policy", ":oversubscribe");
  if (deck.num_procs > host.cores) {
    add("OMPI_MCA_mpi_yield_when_idle", "1");
    add("OMPI_MCA_hwloc_base_binding_policy", "none");
    add("PRTE_MCA_hwloc_default_binding_policy", "none");
  }
  if (!host.copies_allowed) add("OMPI_MCA_btl_vader_single_copy_mechanism", "none");

  if (!deck.quiet)
    plan.announcement = fmt::format(
        "SCULPT Running on host name: {}\nAt time: {}\n\nInitializing MPI on {} Processors: mpiexec = "
        "{}\n{}\n",
        host.name, host.time, deck.num_procs, mpiexec, shell_text(plan.argv));
  return plan;
}

std::string check_rank_count(const Deck& deck, int ranks) {
  if (!deck.given("num_procs") || deck.num_procs == ranks) return "";
  return fmt::format(
      "num_procs is {} ({}), but the MPI launcher started {} {}; give both the same number, or leave "
      "num_procs out",
      deck.num_procs, deck.given_options.place("num_procs"), ranks, ranks == 1 ? "process" : "processes");
}

}  // namespace sculpt
