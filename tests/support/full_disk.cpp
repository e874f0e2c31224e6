// Preloaded into a program (LD_PRELOAD), makes the folder FULL_DISK (absolute path) a disk on which every
// file has room for 4096 bytes: writing beyond fails as on a full disk.
#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>

namespace {

constexpr off_t kRoom = 4096;  // bytes

bool has_room(int file, off_t end) {
  const char* folder = std::getenv("FULL_DISK");
  if (folder == nullptr || end <= kRoom) return true;
  std::string name(4096, '\0');
  const std::string link = "/proc/self/fd/" + std::to_string(file);
  const ssize_t length = ::readlink(link.c_str(), name.data(), name.size());
  name.resize(length < 0 ? 0 : static_cast<std::size_t>(length));
  return !name.starts_with(std::string(folder) + "/");
}

ssize_t full() {
  errno = ENOSPC;
  return -1;
}

template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

ssize_t write(int file, const void* data, std::size_t size) {
  static const auto really = next<decltype(::write)>("write");
  if (!has_room(file, ::lseek(file, 0, SEEK_CUR) + static_cast<off_t>(size))) return full();
  return really(file, data, size);
}

ssize_t pwrite(int file, const void* data, std::size_t size, off_t offset) {
  static const auto really = next<decltype(::pwrite)>("pwrite");
  if (!has_room(file, offset + static_cast<off_t>(size))) return full();
  return really(file, data, size, offset);
}

ssize_t pwrite64(int file, const void* data, std::size_t size, off64_t offset) {
  return pwrite(file, data, size, offset);
}
}
