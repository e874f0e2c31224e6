#include "adapt/block_template.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <optional>
#include <utility>

#include "adapt/template_shape.hpp"
#include "sculpt/geom/hex.hpp"
#include "sculpt/mesh/colour.hpp"

namespace sculpt {

const std::array<std::array<int, 3>, kBlockNeighbours> kBlockOffset = [] {
  std::array<std::array<int, 3>, kBlockNeighbours> offset{};
  std::size_t bit = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1}) offset[bit++][axis] = side;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int second : {-1, 1})
      for (const int first : {-1, 1}) {
        offset[bit][axis == 0 ? 1 : 0] = first;
        offset[bit++][axis == 2 ? 1 : 2] = second;
      }
  return offset;
}();

namespace {

// A corner of a new hex: the centre of the old corners that are named (one: the corner itself; two: the
// middle of an edge; four: of a face; eight: of the hex), as a mask. Sites that `merged` of a Cut names
// together are one node.
using Site = std::uint8_t;
using NewHex = std::array<Site, 8>;

constexpr Site site(std::initializer_list<int> corners) {
  unsigned mask = 0;
  for (const int c : corners) mask |= 1U << c;
  return static_cast<Site>(mask);
}

// What becomes of a hex with some corners marked; all edges from a marked corner to one that is not are
// halved.
struct Cut {
  Site marked;
  std::vector<NewHex> hexes;
  std::vector<std::vector<Site>> merged;  // sites that become one node
};

// The templates, each for one position of its marked corners.
const std::vector<Cut>& canonical_cuts() {
  constexpr auto s = site;
  static const std::vector<Cut> cuts = [] {
    const Site c0 = s({0}), c1 = s({1}), c2 = s({2}), c3 = s({3}), c4 = s({4}), c5 = s({5}), c6 = s({6}),
               c7 = s({7});
    std::vector<Cut> all;
    // One corner: four hexes around the centre.
    const Site ex = s({0, 1}), ey = s({0, 3}), ez = s({0, 4}), fz = s({0, 1, 2, 3}), fy = s({0, 1, 4, 5}),
               fx = s({0, 3, 4, 7}), v = s({0, 1, 2, 3, 4, 5, 6, 7});
    all.push_back({s({0}),
                   {{c0, ex, fz, ey, ez, fy, v, fx},
                    {ex, c1, c2, fz, fy, c5, c6, v},
                    {ey, fz, c2, c3, fx, v, c6, c7},
                    {ez, fy, v, fx, c4, c5, c6, c7}},
                   {}});
    // An edge: three hexes.
    const Site a0 = s({0, 3}), a1 = s({1, 2}), b0 = s({0, 4}), b1 = s({1, 5}), d0 = s({0, 3, 4, 7}),
               d1 = s({1, 2, 5, 6});
    all.push_back({s({0, 1}),
                   {{c0, c1, a1, a0, b0, b1, d1, d0},
                    {a0, a1, c2, c3, d0, d1, c6, c7},
                    {b0, b1, d1, d0, c4, c5, c6, c7}},
                   {}});
    // A face: halves.
    const Site h0 = s({0, 4}), h1 = s({1, 5}), h2 = s({2, 6}), h3 = s({3, 7});
    all.push_back(
        {s({0, 1, 2, 3}), {{c0, c1, c2, c3, h0, h1, h2, h3}, {h0, h1, h2, h3, c4, c5, c6, c7}}, {}});
    // Three corners of a face. The quad (0,1,2,3) becomes the quad (0,1,p,3) and the edge p-2: the middles of
    // the edges at corner 2 are one node, and the hexes beyond the faces at corner 2 become neighbours.
    const Site p = s({1, 2}), f = d1;
    all.push_back({s({0, 1, 3}),
                   {{c0, c1, p, c3, h0, h1, f, h3}, {h0, h1, f, h3, c4, c5, c6, c7}},
                   {{p, s({2, 3})}, {f, s({2, 3, 6, 7})}}});
    // More, where a pass meets the merged nodes of the one before: the unmarked corners move.
    const Site q = s({2, 6});
    all.push_back({s({0, 1, 2, 3, 4, 5, 7}), {{c0, c1, c2, c3, c4, c5, q, c7}}, {{q, s({5, 6}), s({6, 7})}}});
    const Site r = s({3, 7});
    all.push_back(
        {s({0, 1, 2, 3, 4, 5}), {{c0, c1, c2, c3, c4, c5, q, r}}, {{q, s({5, 6})}, {r, s({4, 7})}}});
    all.push_back({s({0, 1, 2, 3, 4, 5, 6, 7}), {{c0, c1, c2, c3, c4, c5, c6, c7}}, {}});
    return all;
  }();
  return cuts;
}

Site turned(Site in, const std::array<std::uint8_t, 8>& turn) {
  unsigned out = 0;
  for (std::size_t c = 0; c < 8; ++c)
    if (in >> c & 1) out |= 1U << turn[c];
  return static_cast<Site>(out);
}

// The 24 turns of a hex: where each corner goes.
std::vector<std::array<std::uint8_t, 8>> turns() {
  std::vector<std::array<std::uint8_t, 8>> all;
  std::array<int, 3> axis{0, 1, 2};
  do {
    const bool odd = (axis[0] > axis[1]) != ((axis[0] > axis[2]) != (axis[1] > axis[2]));
    for (unsigned flips = 0; flips < 8; ++flips) {
      if ((std::popcount(flips) % 2 != 0) != odd) continue;
      std::array<std::uint8_t, 8> turn{};
      for (std::size_t c = 0; c < 8; ++c) {
        std::array<int, 3> to{};
        for (std::size_t d = 0; d < 3; ++d)
          to[static_cast<std::size_t>(axis[d])] = kCornerOffset[c][d] ^ static_cast<int>(flips >> d & 1);
        for (std::size_t o = 0; o < 8; ++o)
          if (kCornerOffset[o] == to) turn[c] = static_cast<std::uint8_t>(o);
      }
      all.push_back(turn);
    }
  } while (std::next_permutation(axis.begin(), axis.end()));
  return all;
}

// Per mask of marked corners its cut; empty where there is none.
const std::array<std::optional<Cut>, 256>& cuts() {
  static const std::array<std::optional<Cut>, 256> table = [] {
    std::array<std::optional<Cut>, 256> all;
    for (const Cut& cut : canonical_cuts())
      for (const auto& turn : turns()) {
        auto& slot = all[turned(cut.marked, turn)];
        if (slot) continue;
        Cut mine = cut;
        mine.marked = turned(cut.marked, turn);
        for (NewHex& hex : mine.hexes)
          for (Site& x : hex) x = turned(x, turn);
        for (auto& group : mine.merged)
          for (Site& x : group) x = turned(x, turn);
        slot = std::move(mine);
      }
    return all;
  }();
  return table;
}

// Planes of the block that hold a node: bit 3 * axis + 0 (low side), 1 (middle), 2 (high side). Topological:
// a merged node is on all planes of its members, wherever it lies.
using Planes = std::uint16_t;
constexpr Planes kSurface = 0b101101101;
constexpr Planes plane(std::size_t axis, std::size_t which) {
  return static_cast<Planes>(1U << (3 * axis + which));
}

class BlockCutter {
 public:
  BlockCutter(BlockPattern pattern, unsigned ends) : pattern_(pattern) {
    for (std::size_t d = 0; d < 3; ++d)
      if (ends >> d & 1) outer_ |= plane(d, 1);
    for (int k = 0; k <= 2; ++k)
      for (int j = 0; j <= 2; ++j)
        for (int i = 0; i <= 2; ++i) {
          position_.push_back({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
          planes_.push_back(static_cast<Planes>(plane(0, static_cast<std::size_t>(i)) |
                                                plane(1, static_cast<std::size_t>(j)) |
                                                plane(2, static_cast<std::size_t>(k))));
        }
    for (int cell = 0; cell < 8; ++cell) {
      Hex hex;
      for (std::size_t c = 0; c < 8; ++c)
        hex[c] = ((cell & 1) + kCornerOffset[c][0]) + 3 * ((cell >> 1 & 1) + kCornerOffset[c][1]) +
                 9 * ((cell >> 2) + kCornerOffset[c][2]);
      hexes_.push_back(hex);
      half_.push_back(static_cast<std::uint8_t>(cell));
    }
  }

  // False where no valid transition exists.
  bool run() {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      mark(axis);
      if (!close(axis) || !cut()) return false;
    }
    return no_doublets();
  }

  [[nodiscard]] const std::vector<Hex>& hexes() const { return hexes_; }
  [[nodiscard]] const std::vector<std::uint8_t>& halves() const { return half_; }
  [[nodiscard]] const std::vector<Vec3>& positions() const { return position_; }
  [[nodiscard]] std::uint8_t double_sides() const { return double_sides_; }
  [[nodiscard]] bool on_surface(LocalId n) const { return (planes_[at(n)] & kSurface) != 0; }
  [[nodiscard]] bool on_middle(LocalId n, std::size_t axis) const {
    return (planes_[at(n)] & plane(axis, 1)) != 0;
  }

 private:
  using Quad = std::array<LocalId, 4>;

  // The nodes of refined blocks on the middle plane.
  void mark(std::size_t axis) {
    marked_.assign(position_.size(), 0);
    for (std::size_t bit = 0; bit < kBlockNeighbours; ++bit) {
      if (!(pattern_ >> bit & 1) || kBlockOffset[bit][axis] != 0) continue;
      Planes shared = plane(axis, 1);
      for (std::size_t d = 0; d < 3; ++d)
        if (kBlockOffset[bit][d] != 0) shared |= plane(d, kBlockOffset[bit][d] < 0 ? 0 : 2);
      for (std::size_t n = 0; n < planes_.size(); ++n)
        if ((planes_[n] & shared) == shared) marked_[n] = 1;
    }
  }

  // The quads of the middle plane.
  [[nodiscard]] std::vector<Quad> quads_of(std::size_t axis) const {
    std::map<Quad, Quad> found;  // by sorted nodes
    for (const Hex& hex : hexes_)
      for (const auto& face : kFaces) {
        Quad quad;
        Planes common = 0x1ff;
        for (std::size_t v = 0; v < 4; ++v) {
          quad[v] = hex[static_cast<std::size_t>(face[v])];
          common &= planes_[at(quad[v])];
        }
        if (!(common & plane(axis, 1))) continue;
        Quad key = quad;
        std::sort(key.begin(), key.end());
        found.emplace(key, quad);
      }
    std::vector<Quad> quads;
    for (const auto& [key, quad] : found) quads.push_back(quad);
    return quads;
  }

  // Marks more nodes until every quad can be cut: two marked nodes across a quad mark it all, and a node that
  // would lose so many edges by merging that fewer than three are left is marked. False where this reaches
  // the surface of the block, which other blocks share.
  bool close(std::size_t axis) {
    const std::vector<Quad> quads = quads_of(axis);
    for (bool changed = true; changed;) {
      changed = false;
      std::map<LocalId, int> merging;  // unmarked node -> quads whose other three nodes are marked
      for (const Quad& q : quads) {
        int count = 0;
        for (const LocalId n : q) count += marked_[at(n)];
        const bool diagonal = count == 2 && marked_[at(q[0])] == marked_[at(q[2])];
        if (diagonal) {
          for (const LocalId n : q)
            if (!add(n)) return false;
          changed = true;
        } else if (count == 3) {
          for (const LocalId n : q)
            if (!marked_[at(n)]) ++merging[n];
        }
      }
      if (changed) continue;
      for (const auto& [node, merges] : merging) {
        if (on_surface(node) || edges_at(quads, node) - merges >= 3) continue;
        if (!add(node)) return false;
        changed = true;
      }
    }
    return true;
  }
  bool add(LocalId node) {
    if (marked_[at(node)]) return true;
    if (on_surface(node)) return false;
    marked_[at(node)] = 1;
    return true;
  }
  static int edges_at(const std::vector<Quad>& quads, LocalId node) {
    std::vector<LocalId> ends;
    for (const Quad& q : quads)
      for (std::size_t v = 0; v < 4; ++v)
        if (q[v] == node) ends.insert(ends.end(), {q[(v + 1) % 4], q[(v + 3) % 4]});
    std::sort(ends.begin(), ends.end());
    return static_cast<int>(std::unique(ends.begin(), ends.end()) - ends.begin());
  }

  // Replaces every hex with marked corners by its cut.
  bool cut() {
    std::vector<Hex> hexes;
    std::vector<std::uint8_t> half;
    made_.clear();
    std::vector<std::pair<LocalId, LocalId>> merges;
    for (std::size_t h = 0; h < hexes_.size(); ++h) {
      unsigned mask = 0;
      for (std::size_t c = 0; c < 8; ++c) mask |= static_cast<unsigned>(marked_[at(hexes_[h][c])]) << c;
      if (mask == 0) {
        hexes.push_back(hexes_[h]);
        half.push_back(half_[h]);
        continue;
      }
      const auto& rule = cuts()[mask];
      if (!rule) return false;
      for (const auto& group : rule->merged)
        for (const Site s : group) merges.emplace_back(node_at(hexes_[h], group[0]), node_at(hexes_[h], s));
      for (const NewHex& sites : rule->hexes) {
        Hex hex;
        for (std::size_t c = 0; c < 8; ++c) hex[c] = node_at(hexes_[h], sites[c]);
        hexes.push_back(hex);
        half.push_back(half_[h]);
      }
    }
    hexes_ = std::move(hexes);
    half_ = std::move(half);
    return merge(merges);
  }

  LocalId node_at(const Hex& hex, Site s) {
    if (std::has_single_bit(s)) return hex[static_cast<std::size_t>(std::countr_zero(s))];
    std::vector<LocalId> parents;
    for (std::size_t c = 0; c < 8; ++c)
      if (s >> c & 1) parents.push_back(hex[c]);
    std::sort(parents.begin(), parents.end());
    const auto [known, is_new] = made_.try_emplace(parents, static_cast<LocalId>(position_.size()));
    if (!is_new) return known->second;
    Vec3 sum;
    Planes common = 0x1ff;
    for (const LocalId n : parents) {
      sum += position_[at(n)];
      common &= planes_[at(n)];
    }
    position_.push_back((1.0 / static_cast<double>(parents.size())) * sum);
    planes_.push_back(common);
    marked_.push_back(0);
    return known->second;
  }

  // Merged nodes lie in the middle of their members. A node that others share, or on the side of the domain,
  // stays where it is, so no two of them can be merged.
  bool merge(const std::vector<std::pair<LocalId, LocalId>>& merges) {
    std::vector<LocalId> group(position_.size());
    for (std::size_t n = 0; n < group.size(); ++n) group[n] = static_cast<LocalId>(n);
    const auto root = [&group](LocalId n) {
      while (group[at(n)] != n) n = group[at(n)];
      return n;
    };
    for (const auto& [a, b] : merges) group[at(std::max(root(a), root(b)))] = std::min(root(a), root(b));
    std::map<LocalId, std::vector<LocalId>> members;
    for (std::size_t n = 0; n < group.size(); ++n)
      if (root(static_cast<LocalId>(n)) != static_cast<LocalId>(n) || group[n] != static_cast<LocalId>(n))
        members[root(static_cast<LocalId>(n))].push_back(static_cast<LocalId>(n));
    for (auto& [to, from] : members) {
      Vec3 sum;
      Planes on = 0;
      std::optional<Vec3> kept;
      from.push_back(to);
      for (const LocalId n : from) {
        sum += position_[at(n)];
        on |= planes_[at(n)];
        if (!(planes_[at(n)] & outer_)) continue;
        if (kept) return false;
        kept = position_[at(n)];
      }
      planes_[at(to)] = on;
      position_[at(to)] = kept ? *kept : (1.0 / static_cast<double>(from.size())) * sum;
    }
    for (Hex& hex : hexes_)
      for (LocalId& n : hex) n = root(n);
    return true;
  }

  // No two hexes share two faces, no hex has two faces on the side of the domain, and no
  // corner of a hex coincides with another.
  [[nodiscard]] bool no_doublets() {
    std::map<Quad, std::vector<std::size_t>> owners;
    for (std::size_t h = 0; h < hexes_.size(); ++h) {
      Hex sorted = hexes_[h];
      std::sort(sorted.begin(), sorted.end());
      if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return false;
      std::array<int, 9> on{};
      for (const auto& face : kFaces) {
        Quad quad;
        Planes common = 0x1ff;
        for (std::size_t v = 0; v < 4; ++v) {
          quad[v] = hexes_[h][static_cast<std::size_t>(face[v])];
          common &= planes_[at(quad[v])];
        }
        for (std::size_t bit = 0; bit < 9; ++bit)
          if (common >> bit & 1 && outer_ >> bit & 1 && ++on[bit] > 1) {
            if (bit % 3 == 1) return false;
            double_sides_ |= static_cast<std::uint8_t>(1U << (bit / 3 * 2 + (bit % 3) / 2));
          }
        std::sort(quad.begin(), quad.end());
        owners[quad].push_back(h);
      }
    }
    std::map<std::pair<std::size_t, std::size_t>, int> shared;
    for (const auto& [quad, of] : owners) {
      if (of.size() > 2) return false;
      if (of.size() == 2 && ++shared[{of[0], of[1]}] > 1) return false;
    }
    return true;
  }

  BlockPattern pattern_;
  std::uint8_t double_sides_ = 0;
  Planes outer_ = kSurface;  // planes that other blocks share or that bound the domain
  std::vector<Vec3> position_;
  std::vector<Planes> planes_;
  std::vector<std::uint8_t> marked_;
  std::vector<Hex> hexes_;
  std::vector<std::uint8_t> half_;                // per hex: the octant of the block
  std::map<std::vector<LocalId>, LocalId> made_;  // nodes of this pass, by their parents
};

void colour_interior(BlockTemplate& block) {
  const std::size_t nodes = block.node.size();
  std::vector<std::uint8_t> colour(nodes, kNoColour);
  for (std::size_t n = block.surface; n < nodes; ++n) {
    std::uint64_t taken = 0;
    for (const auto& hex : block.hex) {
      if (std::find(hex.begin(), hex.end(), n) == hex.end()) continue;
      for (const std::uint16_t other : hex)
        if (colour[other] != kNoColour) taken |= std::uint64_t{1} << (colour[other] - kFirstFreeColour);
    }
    colour[n] = static_cast<std::uint8_t>(kFirstFreeColour + std::countr_one(taken));
  }
  block.interior_colour.assign(colour.begin() + static_cast<std::ptrdiff_t>(block.surface), colour.end());
}

}  // namespace

std::unique_ptr<const BlockTemplate> block_template(BlockPattern pattern, unsigned ends) {
  BlockCutter cutter(pattern, ends);
  if (!cutter.run()) return nullptr;
  auto result = std::make_unique<BlockTemplate>();
  result->double_sides = cutter.double_sides();
  std::vector<Hex> hexes;
  for (std::size_t h = 0; h < cutter.hexes().size(); ++h)
    if ((cutter.halves()[h] & ends) == 0) hexes.push_back(cutter.hexes()[h]);
  std::vector<LocalId> used, index(cutter.positions().size(), kNone);
  for (const Hex& hex : hexes) used.insert(used.end(), hex.begin(), hex.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::stable_partition(used.begin(), used.end(), [&](LocalId n) { return cutter.on_surface(n); });
  for (const LocalId n : used) {
    const Vec3& p = cutter.positions()[at(n)];
    for (std::size_t d = 0; d < 3; ++d)  // the middle plane where the block ends is a side of the domain
      if (ends >> d & 1 && cutter.on_middle(n, d) != (p[d] == 1)) return nullptr;
    index[at(n)] = static_cast<LocalId>(result->node.size());
    result->node.push_back(p);
    result->surface += cutter.on_surface(n);
  }
  for (const Hex& hex : hexes) {
    auto& out = result->hex.emplace_back();
    for (std::size_t c = 0; c < 8; ++c) out[c] = static_cast<std::uint16_t>(index[at(hex[c])]);
  }
  relax_interior(*result, ends);
  if (pattern != 0) colour_interior(*result);
  return result;
}

}  // namespace sculpt
