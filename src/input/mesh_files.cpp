#include "input/mesh_files.hpp"

#include <fmt/core.h>

#include <charconv>
#include <filesystem>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "sculpt/exo/write_rank_file.hpp"

namespace sculpt {
namespace {

enum Choice { kWhole, kParts, kSolePart };

struct Found {
  bool whole = false;
  std::map<int, std::set<int>> parts;  // number of parts -> those that are there
};

// Reads "4.0" or "12.07" of mesh.g.4.0 or mesh.g.12.07: digits, the second number as wide as the first.
bool parse_part(std::string_view text, int& ranks, int& rank) {
  const std::size_t dot = text.find('.');
  if (dot == std::string_view::npos || text.size() != 2 * dot + 1) return false;
  const auto number = [](std::string_view digits, int& value) {
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return error == std::errc() && end == digits.data() + digits.size() && value >= 0;
  };
  return number(text.substr(0, dot), ranks) && number(text.substr(dot + 1), rank) && rank < ranks;
}

Found look_for(const std::string& path) {
  namespace fs = std::filesystem;
  Found found;
  std::error_code ignored;
  found.whole = fs::exists(path, ignored);
  const fs::path file(path);
  const std::string prefix = file.filename().string() + ".";
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    const std::string name = entry->path().filename().string();
    int ranks = 0, rank = 0;
    if (name.starts_with(prefix) && parse_part(std::string_view(name).substr(prefix.size()), ranks, rank))
      found.parts[ranks].insert(rank);
  }
  return found;
}

std::string range_of_parts(const std::string& path, int ranks) {
  return fmt::format("'{}' to '{}'", part_file_name(path, ranks, 0), part_file_name(path, ranks, ranks - 1));
}

[[noreturn]] void some_are_missing(const std::string& path, int ranks, const std::set<int>& there) {
  int missing = 0;
  while (there.contains(missing)) ++missing;
  throw Error(fmt::format("found {} of the {} parts of '{}' for {} ranks: '{}' is missing; expected {}, {}",
                          there.size(), ranks, path, ranks, part_file_name(path, ranks, missing),
                          range_of_parts(path, ranks), decomp_command(path, ranks)));
}

[[noreturn]] void none_fits(const std::string& path, int ranks, const Found& found) {
  std::string parts;
  for (const auto& [n, there] : found.parts) parts += (parts.empty() ? "" : ", ") + std::to_string(n);
  const std::string here =
      found.parts.empty()
          ? fmt::format("cannot open '{}': No such file or directory, and no parts of it", path)
          : fmt::format("'{}' does not exist; found parts of it for this many ranks: {}", path, parts);
  const std::string expected = ranks == 1 ? "expected the whole file on one rank"
                                          : fmt::format("expected it, or {}, {}", range_of_parts(path, ranks),
                                                        decomp_command(path, ranks));
  throw Error(here + "; " + expected);
}

Choice choose(const std::string& path, int ranks, const Found& found) {
  const auto parts = found.parts.find(ranks);
  const bool has_parts = parts != found.parts.end();
  if (ranks == 1) {  // decomp -p 1 makes nothing
    if (found.whole) return kWhole;
    if (has_parts) return kSolePart;
  } else if (has_parts) {
    if (parts->second.size() == static_cast<std::size_t>(ranks)) return kParts;
    some_are_missing(path, ranks, parts->second);
  } else if (found.whole) {
    return kWhole;
  }
  none_fits(path, ranks, found);
}

// The number of the parts of a mesh; 0: it is one file.
int number_of_parts(const std::string& path, const Found& found) {
  if (found.parts.empty() && !found.whole)
    throw Error(fmt::format("found neither '{}' nor parts of it, expected '{}.<ranks>.<rank>' of all ranks",
                            path, path));
  if (found.parts.empty()) return 0;
  const auto& [ranks, there] = *found.parts.begin();
  if (found.parts.size() > 1)
    throw Error(fmt::format("found parts of '{}' for {} and for {} ranks, expected those of one run", path,
                            ranks, std::next(found.parts.begin())->first));
  int missing = 0;
  while (there.contains(missing)) ++missing;
  if (missing < ranks)
    throw Error(fmt::format("found {} of the {} parts of '{}': '{}' is missing; expected {}", there.size(),
                            ranks, path, part_file_name(path, ranks, missing), range_of_parts(path, ranks)));
  return ranks;
}

}  // namespace

std::vector<std::string> find_parts_of_any_number(const Comm& comm, const std::string& path, const Log& log) {
  std::vector<int> choice;
  collectively(comm, "looking for " + path, [&] {
    if (comm.rank() != 0) return;
    const Found found = look_for(path);
    choice = {number_of_parts(path, found), found.whole ? 1 : 0};
  });
  comm.broadcast(choice, 0);
  const int ranks = choice[0];
  if (ranks == 0) return {path};
  if (choice[1] != 0) log.line("Found '{}' and its {} parts: the parts are used", path, ranks);
  std::vector<std::string> names;
  for (int r = 0; r < ranks; ++r) names.push_back(part_file_name(path, ranks, r));
  return names;
}

std::string decomp_command(const std::string& path, int ranks) {
  return fmt::format("made by: decomp -p {} {}", ranks, path);
}

MeshFiles find_mesh_files(const Comm& comm, const std::string& path, const Log& log) {
  std::vector<int> choice;
  collectively(comm, "looking for " + path, [&] {
    if (comm.rank() != 0) return;
    const Found found = look_for(path);
    choice = {choose(path, comm.size(), found), found.whole ? 1 : 0};
  });
  comm.broadcast(choice, 0);
  if (choice[0] == kWhole) return {false, path, path};
  const std::string mine = part_file_name(path, comm.size(), comm.rank());
  if (choice[0] == kSolePart) return {false, mine, mine};
  if (choice[1] != 0)
    log.line("Found '{}' and its parts for {} ranks: the parts are used", path, comm.size());
  return {true, mine,
          part_file_name(path, comm.size(), 0) + " to " + part_file_name(path, comm.size(), comm.size() - 1)};
}

}  // namespace sculpt
