#include "input/text_file.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

#include "sculpt/base/error.hpp"

namespace sculpt {

TextFile::TextFile(std::string path, const std::string& option) : path_(std::move(path)) {
  descriptor_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0)
    throw Error(fmt::format("{}: cannot open '{}': {}", option, path_, std::strerror(errno)));
  try {
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0)
      throw Error(fmt::format("{}: cannot read '{}': {}", option, path_, std::strerror(errno)));
    if (S_ISDIR(status.st_mode))
      throw Error(fmt::format("{}: '{}' is a directory, expected a file", option, path_));
    if (!S_ISREG(status.st_mode)) throw Error(fmt::format("{}: '{}' is not a regular file", option, path_));
    size_ = status.st_size;
    if (size_ == 0) throw Error(fmt::format("{}: '{}' is empty", option, path_));
    std::array<char, 2> start{};
    if (size_ >= 2) read(0, start);
    if (start[0] == '\x1f' && start[1] == '\x8b')
      throw Error(fmt::format("{}: '{}' is compressed (gzip); unpack it first", option, path_));
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

TextFile::~TextFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

TextFile::TextFile(TextFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_) {}

void TextFile::read(std::int64_t offset, std::span<char> into) const {
  std::size_t done = 0;
  while (done < into.size()) {
    const ssize_t got = ::pread(descriptor_, into.data() + done, into.size() - done,
                                static_cast<off_t>(offset + static_cast<std::int64_t>(done)));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw Error(fmt::format("cannot read '{}': {}", path_, std::strerror(errno)));
    if (got == 0)
      throw Error(fmt::format("cannot read '{}': the file became shorter while it was read", path_));
    done += static_cast<std::size_t>(got);
  }
}

std::int64_t TextFile::line_of(std::int64_t offset) const {
  std::vector<char> buffer(std::size_t{1} << 20);
  std::int64_t line = 1;
  for (std::int64_t at = 0; at < offset; at += static_cast<std::int64_t>(buffer.size())) {
    const auto bytes = std::min<std::int64_t>(static_cast<std::int64_t>(buffer.size()), offset - at);
    read(at, std::span(buffer).first(static_cast<std::size_t>(bytes)));
    line += std::count(buffer.begin(), buffer.begin() + bytes, '\n');
  }
  return line;
}

std::string TextFile::place(std::int64_t offset) const {
  return fmt::format("{}, line {}: ", path_, line_of(offset));
}

}  // namespace sculpt
