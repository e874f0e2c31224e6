#include "sculpt/adapt/leaf_mesh.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "adapt/template_store.hpp"
#include "sculpt/mesh/colour.hpp"
#include "sculpt/mesh/edit.hpp"
#include "sculpt/par/numbering.hpp"

namespace sculpt {
namespace {

constexpr std::int64_t kCodes =
    256;  // of the nodes at one position: itself, or the n-th inside the block there
constexpr std::uint8_t kUnset = 255;  // level of a node that no hex was seen at yet

// Where a coordinate in cells of the grid lies, between its planes.
double coordinate(const std::vector<double>& planes, double cells) {
  const auto i = static_cast<std::size_t>(cells);
  const double part = cells - static_cast<double>(i);
  return part == 0 ? planes[i] : planes[i] + part * (planes[i + 1] - planes[i]);
}

class Builder {
 public:
  Builder(const Comm& comm, const Grid& grid, const Forest& forest, const BlockParts& parts, int layers)
      : comm_(comm), grid_(grid), forest_(forest), parts_(parts), layers_(layers) {
    unit_ = std::int64_t{4}
            << forest.levels();  // per cell of the grid: an eighth of the finest cell in transition
    edge_ = 2 * unit_;
    per_block_ = edge_ * edge_ * edge_ * kCodes;
    const std::int64_t ring = (layers + 1) / 2;
    IndexBox region = parts.box[static_cast<std::size_t>(comm.rank())];
    for (std::size_t d = 0; d < 3; ++d) {
      margin_[d] = forest.periodic()[d] ? ring : 0;
      extended_[d] = parts.blocks[d] + 2 * margin_[d] + 1;
      if (region.empty()) continue;
      region.lo[d] = std::max(region.lo[d] - ring, -margin_[d]);
      region.hi[d] = std::min(region.hi[d] + ring, parts.blocks[d] + margin_[d]);
    }
    region_ = region;
  }

  LeafMesh run() {
    collectively(comm_, "refining the overlay grid", [&] {
      check_range();
      if (region_.empty()) return;
      collect_nodes();
      make_hexes();
      number_layers();
    });
    finish();
    return std::move(out_);
  }

 private:
  // A template with the place of its block; nodes of plain blocks are a 3x3x3 lattice.
  struct Placed {
    int level;
    Index3 low;  // of the block, in units, beyond the grid for images
    const BlockTemplate* shape;
    std::int64_t step;  // units per cell
    bool plain;         // cubes
  };

  void check_range() const {
    const double keys = static_cast<double>(extended_[0]) * static_cast<double>(extended_[1]) *
                        static_cast<double>(extended_[2]) * static_cast<double>(per_block_);
    if (keys > 0x1p62)
      throw Error(
          fmt::format("a grid of {} x {} x {} cells refined {} times has more places than can be numbered",
                      grid_.cells[0], grid_.cells[1], grid_.cells[2], forest_.levels()));
  }

  [[nodiscard]] std::int64_t block_number(const Index3& b) const {
    return (b[0] + margin_[0]) + extended_[0] * ((b[1] + margin_[1]) + extended_[1] * (b[2] + margin_[2]));
  }
  [[nodiscard]] Index3 block_at(const Index3& units) const {
    Index3 b;
    for (std::size_t d = 0; d < 3; ++d) b[d] = (units[d] + margin_[d] * edge_) / edge_ - margin_[d];
    return b;
  }
  [[nodiscard]] GlobalId key(const Index3& units, std::int64_t code) const {
    const Index3 b = block_at(units);
    const std::int64_t x = units[0] - b[0] * edge_, y = units[1] - b[1] * edge_, z = units[2] - b[2] * edge_;
    return block_number(b) * per_block_ + ((z * edge_ + y) * edge_ + x) * kCodes + code;
  }
  [[nodiscard]] Index3 wrapped(Index3 block) const {
    for (std::size_t d = 0; d < 3; ++d)
      if (forest_.periodic()[d]) block[d] = (block[d] + parts_.blocks[d]) % parts_.blocks[d];
    return block;
  }

