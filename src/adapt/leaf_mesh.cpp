#include "sculpt/adapt/leaf_mesh.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "adapt/template_store.hpp"
#include "sculpt/mesh/colour.hpp"
#include "sculpt/mesh/edit.hpp"
#include "sculpt/par/numbering.hpp"

namespace sculpt {
namespace {

constexpr std::int64_t kCodes =
    256;  // of the nodes at one position: itself, or the n-th inside the block there
constexpr std::int64_t kFinest =
    4;  // units per finest cell: transitions of the level before need halves of halves
constexpr std::uint8_t kUnset = 255;  // level of a node that no hex was seen at yet

// Where a coordinate in cells of the grid lies, between its planes.
double coordinate(const std::vector<double>& planes, double cells) {
  const auto i = static_cast<std::size_t>(cells);
  const double part = cells - static_cast<double>(i);
  return part == 0 ? planes[i] : planes[i] + part * (planes[i + 1] - planes[i]);
}

class Builder {
 public:
  Builder(const Comm& comm, const Grid& grid, const Forest& forest, const BlockParts& parts, int layers,
          const std::optional<Vec3>& high)
      : comm_(comm), grid_(grid), forest_(forest), parts_(parts), layers_(layers) {
    const std::array<bool, 3>& axes = forest.periodic();
    periodic_ = axes[0] || axes[1] || axes[2];
    for (std::size_t d = 0; d < 3; ++d) high_[d] = high ? (*high)[d] : grid.planes[d].back();
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
      index_blocks();
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
    Index3 base;  // the block of level 0 it is in, beyond the grid for images
    Index3 low;   // its low corner, in units from that of the base
    const BlockTemplate* shape;
    std::int64_t step;  // units per cell
    bool plain;         // cubes
  };

  void check_range() const {
    const double keys = static_cast<double>(extended_[0]) * static_cast<double>(extended_[1]) *
                        static_cast<double>(extended_[2]) * static_cast<double>(per_block_);
    const double blocks = keys / static_cast<double>(per_block_);  // ids of hexes begin with 31 bits for them
    if (keys > 0x1p62 || blocks > 0x1p31)
      throw Error(
          fmt::format("a grid of {} x {} x {} cells refined {} times has more places than can be numbered",
                      grid_.cells[0], grid_.cells[1], grid_.cells[2], forest_.levels()));
  }

  [[nodiscard]] std::int64_t block_number(const Index3& b) const {
    return (b[0] + margin_[0]) + extended_[0] * ((b[1] + margin_[1]) + extended_[1] * (b[2] + margin_[2]));
  }
  // How many periods a block lies beyond the grid, and the block of the grid that it is an image of.
  [[nodiscard]] Image image_of(const Index3& block) const {
    Image image{0, 0, 0};
    for (std::size_t d = 0; d < 3; ++d)
      if (forest_.periodic()[d])
        image[d] = static_cast<std::int16_t>((block[d] - (block[d] < 0 ? parts_.blocks[d] - 1 : 0)) /
                                             parts_.blocks[d]);  // rounded down
    return image;
  }
  [[nodiscard]] Index3 wrapped(Index3 block) const {
    const Image image = image_of(block);
    for (std::size_t d = 0; d < 3; ++d) block[d] -= image[d] * parts_.blocks[d];
    return block;
  }
  // A number that blocks of level 0 with a common hex do not share: their parity, with a third value for the
  // last of an odd number of blocks where it meets the first.
  [[nodiscard]] std::uint8_t turn_of(const Index3& block) const {
    std::int64_t turn = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      const bool meets_first =
          forest_.periodic()[d] && parts_.blocks[d] % 2 != 0 && block[d] == parts_.blocks[d] - 1;
      turn = 3 * turn + (meets_first ? 2 : block[d] % 2);
    }
    return static_cast<std::uint8_t>(turn);
  }
  [[nodiscard]] std::int32_t owner_of(Index3 block, const Image& image) const {
    for (std::size_t d = 0; d < 3; ++d)
      block[d] = std::min(block[d] - image[d] * parts_.blocks[d], parts_.blocks[d] - 1);
    return parts_.owner_of(block) + (image == Image{0, 0, 0} ? 0 : comm_.size());
  }

