#include "sculpt/exo/write_rank_file.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string_view>

#include "exo/exodus_writer.hpp"
#include "sculpt/base/error.hpp"

namespace sculpt {
namespace {

constexpr std::string_view kTemporarySuffix = ".part";

std::size_t begin_of_name(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? 0 : slash + 1;
}

}  // namespace

std::string part_file_name(const std::string& path, int ranks, int rank) {
  const std::string total = std::to_string(ranks);
  return fmt::format("{}.{}.{:0{}}", path, total, rank, total.size());
}

std::string rank_file_name(const std::string& base, int ranks, int rank, const std::string& extension) {
  return part_file_name(base + "." + extension, ranks, rank);
}

std::string temporary_name(const std::string& final_name) {
  const std::size_t name = begin_of_name(final_name);
  return fmt::format("{}.{}{}", final_name.substr(0, name), final_name.substr(name), kTemporarySuffix);
}

std::string shown_name(const std::string& path) {
  const std::size_t name = begin_of_name(path);
  if (path.size() <= name + 1 + kTemporarySuffix.size() || path[name] != '.' ||
      !path.ends_with(kTemporarySuffix))
    return path;
  return path.substr(0, name) + path.substr(name + 1, path.size() - name - 1 - kTemporarySuffix.size());
}

void write_rank_file(const std::string& path, const RankMesh& mesh) {
  const std::size_t variables = mesh.element_variables.size();
  check(mesh.element_values.size() == mesh.times.size() * variables,
        "rank file: values of steps are missing");
  write_rank_file(path, mesh, [&](std::size_t step, std::size_t variable) {
    return std::span<const double>(mesh.element_values[step * variables + variable]);
  });
}

void write_rank_file(const std::string& path, const RankMesh& mesh, const ElementValues& values) {
  write_exodus(path, mesh, ExodusTables{}, values);
}

void publish(const std::string& temporary, const std::string& final_name) {
  if (std::rename(temporary.c_str(), final_name.c_str()) != 0)
    throw Error(fmt::format("cannot put '{}' in place: {}", final_name, std::strerror(errno)));
}

void discard(const std::string& temporary) noexcept { ::unlink(temporary.c_str()); }

}  // namespace sculpt