  template <class Visit>
  void for_each_leaf_of(const Index3& base, Visit&& visit) const {
    const Index3 real = wrapped(base);
    forest_.for_each_leaf(real, [&](int level, const Index3& block) {
      const std::int64_t step = unit_ >> level;
      const std::uint32_t pattern = forest_.pattern(level, block);
      Placed p{level, {}, &transition(pattern, forest_.ends(level, block)), step, pattern == 0};
      for (std::size_t d = 0; d < 3; ++d) p.low[d] = 2 * block[d] * step + (base[d] - real[d]) * edge_;
      visit(p, block);
    });
  }
  // The key of a node of a template. Nodes inside the block go by its low corner.
  [[nodiscard]] GlobalId key_of(const Placed& p, std::size_t node) const {
    if (node >= p.shape->surface) return key(p.low, static_cast<std::int64_t>(node - p.shape->surface) + 1);
    Index3 units;
    for (std::size_t d = 0; d < 3; ++d)
      units[d] = p.low[d] + static_cast<std::int64_t>(p.shape->node[node][d] * static_cast<double>(p.step));
    return key(units, 0);
  }

  // All nodes, ascending in their keys. A block of level 0 uses every node on its low sides, so that nearly
  // all come block by block.
  void collect_nodes() {
    std::vector<GlobalId> mine, beyond;
    std::int64_t hexes = 0;
    for (std::int64_t i = 0; i < region_.size(); ++i) {
      const Index3 base = region_.cell(i);
      const GlobalId from = block_number(base) * per_block_, to = from + per_block_;
      mine.clear();
      for_each_leaf_of(base, [&](const Placed& p, const Index3&) {
        hexes += static_cast<std::int64_t>(p.shape->hex.size());
        for (std::size_t n = 0; n < p.shape->node.size(); ++n) {
          const GlobalId k = key_of(p, n);
          if (k >= from && k < to)
            mine.push_back(k);
          else if (!region_.contains(block_of(k)))
            beyond.push_back(k);
        }
      });
      std::sort(mine.begin(), mine.end());
      mine.erase(std::unique(mine.begin(), mine.end()), mine.end());
      keys_.insert(keys_.end(), mine.begin(), mine.end());
    }
    std::sort(beyond.begin(), beyond.end());
    beyond.erase(std::unique(beyond.begin(), beyond.end()), beyond.end());
    const auto inner = static_cast<std::ptrdiff_t>(keys_.size());
    keys_.insert(keys_.end(), beyond.begin(), beyond.end());
    std::inplace_merge(keys_.begin(), keys_.begin() + inner, keys_.end());
    constexpr std::int64_t kMost = std::numeric_limits<LocalId>::max() / 8;
    if (hexes > kMost || static_cast<std::int64_t>(keys_.size()) > kMost)
      throw Error(fmt::format("{} cells on one rank: at most {} fit; use more ranks", hexes, kMost));
    expected_ = static_cast<std::size_t>(hexes);
  }
  [[nodiscard]] Index3 block_of(GlobalId k) const {
    const std::int64_t b = k / per_block_;
    return {b % extended_[0] - margin_[0], b / extended_[0] % extended_[1] - margin_[1],
            b / extended_[0] / extended_[1] - margin_[2]};
  }

  void make_hexes() {
    HexMesh& m = out_.cells;
    const std::size_t nodes = keys_.size();
    m.position.resize(nodes);
    m.node_owner.resize(nodes);
    m.box_sides.resize(nodes);
    m.colour.resize(nodes);
    m.level.assign(nodes, kUnset);
    m.hexes.reserve(expected_);
    hex_key_.reserve(expected_);
    m.hex_owner.reserve(expected_);
    std::vector<LocalId> local;
    for (std::int64_t i = 0; i < region_.size(); ++i) {
      const Index3 base = region_.cell(i);
      const std::int32_t owner = parts_.owner_of(wrapped(base));
      const bool mine = owner == comm_.rank() && base == wrapped(base);
      std::int64_t number = block_number(base) << 32;
      for_each_leaf_of(base, [&](const Placed& p, const Index3& block) {
        find_nodes(p, local);
        for (std::size_t n = 0; n < local.size(); ++n) see(p, n, local[n]);
        Leaf leaf{p.level, block, !p.plain, m.size(), 0};
        for (const auto& corners : p.shape->hex) {
          Hex hex;
          for (std::size_t c = 0; c < 8; ++c) hex[c] = local[corners[c]];
          m.hexes.push_back(hex);
          hex_key_.push_back(number++);
          m.hex_owner.push_back(owner);
        }
        leaf.end = m.size();
        if (mine) out_.leaves.push_back(leaf);
      });
    }
  }