  template <class Visit>
  void for_each_leaf_of(const Index3& base, Visit&& visit) const {
    const Index3 real = wrapped(base);
    forest_.for_each_leaf(real, [&](int level, const Index3& block) {
      const std::int64_t step = unit_ >> level;
      const std::uint32_t pattern = forest_.pattern(level, block);
      Placed p{level, base, {}, &transition(pattern, forest_.ends(level, block)), step, pattern == 0};
      for (std::size_t d = 0; d < 3; ++d) p.low[d] = 2 * block[d] * step - real[d] * edge_;
      visit(p, block);
    });
  }
  // Where a node of a template lies, in units from the low corner of the block of level 0. Nodes inside the
  // block go by its low corner.
  [[nodiscard]] Index3 place_of(const Placed& p, std::size_t node) const {
    if (node >= p.shape->surface) return p.low;
    Index3 units;
    for (std::size_t d = 0; d < 3; ++d)
      units[d] = p.low[d] + static_cast<std::int64_t>(p.shape->node[node][d] * static_cast<double>(p.step));
    return units;
  }
  // The key of a node; its block moves to the one that the node belongs to: the high sides of a block are
  // those of the next.
  [[nodiscard]] GlobalId key_of(const Placed& p, std::size_t node, Index3& block) const {
    Index3 units = place_of(p, node);
    block = p.base;
    for (std::size_t d = 0; d < 3; ++d)
      if (units[d] == edge_) {
        units[d] = 0;
        ++block[d];
      }
    const std::int64_t code =
        node < p.shape->surface ? 0 : static_cast<std::int64_t>(node - p.shape->surface) + 1;
    return block_number(block) * per_block_ + ((units[2] * edge_ + units[1]) * edge_ + units[0]) * kCodes +
           code;
  }

  // All nodes, ascending in their keys. A block of level 0 uses every node on its low sides, so that nearly
  // all come block by block.
  void collect_nodes() {
    std::vector<GlobalId> mine, beyond;
    std::int64_t hexes = 0;
    for (std::int64_t i = 0; i < region_.size(); ++i) {
      const Index3 base = region_.cell(i);
      mine.clear();
      for_each_leaf_of(base, [&](const Placed& p, const Index3&) {
        hexes += static_cast<std::int64_t>(p.shape->hex.size());
        for (std::size_t n = 0; n < p.shape->node.size(); ++n) {
          Index3 block;
          const GlobalId k = key_of(p, n, block);
          if (block == base)
            mine.push_back(k);
          else if (!region_.contains(block))
            beyond.push_back(k);
        }
      });
      refuse_more_than_fit(hexes);
      std::sort(mine.begin(), mine.end());
      mine.erase(std::unique(mine.begin(), mine.end()), mine.end());
      keys_.insert(keys_.end(), mine.begin(), mine.end());
    }
    std::sort(beyond.begin(), beyond.end());
    beyond.erase(std::unique(beyond.begin(), beyond.end()), beyond.end());
    const auto inner = static_cast<std::ptrdiff_t>(keys_.size());
    keys_.insert(keys_.end(), beyond.begin(), beyond.end());
    std::inplace_merge(keys_.begin(), keys_.begin() + inner, keys_.end());
    refuse_more_than_fit(static_cast<std::int64_t>(keys_.size()));
    expected_ = static_cast<std::size_t>(hexes);
  }
  static void refuse_more_than_fit(std::int64_t cells) {
    constexpr std::int64_t kMost = std::numeric_limits<LocalId>::max() / 8;
    if (cells > kMost)
      throw Error(fmt::format("more than {} refined cells on one rank: give fewer adapt_levels or more ranks",
                              kMost));
  }

