#include "input/mesh_parts.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "input/mesh_files.hpp"
#include "sculpt/base/even_parts.hpp"
#include "sculpt/par/finding.hpp"

namespace sculpt {
namespace {

using Numbers = std::vector<GlobalId>;

void check_tables(const std::string& path, const ExodusReader& part, int ranks) {
  const ExodusReader::Header& header = part.header();
  const std::string expected =
      fmt::format("expected one of {} parts, {}", ranks, decomp_command(path, ranks));
  if (!header.nemesis)
    throw Error(fmt::format("'{}' does not say of what mesh it is a part (no Nemesis data); {}", part.path(),
                            expected));
  if (header.ranks != ranks)
    throw Error(fmt::format("'{}' says that it is one of {} parts; {}", part.path(), header.ranks, expected));
  if (header.kind != 'p')
    throw Error(fmt::format("'{}' is a file of type '{}', expected 'p', the mesh of one rank; {}",
                            part.path(), header.kind, expected));
  if (header.global_elements < 1) throw Error(fmt::format("'{}': the mesh has no elements", part.path()));
}

template <class List, class Word>
std::string listed(const std::string& what, const List& list, const Word& word) {
  std::string text = what + ":";
  for (const auto& item : list) text += fmt::format(" {}", word(item));
  return list.empty() ? "no " + what : text;
}

// What all parts of a mesh say alike, in words.
std::vector<std::string> common_claims(const ExodusReader::Header& header) {
  const auto id = [](const auto& entity) { return entity.id; };
  return {fmt::format("{} nodes and {} elements in all", header.global_nodes, header.global_elements),
          listed("blocks", header.blocks, id),
          listed("side sets", header.side_sets, id),
          listed("node sets", header.node_sets, id),
          listed("element variables", header.element_variables, [](const auto& v) { return v.name; }),
          fmt::format("{} time steps", header.times.size())};
}

// Collective.
void check_claims(const Comm& comm, const std::string& path, const ExodusReader& part) {
  const std::vector<std::string> mine = common_claims(part.header());
  std::vector<std::string> first;
  for (const std::string& claim : mine) first.push_back(comm.broadcast(claim, 0));
  collectively(comm, "comparing the parts", [&] {
    constexpr std::size_t kLongest = 200;
    for (std::size_t c = 0; c < mine.size(); ++c)
      if (mine[c] != first[c])
        throw Error(fmt::format("'{}' has {}, but the first part has {}; expected parts of one mesh, {}",
                                part.path(), mine[c].substr(0, kLongest), first[c].substr(0, kLongest),
                                decomp_command(path, comm.size())));
  });
}

// From positions counted from 1 to numbers.
Numbers checked(Numbers ids, GlobalId most, const std::string& file, const char* what) {
  for (const GlobalId id : ids)
    if (id < 1 || id > most)
      throw Error(
          fmt::format("'{}': its map of {} numbers names {}, expected 1 to {}, the positions in the "
                      "undecomposed file",
                      file, what, id, most));
  for (GlobalId& id : ids) --id;
  Numbers sorted = ids;
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end())
    throw Error(fmt::format("'{}' has {} {} twice, expected it once", file, what, *twice + 1));
  return ids;
}

// Collective. Every element of 0 .. total-1 is on one rank.
void check_each_once(const Comm& comm, const std::string& path, const Numbers& elements, GlobalId total) {
  const EvenParts parts{total, comm.size()};
  std::vector<Numbers> to(static_cast<std::size_t>(comm.size()));
  for (const GlobalId e : elements) to[parts.part_of(e)].push_back(e);
  const auto arrived = comm.all_to_all(to);
  const GlobalId begin = parts.begin(comm.rank());
  constexpr int kNobody = -1;
  std::vector<int> rank(static_cast<std::size_t>(parts.end(comm.rank()) - begin), kNobody);
  Finding bad;
  for (int r = 0; r < comm.size(); ++r)
    for (const GlobalId e : arrived[static_cast<std::size_t>(r)]) {
      int& place = rank[static_cast<std::size_t>(e - begin)];
      if (place != kNobody && e < bad.at)
        bad = {e, fmt::format("element {} is in the parts of rank {} and rank {} of '{}', expected one part; "
                              "the parts, {}, may be of two decompositions",
                              e + 1, place, r, path, decomp_command(path, comm.size()))};
      if (place == kNobody) place = r;
    }
  const auto missing = std::find(rank.begin(), rank.end(), kNobody);
  const GlobalId lost = begin + (missing - rank.begin());
  if (missing != rank.end() && lost < bad.at)
    bad = {lost, fmt::format("element {} of {} is in none of the parts of '{}', expected one; the parts, {}, "
                             "may be of two decompositions",
                             lost + 1, total, path, decomp_command(path, comm.size()))};
  refuse_first(comm, bad);
}

}  // namespace

PartNumbers numbers_of_parts(const Comm& comm, const std::string& path, ExodusReader& part) {
  collectively(comm, "reading " + part.path(), [&] { check_tables(path, part, comm.size()); });
  check_claims(comm, path, part);
  const ExodusReader::Header& header = part.header();
  PartNumbers numbers;
  collectively(comm, "reading " + part.path(), [&] {
    numbers.element = checked(part.element_ids(), header.global_elements, part.path(), "element");
    numbers.node = checked(part.node_ids(), header.global_nodes, part.path(), "node");
  });
  check_each_once(comm, path, numbers.element, header.global_elements);
  return numbers;
}

}  // namespace sculpt