  void find_nodes(const Placed& p, std::vector<LocalId>& local) const {
    local.resize(p.shape->node.size());
    auto hint = keys_.begin();
    for (std::size_t n = 0; n < local.size(); ++n) {
      const GlobalId k = key_of(p, n);
      // Nodes in a row follow each other.
      if (hint == keys_.end() || *hint != k) hint = std::lower_bound(keys_.begin(), keys_.end(), k);
      local[n] = static_cast<LocalId>(hint - keys_.begin());
      ++hint;
    }
  }

  // Takes note that a leaf has a node.
  void see(const Placed& p, std::size_t n, LocalId local) {
    HexMesh& m = out_.cells;
    const std::uint8_t level = static_cast<std::uint8_t>(p.level);
    std::uint8_t colour = kNoColour;
    if (p.plain) {
      unsigned parity = 0;
      for (std::size_t d = 0; d < 3; ++d) {
        const std::int64_t cell = p.low[d] / p.step + static_cast<std::int64_t>(p.shape->node[n][d]);
        parity |= static_cast<unsigned>(cell & 1) << d;
      }
      colour = static_cast<std::uint8_t>(parity);
    }
    if (m.level[at(local)] != kUnset) {
      if (m.level[at(local)] != level) colour = kNoColour;
      if (m.colour[at(local)] == kNoColour) colour = kNoColour;
      m.colour[at(local)] = colour;
      m.level[at(local)] = std::max(m.level[at(local)], level);
      return;
    }
    m.level[at(local)] = level;
    m.colour[at(local)] = colour;
    place(p, n, local);
  }

  void place(const Placed& p, std::size_t n, LocalId local) {
    HexMesh& m = out_.cells;
    Vec3 x;
    unsigned sides = 0;
    Index3 units;
    for (std::size_t d = 0; d < 3; ++d) {
      const double in_units =
          static_cast<double>(p.low[d]) + p.shape->node[n][d] * static_cast<double>(p.step);
      units[d] = n < p.shape->surface ? static_cast<std::int64_t>(in_units) : p.low[d];
      if (!forest_.periodic()[d] && in_units == 0) sides |= 1U << (2 * d);
      if (!forest_.periodic()[d] && in_units == static_cast<double>(grid_.cells[d] * unit_))
        sides |= 2U << (2 * d);
      x[d] = coordinate(grid_.planes[d], in_units / static_cast<double>(unit_));
    }
    Index3 block = wrapped(block_at(units));
    for (std::size_t d = 0; d < 3; ++d) block[d] = std::min(block[d], parts_.blocks[d] - 1);
    m.position[at(local)] = x;
    m.box_sides[at(local)] = static_cast<std::uint8_t>(sides);
    m.node_owner[at(local)] = parts_.owner_of(block);
  }