  void make_hexes() {
    HexMesh& m = out_.cells;
    const std::size_t nodes = keys_.size();
    m.position.resize(nodes);
    m.node_owner.resize(nodes);
    m.box_sides.resize(nodes);
    m.colour.resize(nodes);
    level_.assign(nodes, kUnset);
    turn_.resize(nodes);
    m.hexes.reserve(expected_);
    hex_key_.reserve(expected_);
    m.hex_owner.reserve(expected_);
    if (periodic_) {
      m.node_home.resize(nodes);
      m.node_image.resize(nodes);
    }
    std::vector<LocalId> local;
    for (std::int64_t i = 0; i < region_.size(); ++i) {
      const Index3 base = region_.cell(i);
      const Image image = image_of(base);
      const std::int32_t owner = owner_of(base, image);
      const bool mine = owner == comm_.rank();
      std::int64_t number = block_number(base) << 32, home = block_number(wrapped(base)) << 32;
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
          if (!periodic_) continue;
          m.hex_home.push_back(home++);
          m.hex_image.push_back(image);
        }
        leaf.end = m.size();
        if (mine) out_.leaves.push_back(leaf);
      });
    }
  }

  // Where the keys of the blocks begin that the region uses nodes of.
  void index_blocks() {
    known_ = region_;
    for (std::size_t d = 0; d < 3; ++d) ++known_.hi[d];
    start_.clear();
    for (std::int64_t i = 0; i < known_.size(); ++i)
      start_.push_back(
          std::lower_bound(keys_.begin(), keys_.end(), block_number(known_.cell(i)) * per_block_) -
          keys_.begin());
    start_.push_back(static_cast<std::ptrdiff_t>(keys_.size()));
  }

  void find_nodes(const Placed& p, std::vector<LocalId>& local) const {
    local.resize(p.shape->node.size());
    for (std::size_t n = 0; n < local.size(); ++n) {
      Index3 block;
      const GlobalId k = key_of(p, n, block);
      const auto i = static_cast<std::size_t>(known_.position(block));
      const auto found = std::lower_bound(keys_.begin() + start_[i], keys_.begin() + start_[i + 1], k);
      local[n] = static_cast<LocalId>(found - keys_.begin());
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
        const std::int64_t cell =
            (p.base[d] * edge_ + p.low[d]) / p.step + static_cast<std::int64_t>(p.shape->node[n][d]);
        parity |= static_cast<unsigned>(cell & 1) << d;
      }
      colour = static_cast<std::uint8_t>(parity);
    } else if (n >= p.shape->surface) {
      colour = p.shape->interior_colour[n - p.shape->surface];
    }
    if (level_[at(local)] != kUnset) {
      if (level_[at(local)] != level) colour = kNoColour;
      if (m.colour[at(local)] == kNoColour) colour = kNoColour;
      m.colour[at(local)] = colour;
      level_[at(local)] = std::max(level_[at(local)], level);
      return;
    }
    level_[at(local)] = level;
    m.colour[at(local)] = colour;
    place(p, n, local);
  }

  void place(const Placed& p, std::size_t n, LocalId local) {
    HexMesh& m = out_.cells;
    Index3 block;
    const GlobalId key = key_of(p, n, block);
    const Image image = image_of(block);
    Vec3 x;
    unsigned sides = 0;
    const Index3 finest = forest_.cells(forest_.levels());
    for (std::size_t d = 0; d < 3 && image == Image{0, 0, 0}; ++d) {  // images are told by their homes
      const double in_units = static_cast<double>(p.base[d] * edge_ + p.low[d]) +
                              p.shape->node[n][d] * static_cast<double>(p.step);
      x[d] = coordinate(grid_.planes[d], in_units / static_cast<double>(unit_));
      if (forest_.periodic()[d]) continue;
      if (in_units == 0) sides |= 1U << (2 * d);
      if (in_units != static_cast<double>(kFinest * finest[d])) continue;
      sides |= 2U << (2 * d);
      x[d] = high_[d];
    }
    m.node_owner[at(local)] = owner_of(block, image);
    turn_[at(local)] = turn_of(wrapped(block));
    if (periodic_) {
      m.node_home[at(local)] = key + (block_number(wrapped(block)) - block_number(block)) * per_block_;
      m.node_image[at(local)] = image;
    }
    m.position[at(local)] = x;
    m.box_sides[at(local)] = static_cast<std::uint8_t>(sides);
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
    if (periodic_) {
      compact(m.hex_home, index);
      compact(m.hex_image, index);
    }
    for (Leaf& leaf : out_.leaves) {
      const LocalId count = leaf.end - leaf.first;
      leaf.first = index[at(leaf.first)];
      leaf.end = leaf.first + count;
    }
    m.node_id.swap(keys_);
    const std::vector<LocalId> node = drop_unused_nodes(m);
    compact(turn_, node);
    compact(level_, node);
    m.node_id.swap(keys_);
  }

  void finish() {
    HexMesh& m = out_.cells;
    m.node_id = numbered(std::move(keys_), m.node_home);
    m.hex_id = numbered(std::move(hex_key_), m.hex_home);
    m.material.assign(m.hexes.size(), 0);
    m.cell_size = grid_.cell_size();
    m.ghost_layers = layers_;
    set_period(m, grid_, forest_.periodic(), layers_);
    connect_ranks(comm_, m);
    share_positions(m);
    // The outermost nodes do not see all their hexes.
    m.node_exchange.copy_to_ghosts(level_);
    for (const std::uint8_t level : level_) m.node_unit.push_back(std::ldexp(1.0F, -level));
    m.node_exchange.copy_to_ghosts(m.colour);
    const std::vector<std::uint8_t> preset = m.colour;
    colour_nodes(m, preset, turn_);
  }

  // Dense ids of ascending keys. `homes`, of periodic meshes, becomes dense ids as well: the key itself of
  // what is no image, and that of the home, which this rank need not have, of an image.
  [[nodiscard]] std::vector<GlobalId> numbered(std::vector<GlobalId> keys,
                                               std::vector<GlobalId>& homes) const {
    GlobalId total = 0;
    if (!periodic_) return dense_numbers(comm_, keys, total);
    std::vector<GlobalId> away, all;
    for (std::size_t i = 0; i < keys.size(); ++i)
      if (homes[i] != keys[i]) away.push_back(homes[i]);
    std::sort(away.begin(), away.end());
    away.erase(std::unique(away.begin(), away.end()), away.end());
    all.reserve(keys.size() + away.size());
    std::set_union(keys.begin(), keys.end(), away.begin(), away.end(), std::back_inserter(all));
    const std::vector<GlobalId> dense = dense_numbers(comm_, all, total);
    std::size_t next = 0;
    for (std::size_t i = 0; i < keys.size(); ++i) {
      while (all[next] != keys[i]) ++next;
      const bool is_image = homes[i] != keys[i];
      keys[i] = dense[next];
      homes[i] = is_image ? dense[static_cast<std::size_t>(
                                std::lower_bound(all.begin(), all.end(), homes[i]) - all.begin())]
                          : keys[i];
    }
    return keys;
  }

  const Comm& comm_;
  const Grid& grid_;
  const Forest& forest_;
  const BlockParts& parts_;
  int layers_;
  bool periodic_;                                     // in any axis
  Vec3 high_;                                         // corner of the domain
  std::int64_t unit_ = 0, edge_ = 0, per_block_ = 0;  // per cell; per block; keys per block
  Index3 margin_{0, 0, 0}, extended_{0, 0, 0};        // blocks of images per side; blocks that have keys
  IndexBox region_;                                   // blocks of level 0 that are looked at
  IndexBox known_;                                    // those that they use nodes of
  std::vector<std::ptrdiff_t> start_;                 // of the keys of each of these
  std::size_t expected_ = 0;
  std::vector<GlobalId> keys_, hex_key_;
  std::vector<std::uint8_t> turn_;   // of the nodes, when they are coloured
  std::vector<std::uint8_t> level_;  // of the nodes: that of the smallest cells around
  LeafMesh out_;
};

}  // namespace

LeafMesh leaf_mesh(const Comm& comm, const Grid& grid, const Forest& forest, const BlockParts& parts,
                   int layers, const std::optional<Vec3>& high) {
  return Builder(comm, grid, forest, parts, layers, high).run();
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
