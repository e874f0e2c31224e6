#include "filter/edits.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

#include "sculpt/par/components.hpp"
#include "sculpt/vfrac/fractions.hpp"

namespace sculpt {
namespace {

constexpr double kBias = 0.1;  // of the price for former changes

// What speaks for a cell to be the one that keeps its material alive.
struct Anchor {
  std::int32_t material;
  std::int32_t like;  // face neighbours of the same material; -1: the cell has another material
  std::int64_t piece;
  double fraction;
  GlobalId cell;
  [[nodiscard]] bool better_than(const Anchor& o) const {
    return std::tie(piece, like, fraction, o.cell) > std::tie(o.piece, o.like, o.fraction, cell);
  }
};

void take_best(std::vector<Anchor>& best, const Anchor& candidate) {
  Anchor& now = best[static_cast<std::size_t>(candidate.material)];
  if (now.material < 0 || candidate.better_than(now)) now = candidate;
}

}  // namespace

double Edits::loss(LocalId cell, std::int32_t to) const {
  return fraction_of(fractions, cell, material(cell)) - fraction_of(fractions, cell, to) +
         kBias * ((1 << std::min<int>(changes_[at(cell)], 6)) - 1);
}

void Edits::change(LocalId cell, std::int32_t to) {
  mesh.material[at(cell)] = to;
  if (changes_[at(cell)] < 255) ++changes_[at(cell)];
  changed_.push_back(cell);
}

void Edits::change_owned(LocalId cell, std::int32_t to) {
  change(cell, to);
  unshared_[at(cell)] = 1;
  pending_.push_back(cell);
}

void Edits::share() {
  mesh.hex_exchange.copy_changed(std::span<std::int32_t>(mesh.material), std::span<std::uint8_t>(unshared_),
                                 [this](LocalId ghost) { change(ghost, material(ghost)); });
  for (const LocalId c : pending_) unshared_[at(c)] = 0;
  pending_.clear();
}

void Edits::count_materials() {
  std::int64_t last = -1;
  for (const std::int32_t m : mesh.material) last = std::max<std::int64_t>(last, m);
  cells_of_.assign(static_cast<std::size_t>(comm().max(last) + 1), 0);
  for (LocalId c = 0; c < mesh.size(); ++c)
    if (owned(c)) ++cells_of_[at(material(c))];
  comm().sum(cells_of_);
}

void Edits::lock_materials(std::int64_t materials) {
  locked_.assign(mesh.hexes.size(), 0);
  const Pieces piece = pieces(*this, std::numeric_limits<std::int64_t>::max());
  std::vector<Anchor> best(static_cast<std::size_t>(materials), Anchor{-1, 0, 0, 0, 0});
  for (LocalId c = 0; c < mesh.size(); ++c) {
    if (!owned(c)) continue;
    std::int32_t like = 0;
    for (const LocalId n : neighbours[at(c)]) like += n != kNone && material(n) == material(c);
    for (auto e = static_cast<std::size_t>(fractions.offset[at(c)]);
         e < static_cast<std::size_t>(fractions.offset[at(c) + 1]); ++e) {
      const std::int32_t m = fractions.material[e];
      if (m == material(c))
        take_best(best, {m, like, piece.size[at(piece.of[at(c)])], fractions.value[e], mesh.hex_id[at(c)]});
      else
        take_best(best, {m, -1, 0, fractions.value[e], mesh.hex_id[at(c)]});
    }
  }
  std::erase_if(best, [](const Anchor& a) { return a.material < 0; });
  std::vector<Anchor> chosen(static_cast<std::size_t>(materials), Anchor{-1, 0, 0, 0, 0});
  for (const Anchor& a : comm().concatenate(best)) take_best(chosen, a);
  // Materials that have cells first; of the others none takes a cell that is locked already.
  std::stable_sort(chosen.begin(), chosen.end(),
                   [](const Anchor& a, const Anchor& b) { return (a.like >= 0) > (b.like >= 0); });
  for (const Anchor& a : chosen) {
    const auto found = std::lower_bound(mesh.hex_id.begin(), mesh.hex_id.end(), a.cell);
    if (a.material < 0 || found == mesh.hex_id.end() || *found != a.cell) continue;
    const auto c = static_cast<LocalId>(found - mesh.hex_id.begin());
    if (!owned(c) || locked_[at(c)]) continue;
    locked_[at(c)] = 1;
    if (material(c) != a.material) change_owned(c, a.material);
  }
  mesh.hex_exchange.copy_to_ghosts(locked_);
  share();
}

Pieces pieces(const Edits& edits, std::int64_t most) {
  const HexMesh& mesh = edits.mesh;
  DisjointSets sets(mesh.hexes.size());
  for (LocalId c = 0; c < mesh.size(); ++c) {
    bool alone = true;
    for (const LocalId n : edits.neighbours[at(c)]) {
      if (n == kNone || n > c || edits.material(n) != edits.material(c)) continue;
      if (alone)
        sets.attach(c, n);
      else
        sets.join(c, n);
      alone = false;
    }
  }
  Components components =
      connected_components(edits.comm(), std::move(sets), mesh.hex_homes(), mesh.hex_exchange);
  Pieces p{std::move(components.of), std::move(components.label), {}, {}};
  p.size.assign(p.label.size(), 0);
  p.shared.assign(p.label.size(), 0);
  for (LocalId c = 0; c < mesh.size(); ++c) p.size[at(p.of[at(c)])] += edits.owned(c);
  if (edits.comm().size() == 1 && mesh.hex_exchange.sends().empty()) return p;
  for (const auto* links : {&mesh.hex_exchange.sends(), &mesh.hex_exchange.receives()})
    for (const GhostExchange::Link& link : *links)
      for (const LocalId c : link.items) p.shared[at(p.of[at(c)])] = 1;
  struct Part {
    GlobalId label;
    std::int64_t size;
  };
  std::vector<Part> parts;
  for (std::size_t i = 0; i < p.label.size(); ++i)
    if (p.shared[i]) parts.push_back({p.label[i], std::min(p.size[i], most)});
  parts = edits.comm().concatenate(parts);
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.label < b.label; });
  for (std::size_t i = 0; i < p.label.size(); ++i) {
    if (!p.shared[i]) continue;
    auto part = std::lower_bound(parts.begin(), parts.end(), p.label[i],
                                 [](const Part& a, GlobalId label) { return a.label < label; });
    for (p.size[i] = 0; part != parts.end() && part->label == p.label[i]; ++part) p.size[i] += part->size;
  }
  return p;
}

}  // namespace sculpt
