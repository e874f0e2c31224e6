// The process that stays between the user's shell and mpiexec: it passes signals on, and says so when the
// ranks end without a word.
#include <fcntl.h>
#include <fmt/core.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "sculpt/base/error.hpp"
#include "sculpt/launch/launch.hpp"

namespace sculpt {
namespace {

constexpr int kPassedOn[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2};

volatile pid_t started = 0;
volatile std::sig_atomic_t passed_on = 0;  // the last signal, 0 = none

// What the terminal sends reaches mpiexec by itself, what a process sends reaches this process alone.
void pass_on(int signal, siginfo_t* info, void*) {
  const int kept = errno;
  passed_on = signal;
  if (info->si_code <= 0 && started > 0) ::kill(started, signal);
  errno = kept;
}

// Holds the signals back while the child is being started.
class SignalsHeld {
 public:
  SignalsHeld() {
    sigset_t held;
    sigemptyset(&held);
    for (const int signal : kPassedOn) sigaddset(&held, signal);
    ::sigprocmask(SIG_BLOCK, &held, &before_);
  }
  ~SignalsHeld() { release(); }
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;
  void release() const { ::sigprocmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_{};
};

void handle_signals() {
  struct sigaction action {};
  action.sa_sigaction = pass_on;
  action.sa_flags = SA_SIGINFO | SA_RESTART;
  for (const int signal : kPassedOn) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) ::sigaction(signal, &action, nullptr);  // nohup stays in force
  }
}

[[noreturn]] void become(const std::vector<std::string>& words, int report) {
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);  // the ranks must not outlive this process
  ::execv(argv[0], argv.data());
  const int cause = errno;
  while (::write(report, &cause, sizeof cause) < 0 && errno == EINTR) {
  }
  ::_exit(127);
}

[[noreturn]] void fail(const LaunchPlan& plan, int cause) {
  throw Error(fmt::format("option '-j': cannot run '{}': {}", plan.argv[0], std::strerror(cause)));
}

// Starts mpiexec; returns once it is under way.
void start(const LaunchPlan& plan) {
  std::array<int, 2> report{};  // closed by a successful exec, else it carries errno
  if (::pipe2(report.data(), O_CLOEXEC) != 0) fail(plan, errno);
  const SignalsHeld held;
  const pid_t child = ::fork();
  if (child < 0) fail(plan, errno);
  if (child == 0) {
    held.release();
    become(plan.argv, report[1]);
  }
  started = child;
  handle_signals();
  ::close(report[1]);
  int cause = 0;
  ssize_t got = 0;
  while ((got = ::read(report[0], &cause, sizeof cause)) < 0 && errno == EINTR) {
  }
  ::close(report[0]);
  if (got == sizeof cause) {
    ::waitpid(child, nullptr, 0);
    fail(plan, cause);
  }
}

int wait_for_end() {
  int status = 0;
  while (::waitpid(started, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

// What can be said about a run that ended without a message of its own.
std::string describe_end(const std::string& mpiexec, int status) {
  if (passed_on != 0) return fmt::format("stopped by signal {} ({})", int{passed_on}, ::strsignal(passed_on));
  const int signal = status - 128;
  if (signal > 0 && ::sigabbrev_np(signal) != nullptr)
    return fmt::format("a process was ended by signal {} ({}){}", signal, ::strsignal(signal),
                       signal == SIGKILL ? "; the memory may be too small for this mesh" : "");
  return fmt::format(
      "'{}' ended with status {} before all processes were done; OMPI_MCA_orte_execute_quiet=0 in the "
      "environment makes Open MPI say more",
      mpiexec, status);
}

}  // namespace

int launch(const LaunchPlan& plan) {
  std::fputs(plan.announcement.c_str(), stdout);
  std::fflush(stdout);
  for (const auto& [name, value] : plan.environment) ::setenv(name.c_str(), value.c_str(), 0);
  start(plan);
  const int status = wait_for_end();
  if (status == 0 || status == kToldStatus || status == kPoorMeshStatus) return status;
  throw Error(describe_end(plan.argv[0], status));
}

}  // namespace sculpt
