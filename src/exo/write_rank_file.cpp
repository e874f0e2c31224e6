#include "sculpt/exo/write_rank_file.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "exo/exodus_writer.hpp"
#include "sculpt/base/error.hpp"

namespace sculpt {

std::string rank_file_name(const std::string& base, int ranks, int rank, const std::string& extension) {
  const std::string total = std::to_string(ranks);
  return fmt::format("{}.{}.{}.{:0{}}", base, extension, total, rank, total.size());
}

std::string temporary_name(const std::string& final_name) {
  const std::size_t slash = final_name.rfind('/');
  const std::size_t name = slash == std::string::npos ? 0 : slash + 1;
  return final_name.substr(0, name) + "." + final_name.substr(name) + ".part";
}

void write_rank_file(const std::string& path, const RankMesh& mesh) {
  write_exodus(path, mesh, ExodusTables{});
}

void publish(const std::string& temporary, const std::string& final_name) {
  if (std::rename(temporary.c_str(), final_name.c_str()) != 0)
    throw Error(fmt::format("cannot put '{}' in place: {}", final_name, std::strerror(errno)));
}

void discard(const std::string& temporary) noexcept { ::unlink(temporary.c_str()); }

}  // namespace sculpt
