// Islands, protrusions and isthmuses (the report, section 2.7.2).
#include <algorithm>
#include <array>
#include <limits>
#include <tuple>

#include "filter/edits.hpp"
#include "sculpt/base/fixed_point.hpp"
#include "sculpt/vfrac/fractions.hpp"

namespace sculpt {
namespace {

constexpr int kForeignFaces = 4;  // of a protrusion or isthmus

// The contact of a small piece with one material around it.
struct Contact {
  GlobalId island;
  std::int32_t material;
  std::int32_t blocked;      // 1: touches an island that goes first
  std::int64_t firm, faces;  // faces towards larger pieces, and all
  std::int64_t units;        // fraction of the material in the cells at those faces
  [[nodiscard]] bool better_than(const Contact& o) const {
    return std::tie(firm, faces, units, o.material) > std::tie(o.firm, o.faces, o.units, material);
  }
};

void merge(std::vector<Contact>& contacts) {
  std::sort(contacts.begin(), contacts.end(), [](const Contact& a, const Contact& b) {
    return std::tie(a.island, a.material) < std::tie(b.island, b.material);
  });
  std::size_t last = 0;
  for (std::size_t i = 1; i < contacts.size(); ++i) {
    if (contacts[i].island == contacts[last].island && contacts[i].material == contacts[last].material) {
      contacts[last].blocked |= contacts[i].blocked;
      contacts[last].firm += contacts[i].firm;
      contacts[last].faces += contacts[i].faces;
      contacts[last].units += contacts[i].units;
    } else {
      contacts[++last] = contacts[i];
    }
  }
  if (!contacts.empty()) contacts.resize(last + 1);
}

// Contacts of the owned cells of small pieces.
void find_contacts(const Edits& edits, const Pieces& p, const std::vector<std::uint8_t>& small,
                   std::vector<Contact>& inner, std::vector<Contact>& shared) {
  const auto rank_of = [&](std::size_t piece) { return std::pair(p.size[piece], p.label[piece]); };
  for (LocalId c = 0; c < edits.mesh.size(); ++c) {
    const std::size_t mine = at(p.of[at(c)]);
    if (!small[mine] || !edits.owned(c)) continue;
    for (const LocalId n : edits.neighbours[at(c)]) {
      if (n == kNone || at(p.of[at(n)]) == mine) continue;
      const std::size_t other = at(p.of[at(n)]);
      const bool first = small[other] && rank_of(other) < rank_of(mine);
      (p.shared[mine] ? shared : inner)
          .push_back({p.label[mine], edits.material(n), first, !small[other], 1,
                      to_units(fraction_of(edits.fractions, c, edits.material(n)))});
    }
  }
}

// Per island that changes now its new material, ascending in island.
std::vector<std::pair<GlobalId, std::int32_t>> decide(const std::vector<Contact>& contacts) {
  std::vector<std::pair<GlobalId, std::int32_t>> decided;
  for (std::size_t first = 0; first < contacts.size();) {
    std::size_t last = first, best = first;
    bool blocked = false;
    for (; last < contacts.size() && contacts[last].island == contacts[first].island; ++last) {
      blocked = blocked || contacts[last].blocked;
      if (contacts[last].better_than(contacts[best])) best = last;
    }
    if (contacts[best].firm > 0 || !blocked)
      decided.emplace_back(contacts[best].island, contacts[best].material);
    first = last;
  }
  return decided;
}

}  // namespace

IslandReport remove_islands(Edits& edits, std::int64_t most) {
  const Pieces p = pieces(edits, most + 1);
  std::vector<std::uint8_t> small(p.label.size());
  for (std::size_t i = 0; i < small.size(); ++i) small[i] = p.size[i] <= most;
  std::vector<GlobalId> kept;  // labels of pieces with a locked cell
  for (LocalId c = 0; c < edits.mesh.size(); ++c)
    if (edits.locked(c) && small[at(p.of[at(c)])]) kept.push_back(p.label[at(p.of[at(c)])]);
  kept = edits.comm().concatenate(kept);
  std::sort(kept.begin(), kept.end());
  for (std::size_t i = 0; i < small.size(); ++i)
    if (small[i] && std::binary_search(kept.begin(), kept.end(), p.label[i])) small[i] = 0;

  std::vector<Contact> contacts, shared;
  find_contacts(edits, p, small, contacts, shared);
  merge(shared);
  shared = edits.comm().concatenate(shared);
  contacts.insert(contacts.end(), shared.begin(), shared.end());
  merge(contacts);
  const auto decided = decide(contacts);

  IslandReport report;
  for (LocalId c = 0; c < edits.mesh.size(); ++c) {
    const std::size_t piece = at(p.of[at(c)]);
    if (!small[piece] || !edits.owned(c)) continue;
    const auto found = std::lower_bound(decided.begin(), decided.end(),
                                        std::pair(p.label[piece], std::numeric_limits<std::int32_t>::min()));
    if (found == decided.end() || found->first != p.label[piece]) continue;
    edits.change_owned(c, found->second);
    ++report.cells;
    report.islands += edits.mesh.hex_id[at(c)] == p.label[piece];
  }
  edits.share();
  report.cells = edits.comm().sum(report.cells);
  report.islands = edits.comm().sum(report.islands);
  return report;
}

// The material that a protruding cell goes to: the one with most faces at it, if those are more than it has
// of its own material, so that every change makes the interfaces smaller; kNone for a cell that stays.
std::int32_t Protrusions::better(LocalId cell) const {
  const std::int32_t own = edits_.material(cell);
  std::array<std::int32_t, 6> other;
  std::size_t count = 0;
  int foreign = 0, like = 0;
  for (const LocalId n : edits_.neighbours[at(cell)]) {
    if (n == kNone)
      foreign += at_box_;
    else if (edits_.material(n) == own)
      ++like;
    else
      other[count++] = edits_.material(n);
  }
  foreign += static_cast<int>(count);
  if (foreign < kForeignFaces || count == 0 || edits_.locked(cell)) return kNone;
  std::tuple<int, double, std::int32_t> best{0, 0, 0};  // faces, fraction, smaller material
  for (std::size_t i = 0; i < count; ++i) {
    int faces = 0;
    for (std::size_t j = 0; j < count; ++j) faces += other[j] == other[i];
    best = std::max(best, std::tuple(faces, fraction_of(edits_.fractions, cell, other[i]), -other[i]));
  }
  return std::get<0>(best) > like ? -std::get<2>(best) : kNone;
}

}  // namespace sculpt
