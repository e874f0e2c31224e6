#include "sculpt/launch/launch.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>

#include "sculpt/base/error.hpp"

namespace sculpt {
namespace {

using Variables = std::map<std::string, std::string>;
using Words = std::vector<std::string>;

Environment environment(const Variables& variables) {
  return [variables](const std::string& name) -> std::optional<std::string> {
    const auto found = variables.find(name);
    return found == variables.end() ? std::nullopt : std::optional(found->second);
  };
}

Deck deck_with(int ranks) {
  Deck deck;
  deck.num_procs = ranks;
  deck.given_options.add("num_procs", "command line");
  return deck;
}

const Host kHost{.name = "node7", .time = "Fri May 24 09:05:25 2024", .self = "/opt/bin/sculpt", .cores = 8};

Variables added(const LaunchPlan& plan) { return {plan.environment.begin(), plan.environment.end()}; }

TEST(AlreadyLaunched, KnowsTheLaunchersByTheirVariables) {
  EXPECT_FALSE(already_launched(environment({})));
  EXPECT_FALSE(
      already_launched(environment({{"PATH", "/bin"}, {"SLURM_JOB_ID", "5"}, {"OMP_NUM_THREADS", "2"}})));
  for (const char* name :
       {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE", "PMI_ID", "MPI_LOCALRANKID",
        "MV2_COMM_WORLD_RANK", "PALS_RANKID", "ALPS_APP_PE", "SCULPT_LAUNCHED"})
    EXPECT_TRUE(already_launched(environment({{name, "0"}}))) << name;
}

TEST(AlreadyLaunched, TellsSrunFromABatchScript) {
  EXPECT_TRUE(already_launched(environment({{"SLURM_PROCID", "3"}, {"SLURM_STEP_ID", "0"}})));
  EXPECT_FALSE(already_launched(environment({{"SLURM_PROCID", "0"}})));
  EXPECT_FALSE(already_launched(environment({{"SLURM_STEP_ID", "0"}})));
  EXPECT_FALSE(
      already_launched(environment({{"SLURM_PROCID", "0"}, {"SLURM_STEP_ID", "4294967291"}})));  // batch
  EXPECT_FALSE(
      already_launched(environment({{"SLURM_PROCID", "0"}, {"SLURM_STEP_ID", "4294967290"}})));  // shell
  EXPECT_FALSE(already_launched(environment({{"SLURM_PROCID", "0"}, {"SLURM_STEP_ID", "batch"}})));
}

TEST(ShouldLaunch, OnlySculptWithSeveralRanksOutsideALauncher) {
  EXPECT_TRUE(should_launch(deck_with(2), "/usr/bin/sculpt", environment({})));
  EXPECT_TRUE(should_launch(deck_with(2), "sculpt", environment({})));
  EXPECT_FALSE(should_launch(deck_with(2), "/usr/bin/psculpt", environment({})));
  EXPECT_FALSE(should_launch(deck_with(1), "sculpt", environment({})));
  EXPECT_FALSE(should_launch(Deck{}, "sculpt", environment({})));
  EXPECT_FALSE(should_launch(deck_with(2), "sculpt", environment({{"PMI_RANK", "0"}})));
}

TEST(PlanLaunch, StartsThisProgramWithItsWords) {
  const LaunchPlan plan =
      plan_launch(deck_with(4), Words{"-j", "4", "-i", "a b.i"}, "/usr/bin/mpiexec", kHost, environment({}));
  EXPECT_EQ(plan.argv, (Words{"/usr/bin/mpiexec", "-n", "4", "/opt/bin/sculpt", "-j", "4", "-i", "a b.i"}));
  EXPECT_EQ(plan.announcement,
            "SCULPT Running on host name: node7\n"
            "At time: Fri May 24 09:05:25 2024\n"
            "\n"
            "Initializing MPI on 4 Processors: mpiexec = /usr/bin/mpiexec\n"
            "/usr/bin/mpiexec -n 4 /opt/bin/sculpt -j 4 -i 'a b.i'\n");
  EXPECT_EQ(added(plan), (Variables{{"SCULPT_LAUNCHED", "1"},
                                    {"OMPI_MCA_orte_execute_quiet", "1"},
                                    {"PRTE_MCA_prte_execute_quiet", "1"},
                                    {"OMPI_ALLOW_RUN_AS_ROOT", "1"},
                                    {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"},
                                    {"OMPI_MCA_rmaps_base_oversubscribe", "1"},
                                    {"PRTE_MCA_rmaps_default_mapping_policy", ":oversubscribe"}}));
}

TEST(PlanLaunch, IsSilentWhenQuiet) {
  Deck deck = deck_with(4);
  deck.quiet = true;
  EXPECT_EQ(plan_launch(deck, {}, "mpiexec", kHost, environment({})).announcement, "");
}

TEST(PlanLaunch, SharesCoresWhenThereAreMoreRanks) {
  const Variables more = added(plan_launch(deck_with(9), {}, "mpiexec", kHost, environment({})));
  EXPECT_EQ(more.at("OMPI_MCA_mpi_yield_when_idle"), "1");
  EXPECT_EQ(more.at("OMPI_MCA_hwloc_base_binding_policy"), "none");
  const Variables enough = added(plan_launch(deck_with(8), {}, "mpiexec", kHost, environment({})));
  EXPECT_FALSE(enough.contains("OMPI_MCA_mpi_yield_when_idle"));
  EXPECT_FALSE(enough.contains("OMPI_MCA_hwloc_base_binding_policy"));
}

TEST(PlanLaunch, AvoidsForbiddenCopies) {
  Host container = kHost;
  container.copies_allowed = false;
  const Variables variables = added(plan_launch(deck_with(2), {}, "mpiexec", container, environment({})));
  EXPECT_EQ(variables.at("OMPI_MCA_btl_vader_single_copy_mechanism"), "none");
}

TEST(PlanLaunch, LeavesTheUsersSettingsAlone) {
  const Variables users{{"OMPI_MCA_rmaps_base_oversubscribe", "0"}, {"OMPI_ALLOW_RUN_AS_ROOT", "0"}};
  const Variables variables = added(plan_launch(deck_with(2), {}, "mpiexec", kHost, environment(users)));
  EXPECT_FALSE(variables.contains("OMPI_MCA_rmaps_base_oversubscribe"));
  EXPECT_FALSE(variables.contains("OMPI_ALLOW_RUN_AS_ROOT"));
  EXPECT_TRUE(variables.contains("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"));
}

class FindMpiexec : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "sculpt_launch_XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string program(const std::string& name, mode_t mode = 0755) {
    const std::string path = folder_ + "/" + name;
    std::ofstream(path) << "#!/bin/sh\n";
    ::chmod(path.c_str(), mode);
    return path;
  }
  static std::string refusal(const Deck& deck, const Environment& from) {
    try {
      return "found " + find_mpiexec(deck, from);
    } catch (const Error& error) {
      return error.what();
    }
  }
  std::string folder_;
};

TEST_F(FindMpiexec, SearchesThePath) {
  const std::string mpirun = program("mpirun");
  const Environment path = environment({{"PATH", "/no/such/folder:" + folder_}});
  EXPECT_EQ(find_mpiexec(deck_with(2), path), mpirun);
  const std::string mpiexec = program("mpiexec");
  EXPECT_EQ(find_mpiexec(deck_with(2), path), mpiexec);
}

TEST_F(FindMpiexec, TakesTheOneTheUserNames) {
  Deck deck = deck_with(2);
  deck.mpi = program("my_mpiexec");
  EXPECT_EQ(find_mpiexec(deck, environment({{"PATH", ""}})), deck.mpi);
  const std::string path = deck.mpi;
  deck.mpi = "my_mpiexec";
  EXPECT_EQ(find_mpiexec(deck, environment({{"PATH", folder_}})), path);
}

TEST_F(FindMpiexec, SaysWhatIsMissing) {
  Deck deck = deck_with(3);
  EXPECT_EQ(refusal(deck, environment({{"PATH", folder_}})),
            "option '-j': cannot start 3 processes, there is no mpiexec on the PATH; name one with '-mpi "
            "<path>' or "
            "leave '-j' out to run on one process");
  deck.mpi = program("not_executable", 0644);
  EXPECT_EQ(refusal(deck, environment({})),
            "option '-mpi': '" + deck.mpi + "' is not a program that can be run");
  deck.mpi = folder_;
  EXPECT_EQ(refusal(deck, environment({})),
            "option '-mpi': '" + folder_ + "' is not a program that can be run");
}

LaunchPlan plan_of(const std::string& command, const std::string& announcement = "") {
  return {.argv = {"/bin/sh", "-c", command}, .environment = {}, .announcement = announcement};
}

std::string complaint(const LaunchPlan& plan) {
  try {
    return "status " + std::to_string(launch(plan));
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(Launch, FailsWithAMessageWhenTheProgramCannotRun) {
  const LaunchPlan plan{.argv = {"/no/such/mpiexec"}, .environment = {}, .announcement = ""};
  EXPECT_EQ(complaint(plan), "option '-j': cannot run '/no/such/mpiexec': No such file or directory");
}

TEST(Launch, ReturnsTheStatusOfRanksThatSaidWhy) {
  EXPECT_EQ(complaint(plan_of("exit 0")), "status 0");
  EXPECT_EQ(complaint(plan_of("exit " + std::to_string(kToldStatus))),
            "status " + std::to_string(kToldStatus));
  EXPECT_EQ(complaint(plan_of("exit " + std::to_string(kPoorMeshStatus))),
            "status " + std::to_string(kPoorMeshStatus));
}

TEST(Launch, SpeaksUpWhenTheRanksEndedWithoutAWord) {
  EXPECT_NE(complaint(plan_of("exit 1")).find("'/bin/sh' ended with status 1 before"), std::string::npos);
  EXPECT_EQ(complaint(plan_of("exit 139")), "a process was ended by signal 11 (Segmentation fault)");
  EXPECT_NE(complaint(plan_of("kill -KILL $$")).find("signal 9 (Killed); the memory"), std::string::npos);
}

TEST(Launch, AddsToTheEnvironmentWithoutOverridingIt) {
  LaunchPlan plan = plan_of("test \"$SCULPT_TEST_MARK$HOME\" = new/h && exit 2", "starting\n");
  plan.environment = {{"SCULPT_TEST_MARK", "new"}, {"HOME", "old"}};
  EXPECT_EXIT(
      {
        ::setenv("HOME", "/h", 1);
        std::exit(launch(plan));
      },
      ::testing::ExitedWithCode(2), "");
}

// A batch system ends the launcher alone; its ranks must hear of it.
TEST(Launch, PassesSignalsOn) {
  EXPECT_EXIT(
      {
        if (complaint(plan_of("trap 'exit 5' TERM; kill -TERM $PPID; while :; do sleep 0.01; done")) ==
            "stopped by signal 15 (Terminated)")
          std::exit(7);
      },
      ::testing::ExitedWithCode(7), "");
}

TEST(ThisHost, KnowsItself) {
  const Host host = this_host();
  EXPECT_FALSE(host.name.empty());
  EXPECT_GE(host.cores, 1);
  EXPECT_TRUE(std::filesystem::exists(host.self));
  EXPECT_EQ(std::count(host.time.begin(), host.time.end(), ':'), 2);
}

TEST(CheckRankCount, NeedsAgreementOnlyWhenTheUserGaveANumber) {
  EXPECT_EQ(check_rank_count(deck_with(4), 4), "");
  EXPECT_EQ(check_rank_count(Deck{}, 4), "");
  EXPECT_EQ(
      check_rank_count(deck_with(4), 1),
      "num_procs is 4 (command line), but the MPI launcher started 1 process; give both the same number, or "
      "leave num_procs out");
}

}  // namespace
}  // namespace sculpt
