#include "sculpt/vfrac/fractions.hpp"

#include <algorithm>

namespace sculpt {
namespace {

Index3 nearest_source(const Index3& cell, std::int64_t expand, const Index3& source_cells) {
  Index3 s;
  for (std::size_t d = 0; d < 3; ++d)
    s[d] = std::clamp<std::int64_t>(cell[d] - expand, 0, source_cells[d] - 1);
  return s;
}

}  // namespace

IndexBox source_of(const IndexBox& box, std::int64_t expand, const Index3& source_cells) {
  if (box.empty()) return {};
  const Index3 last{box.hi[0] - 1, box.hi[1] - 1, box.hi[2] - 1};
  IndexBox source{nearest_source(box.lo, expand, source_cells), nearest_source(last, expand, source_cells)};
  for (std::size_t d = 0; d < 3; ++d) ++source.hi[d];
  return source;
}

Fractions expand_fractions(const Fractions& data, const IndexBox& source_box, const IndexBox& box,
                           std::int64_t expand, const Index3& source_cells) {
  Fractions grown;
  grown.reserve(static_cast<std::size_t>(box.size()), static_cast<std::size_t>(box.size()));
  for (std::int64_t p = 0; p < box.size(); ++p) {
    const auto c =
        static_cast<std::size_t>(source_box.position(nearest_source(box.cell(p), expand, source_cells)));
    for (auto e = static_cast<std::size_t>(data.offset[c]); e < static_cast<std::size_t>(data.offset[c + 1]);
         ++e)
      grown.add(data.material[e], data.value[e]);
    grown.end_cell();
  }
  return grown;
}

Fractions with_ghosts(const HexMesh& cells, const Fractions& owned) {
  using G = GhostExchange;
  std::vector<std::size_t> place(
      cells.hexes.size());  // of an owned cell in its list, of a ghost in `received`
  std::size_t next = 0;
  for (std::size_t c = 0; c < place.size(); ++c)
    if (cells.layer[c] == 0) place[c] = next++;
  Fractions received;
  cells.hex_exchange.send_records(
      [&](LocalId c, std::vector<char>& bytes) {
        const std::int64_t first = owned.offset[place[at(c)]], last = owned.offset[place[at(c)] + 1];
        G::append(bytes, static_cast<std::int32_t>(last - first));
        for (auto e = static_cast<std::size_t>(first); e < static_cast<std::size_t>(last); ++e) {
          G::append(bytes, owned.material[e]);
          G::append(bytes, owned.value[e]);
        }
      },
      [&](LocalId ghost, const char* from) {
        std::int32_t count;
        G::take(from, count);
        for (std::int32_t e = 0; e < count; ++e) {
          std::int32_t material;
          double value;
          G::take(from, material);
          G::take(from, value);
          received.add(material, value);
        }
        place[at(ghost)] = static_cast<std::size_t>(received.cells());
        received.end_cell();
        return from;
      });
  Fractions all;
  all.reserve(place.size(), owned.material.size() + received.material.size());
  for (std::size_t c = 0; c < place.size(); ++c) {
    const Fractions& from = cells.layer[c] == 0 ? owned : received;
    for (auto e = static_cast<std::size_t>(from.offset[place[c]]);
         e < static_cast<std::size_t>(from.offset[place[c] + 1]); ++e)
      all.add(from.material[e], from.value[e]);
    all.end_cell();
  }
  return all;
}

void follow_assignment(Fractions& fractions, std::span<const std::int32_t> material) {
  Fractions followed;
  followed.reserve(material.size(), fractions.material.size());
  for (std::size_t c = 0; c < material.size(); ++c) {
    const auto first = static_cast<std::size_t>(fractions.offset[c]),
               last = static_cast<std::size_t>(fractions.offset[c + 1]);
    const auto from = fractions.value.begin();
    const auto top = static_cast<std::size_t>(
        std::max_element(from + fractions.offset[c], from + fractions.offset[c + 1]) - from);
    const double most = fractions.value[top],
                 mine = fraction_of(fractions, static_cast<LocalId>(c), material[c]);
    const std::int32_t former = fractions.material[top];
    bool placed = mine > 0;  // the new material already has an entry
    for (std::size_t e = first; e < last; ++e) {
      const std::int32_t m = fractions.material[e];
      if (!placed && m > material[c]) {
        followed.add(material[c], most);
        placed = true;
      }
      const double value = mine >= most || (m != former && m != material[c]) ? fractions.value[e]
                           : m == former                                     ? mine
                                                                             : most;
      if (value > 0) followed.add(m, value);
    }
    if (!placed) followed.add(material[c], most);
    followed.end_cell();
  }
  fractions = std::move(followed);
}

}  // namespace sculpt
