#include "pipeline/hex_materials.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "pipeline/overlay.hpp"
#include "sculpt/input/element_fractions.hpp"

namespace sculpt {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool all_pure(const Comm& comm, const Fractions& f) {
  return comm.min(std::int64_t{f.material.size() == static_cast<std::size_t>(f.cells())}) == 1;
}

Box bounds_of(const HexList& hexes) {
  Box box{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (std::size_t h = 0; h < hexes.size; ++h)
    for (const Vec3& p : hexes.corners(h))
      for (std::size_t d = 0; d < 3; ++d) {
        box.lo[d] = std::min(box.lo[d], p[d]);
        box.hi[d] = std::max(box.hi[d], p[d]);
      }
  return box;
}

// The material of space of which data know nothing; it may have to be added to the table.
std::int32_t outside_of(const Deck& deck, HexMaterials& m) {
  if (m.table.void_material) return *m.table.void_material;
  std::vector<std::int64_t>& ids = m.table.block_id;
  const std::int64_t id = deck.given("void_mat") ? deck.void_mat : ids.back() + 1;
  const auto found = std::find(ids.begin(), ids.end(), id);
  if (found != ids.end() && deck.mesh_void) return static_cast<std::int32_t>(found - ids.begin());
  ids.push_back(found == ids.end() ? id : ids.back() + 1);
  m.table.void_material = static_cast<std::int32_t>(ids.size()) - 1;
  m.void_added = true;
  return *m.table.void_material;
}

// The materials of all cells by new indices; what becomes one material is added up.
Fractions renumbered(const Fractions& from, std::span<const std::int32_t> index) {
  Fractions to;
  to.reserve(static_cast<std::size_t>(from.cells()), from.material.size());
  std::vector<std::pair<std::int32_t, double>> entries;
  for (std::size_t c = 0; c + 1 < from.offset.size(); ++c) {
    entries.clear();
    for (auto e = static_cast<std::size_t>(from.offset[c]); e < static_cast<std::size_t>(from.offset[c + 1]);
         ++e)
      entries.emplace_back(index[at(from.material[e])], from.value[e]);
    std::stable_sort(entries.begin(), entries.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t e = 0; e < entries.size();) {
      double sum = entries[e].second;
      std::size_t last = e + 1;
      for (; last < entries.size() && entries[last].first == entries[e].first; ++last)
        sum += entries[last].second;
      to.add(entries[e].first, sum);
      e = last;
    }
    to.end_cell();
  }
  return to;
}

// What is void belongs to the block of its hex: entries of the void become entries of materials beyond the
// table, one per block.
void give_void_to_blocks(HexMaterials& m, std::span<const std::int32_t> block_of_hex) {
  const auto beyond = static_cast<std::int32_t>(m.table.block_id.size());
  for (std::size_t c = 0; c < block_of_hex.size(); ++c)
    for (auto e = static_cast<std::size_t>(m.owned.offset[c]);
         e < static_cast<std::size_t>(m.owned.offset[c + 1]); ++e)
      if (m.owned.material[e] == m.table.void_material) m.owned.material[e] = beyond + block_of_hex[c];
}

class GridOfHexes final : public MaterialSource {
 public:
  GridOfHexes(Grid grid, std::vector<GlobalId> cell, HexMaterials materials)
      : grid_(std::move(grid)), cell_(std::move(cell)), materials_(std::move(materials)) {}

  [[nodiscard]] const Grid& grid() const override { return grid_; }

  [[nodiscard]] MaterialData read(const Comm& comm, std::span<const IndexBox> wanted) override {
    // Per rank and cell that it wants: place in its box, number of entries, the entries.
    std::vector<std::vector<Entry>> to(wanted.size());
    const Fractions& f = materials_.owned;
    for (std::size_t r = 0; r < wanted.size(); ++r)
      for (std::size_t c = 0; c < cell_.size(); ++c) {
        const Index3 cell = whole(grid_.cells).cell(cell_[c]);
        if (!wanted[r].contains(cell)) continue;
        const std::int64_t place = wanted[r].position(cell);
        for (auto e = static_cast<std::size_t>(f.offset[c]); e < static_cast<std::size_t>(f.offset[c + 1]);
             ++e)
          to[r].push_back({place, f.material[e], f.value[e]});
      }
    std::vector<Entry> mine;
    for (const std::vector<Entry>& from : comm.all_to_all(to))
      mine.insert(mine.end(), from.begin(), from.end());
    std::sort(mine.begin(), mine.end(), [](const Entry& a, const Entry& b) {
      return std::pair(a.place, a.material) < std::pair(b.place, b.material);
    });
    MaterialData data;
    data.table = materials_.table;
    std::size_t next = 0;
    for (std::int64_t c = 0; c < wanted[static_cast<std::size_t>(comm.rank())].size(); ++c) {
      for (; next < mine.size() && mine[next].place == c; ++next)
        data.fractions.add(mine[next].material, mine[next].value);
      data.fractions.end_cell();
    }
    return data;
  }

 private:
  struct Entry {
    std::int64_t place;
    std::int32_t material;
    double value;
  };
  Grid grid_;
  std::vector<GlobalId> cell_;
  HexMaterials materials_;
};

}  // namespace

HexMaterials materials_of_variables(const Comm& comm, const std::string& path,
                                    std::span<const std::string> variables, std::span<const GlobalId> element,
                                    std::span<const double> value) {
  if (variables.empty())
    throw AgreedError(fmt::format(
        "no source of materials: '{}' has no element variables with volume fractions; give them, or "
        "input_spn, diatom_file or stl_file",
        path));
  ElementFractions f = element_fractions(comm, path, variables, element, value);
  HexMaterials m;
  m.table = std::move(f.table);
  m.owned = std::move(f.fractions);
  m.pure = all_pure(comm, m.owned);
  return m;
}

HexMaterials materials_of_source(const Comm& comm, const Deck& deck, const HexList& hexes, const Log& log) {
  const Box mine = bounds_of(hexes);
  Box all;
  for (std::size_t d = 0; d < 3; ++d) {
    all.lo[d] = comm.min(mine.lo[d]);
    all.hi[d] = comm.max(mine.hi[d]);
  }
  const auto source = open_source(comm, deck, log, all);
  const bool data = source->is_data();
  const IndexBox voxels = data && hexes.size > 0 ? voxels_for(source->grid(), mine) : IndexBox{};
  const std::vector<IndexBox> wanted = comm.gather_all(voxels);
  MaterialData read = source->read(comm, wanted);
  HexMaterials m;
  m.table = std::move(read.table);
  const std::int32_t outside = outside_of(deck, m);
  collectively(comm, "measuring the hexes of the input mesh", [&] {
    const auto field = source->hex_field(std::move(read.fractions), voxels, outside);
    for (std::size_t h = 0; h < hexes.size; ++h) field->measure(hexes.corners(h), m.owned);
  });
  m.exact = source->exact_surface();
  m.geometry = wanted_surfaces(deck, *source);
  m.pure = data && all_pure(comm, m.owned);
  return m;
}

std::vector<std::int32_t> add_blocks(const Comm& comm, const Deck& deck, HexMaterials& m,
                                     const BlockMaterials& blocks, const Log& log) {
  const bool void_to_blocks = comm.max(std::int64_t{!blocks.block_of_hex.empty()}) == 1;
  const std::size_t sources = m.table.block_id.size();
  if (void_to_blocks && m.table.void_material) give_void_to_blocks(m, blocks.block_of_hex);

  std::int64_t void_used = 0;
  for (const std::int32_t i : m.owned.material) void_used += m.table.void_material == i;
  const bool has_void = m.table.void_material && (!m.void_added || comm.sum(void_used) > 0);
  const auto is_void = [&](std::size_t i) { return m.table.void_material == static_cast<std::int32_t>(i); };

  // Ids: blocks keep theirs.
  std::vector<std::int64_t> ids = m.table.block_id, taken;
  for (std::size_t b = 0; b < blocks.id.size(); ++b)
    if (void_to_blocks || blocks.kept[b]) taken.push_back(blocks.id[b]);
  std::sort(taken.begin(), taken.end());
  const auto is_taken = [&](std::int64_t id) { return std::binary_search(taken.begin(), taken.end(), id); };
  std::int64_t largest = taken.empty() ? 0 : taken.back();
  for (std::size_t i = 0; i < sources; ++i)
    if (!is_void(i)) largest = std::max(largest, ids[i]);
  for (std::size_t i = 0; i < sources; ++i) {
    if (is_void(i) || !is_taken(ids[i])) continue;
    log.line("  material {} becomes block {}: block {} of the input mesh keeps its id", ids[i], largest + 1,
             ids[i]);
    ids[i] = ++largest;
  }
  if (has_void && m.void_added && !deck.given("void_mat"))
    ids[at(*m.table.void_material)] = largest + 1;
  else if (has_void && is_taken(ids[at(*m.table.void_material)]) && !deck.mesh_void)
    ids[at(*m.table.void_material)] = largest + 1;

  MaterialTable table;
  for (std::size_t i = 0; i < sources; ++i)
    if (!is_void(i) || has_void) table.block_id.push_back(ids[i]);
  table.block_id.insert(table.block_id.end(), taken.begin(), taken.end());
  std::sort(table.block_id.begin(), table.block_id.end());
  table.block_id.erase(std::unique(table.block_id.begin(), table.block_id.end()), table.block_id.end());
  const auto dense = [&](std::int64_t id) {
    return static_cast<std::int32_t>(std::lower_bound(table.block_id.begin(), table.block_id.end(), id) -
                                     table.block_id.begin());
  };
  std::vector<std::int32_t> index, of_block;
  for (std::size_t i = 0; i < sources; ++i) index.push_back(is_void(i) && !has_void ? kNone : dense(ids[i]));
  for (const std::int64_t id : blocks.id) of_block.push_back(is_taken(id) ? dense(id) : kNone);
  index.insert(index.end(), of_block.begin(), of_block.end());
  if (has_void) table.void_material = index[at(*m.table.void_material)];
  m.owned = renumbered(m.owned, index);
  // Questions come in new indices.
  std::vector<std::int32_t> old(table.block_id.size(), kNone);
  for (std::size_t i = 0; i < sources; ++i)
    if (index[i] != kNone) old[at(index[i])] = static_cast<std::int32_t>(i);
  const auto in_old = [&old](auto ask) {
    return [ask = std::move(ask), old](const Vec3& p, std::int32_t a, std::int32_t b) {
      return ask(p, a < 0 ? a : old[at(a)], b < 0 ? b : old[at(b)]);
    };
  };
  if (m.exact) m.exact = in_old(std::move(m.exact));
  if (m.geometry.nearest) m.geometry.nearest = in_old(std::move(m.geometry.nearest));
  m.table = std::move(table);
  return of_block;
}

std::unique_ptr<MaterialSource> grid_of_hexes(Grid grid, std::vector<GlobalId> cell, HexMaterials materials) {
  return std::make_unique<GridOfHexes>(std::move(grid), std::move(cell), std::move(materials));
}

}  // namespace sculpt
