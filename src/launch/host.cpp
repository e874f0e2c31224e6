// What the operating system says about this machine and process.
#include <sched.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <ctime>
#include <filesystem>

#include "sculpt/base/error.hpp"
#include "sculpt/launch/launch.hpp"

namespace sculpt {

namespace {

int usable_cores() {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  if (::sched_getaffinity(0, sizeof cores, &cores) == 0) return CPU_COUNT(&cores);
  const long online = ::sysconf(_SC_NPROCESSORS_ONLN);
  return online > 0 ? static_cast<int>(online) : 1;
}

// A process may always read its own memory, unless the system call itself is forbidden, as containers do.
bool cross_memory_attach_works() {
  char from = 1, to = 0;
  const iovec local{&to, 1}, remote{&from, 1};
  return ::process_vm_readv(::getpid(), &local, 1, &remote, 1, 0) == 1 || (errno != EPERM && errno != ENOSYS);
}

std::string now() {
  const std::time_t seconds = std::time(nullptr);
  std::tm parts{};
  std::array<char, 64> text{};
  ::localtime_r(&seconds, &parts);
  return std::string(text.data(), std::strftime(text.data(), text.size(), "%a %b %e %H:%M:%S %Y", &parts));
}

}  // namespace

Host this_host() {
  Host host;
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) == 0) host.name = name.data();
  host.time = now();
  std::error_code code;
  host.self = std::filesystem::read_symlink("/proc/self/exe", code).string();
  if (code) throw Error("option '-j': cannot find the path of this program in /proc: " + code.message());
  host.cores = usable_cores();
  host.copies_allowed = cross_memory_attach_works();
  return host;
}

}  // namespace sculpt