  // Ghost layers outwards from the owned hexes; what is farther away is dropped.
  void number_layers() {
    HexMesh& m = out_.cells;
    const auto beyond = static_cast<std::uint8_t>(layers_ + 1);
    m.layer.assign(m.hexes.size(), beyond);
    std::vector<std::uint8_t> reached(m.position.size(), 0);
    for (const Leaf& leaf : out_.leaves)
      for (LocalId h = leaf.first; h < leaf.end; ++h) {
        m.layer[at(h)] = 0;
        for (const LocalId n : m.hexes[at(h)]) reached[at(n)] = 1;
      }
    std::vector<LocalId> outside;
    for (LocalId h = 0; h < m.size(); ++h)
      if (m.layer[at(h)] != 0) outside.push_back(h);
    for (int layer = 1; layer <= layers_; ++layer) {
      std::vector<LocalId> taken;
      for (const LocalId h : outside) {
        const Hex& hex = m.hexes[at(h)];
        if (m.layer[at(h)] == beyond &&
            std::any_of(hex.begin(), hex.end(), [&](LocalId n) { return reached[at(n)] != 0; }))
          taken.push_back(h);
      }
      for (const LocalId h : taken) {
        m.layer[at(h)] = static_cast<std::uint8_t>(layer);
        for (const LocalId n : m.hexes[at(h)]) reached[at(n)] = 1;
      }
    }
    drop_far_hexes(beyond);
  }
  void drop_far_hexes(std::uint8_t beyond) {
    HexMesh& m = out_.cells;
    std::vector<std::uint8_t> far(m.hexes.size());
    for (std::size_t h = 0; h < far.size(); ++h) far[h] = m.layer[h] == beyond;
    if (std::none_of(far.begin(), far.end(), [](std::uint8_t f) { return f != 0; })) return;
    const std::vector<LocalId> index = indices_without(far);
    compact(m.hexes, index);
    compact(m.hex_owner, index);
    compact(m.layer, index);
    compact(hex_key_, index);
    for (Leaf& leaf : out_.leaves) {
      const LocalId count = leaf.end - leaf.first;
      leaf.first = index[at(leaf.first)];
      leaf.end = leaf.first + count;
    }
    m.node_id.swap(keys_);
    drop_unused_nodes(m);
    m.node_id.swap(keys_);
  }

  void finish() {
    HexMesh& m = out_.cells;
    GlobalId total = 0;
    m.node_id = dense_numbers(comm_, keys_, total);
    m.hex_id = dense_numbers(comm_, hex_key_, total);
    keys_ = {};
    hex_key_ = {};
    m.material.assign(m.hexes.size(), 0);
    m.cell_size = grid_.cell_size();
    m.ghost_layers = layers_;
    m.node_exchange = GhostExchange(comm_, m.node_id, m.node_owner);
    m.hex_exchange = GhostExchange(comm_, m.hex_id, m.hex_owner);
    // The outermost nodes do not see all their hexes.
    m.node_exchange.copy_to_ghosts(m.level);
    m.node_exchange.copy_to_ghosts(m.colour);
    const std::vector<std::uint8_t> preset = m.colour;
    colour_nodes(m, preset);
  }

  const Comm& comm_;
  const Grid& grid_;
  const Forest& forest_;
  const BlockParts& parts_;
  int layers_;
  std::int64_t unit_ = 0, edge_ = 0, per_block_ = 0;  // per cell; per block; keys per block
  Index3 margin_{0, 0, 0}, extended_{0, 0, 0};        // blocks of images per side; blocks that have keys
  IndexBox region_;                                   // blocks of level 0 that are looked at
  std::size_t expected_ = 0;
  std::vector<GlobalId> keys_, hex_key_;
  LeafMesh out_;
};

}  // namespace

LeafMesh leaf_mesh(const Comm& comm, const Grid& grid, const Forest& forest, const BlockParts& parts,
                   int layers) {
  return Builder(comm, grid, forest, parts, layers).run();
}

std::int64_t hexes_in(const Forest& forest, const Index3& base_block) {
  std::int64_t count = 0;
  forest.for_each_leaf(base_block, [&](int level, const Index3& block) {
    count += static_cast<std::int64_t>(
        transition(forest.pattern(level, block), forest.ends(level, block)).hex.size());
  });
  return count;
}

Vec3 grid_point(const Grid& grid, int level, const Index3& corner) {
  Vec3 x;
  for (std::size_t d = 0; d < 3; ++d)
    x[d] = coordinate(grid.planes[d], std::ldexp(static_cast<double>(corner[d]), -level));
  return x;
}

}  // namespace sculpt
