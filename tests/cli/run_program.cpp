#include "run_program.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace sculpt::cli {
namespace {

// A file for what the program prints; gone with the object.
class Capture {
 public:
  Capture() {
    path_ = (std::filesystem::temp_directory_path() / "sculpt_cli_print_XXXXXX").string();
    const int file = ::mkstemp(path_.data());
    if (file < 0) throw std::runtime_error("cannot make " + path_);
    ::close(file);
  }
  ~Capture() { ::unlink(path_.c_str()); }
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::string text() const {
    std::ostringstream all;
    all << std::ifstream(path_).rdbuf();
    return all.str();
  }

 private:
  std::string path_;
};

void redirect(const char* path, int flags, int target) {
  const int file = ::open(path, flags);
  if (file < 0 || ::dup2(file, target) < 0) ::_exit(126);
  ::close(file);
}

bool marks_a_rank(const std::string& name) {
  for (const char* prefix : {"OMPI_", "PMIX_", "PMI_", "PRTE_", "SLURM_", "SCULPT_", "ASAN_OPTIONS"})
    if (name.starts_with(prefix)) return true;
  return false;
}

void set_environment(const RunOptions& options) {
  std::vector<std::string> marks;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    if (const std::string name = text.substr(0, text.find('=')); marks_a_rank(name)) marks.push_back(name);
  }
  for (const std::string& name : marks) ::unsetenv(name.c_str());
  ::setenv("ASAN_OPTIONS", "detect_leaks=0", 1);  // MPI libraries leak at the end
  for (const auto& [name, value] : options.environment) ::setenv(name.c_str(), value.c_str(), 1);
}

[[noreturn]] void become(const Words& words, const RunOptions& options, const Capture& out,
                         const Capture& error) {
  ::setpgid(0, 0);
  redirect("/dev/null", O_RDONLY, STDIN_FILENO);
  redirect(out.path().c_str(), O_WRONLY | O_APPEND, STDOUT_FILENO);
  redirect(error.path().c_str(), O_WRONLY | O_APPEND, STDERR_FILENO);
  if (::chdir(options.folder.c_str()) != 0) ::_exit(126);
  set_environment(options);
  if (options.largest_file >= 0) {
    const auto bytes = static_cast<rlim_t>(options.largest_file);
    const rlimit limit{bytes, bytes};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

}  // namespace

RunResult run_program(const Words& words, const RunOptions& options) {
  const Capture out, error;
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("cannot start " + words[0]);
  if (child == 0) become(words, options, out, error);
  RunResult result;
  int status = 0;
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(options.seconds);
  while (::waitpid(child, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > end) {
      result.timed_out = true;
      ::kill(-child, SIGKILL);
      ::waitpid(child, &status, 0);
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
  }
  result.status = WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
  result.out = out.text();
  result.error = error.text();
  return result;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace sculpt::cli
