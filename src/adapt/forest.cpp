#include "sculpt/adapt/forest.hpp"

#include <algorithm>
#include <bit>

#include "adapt/template_store.hpp"

namespace sculpt {
namespace {

constexpr std::int64_t half_up(std::int64_t n) { return (n + 1) / 2; }

Index3 sum(const Index3& a, const std::array<int, 3>& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

}  // namespace

Forest::Forest(const Index3& cells, int levels, const std::array<bool, 3>& periodic, const Index3& missing)
    : levels_(levels), periodic_(periodic) {
  for (std::size_t d = 0; d < 3; ++d) finest_[d] = (cells[d] << levels) - missing[d];
  std::size_t words = 0;
  for (int l = 0; l < levels; ++l) {
    const Index3 b = blocks(l);
    refined_.push_back({b, words});
    words += (static_cast<std::size_t>(b[0] * b[1] * b[2]) + 63) / 64;
  }
  words_.assign(words, 0);
  for (std::size_t d = 0; d < 3; ++d) refine_across_end(d);
}

// Whether cells of a level fit between the ends of an axis.
bool Forest::fits(int level, std::size_t axis) const {
  return finest_[axis] % (std::int64_t{1} << (levels_ - level)) == 0;
}

void Forest::refine_across_end(std::size_t axis) {
  for (int l = 0; l < levels_ && !fits(l, axis); ++l) {
    IndexBox layer = whole(blocks(l));
    layer.lo[axis] = layer.hi[axis] - 1;
    for (std::int64_t b = 0; b < layer.size(); ++b) refine_block(l, layer.cell(b));
  }
}

Index3 Forest::cells(int level) const {
  Index3 n;
  const std::int64_t size = std::int64_t{1} << (levels_ - level);
  for (std::size_t d = 0; d < 3; ++d) n[d] = (finest_[d] + size - 1) / size;
  return n;
}
Index3 Forest::blocks(int level) const {
  const Index3 n = cells(level);
  return {half_up(n[0]), half_up(n[1]), half_up(n[2])};
}

// Brings a block into the grid; false where there is none.
bool Forest::wrap(int level, Index3& block) const {
  const Index3 n = blocks(level), in_cells = cells(level);
  for (std::size_t d = 0; d < 3; ++d) {
    if (block[d] >= 0 && block[d] < n[d]) continue;
    if (periodic_[d])
      block[d] = (block[d] % n[d] + n[d]) % n[d];
    else if (in_cells[d] % 2 != 0 && block[d] == n[d] && fits(level, d))
      block[d] = n[d] - 2;  // the grid ends at the middle of block n-1: as if mirrored there
    if (block[d] < 0 || block[d] >= n[d]) return false;
  }
  return true;
}

bool Forest::refined(int level, const Index3& block) const {
  if (level >= levels()) return false;
  Index3 b = block;
  if (!wrap(level, b)) return false;
  const Level& l = refined_[static_cast<std::size_t>(level)];
  const std::size_t bit = number(l, b);
  return words_[l.first_word + bit / 64] >> (bit % 64) & 1;
}

void Forest::refine_cell(int level, const Index3& cell) {
  refine_block(level, {cell[0] / 2, cell[1] / 2, cell[2] / 2});
}
void Forest::refine_block(int level, const Index3& block) {
  const Level& l = refined_[static_cast<std::size_t>(level)];
  const std::size_t bit = number(l, block);
  words_[l.first_word + bit / 64] |= std::uint64_t{1} << (bit % 64);
}

std::vector<Index3> Forest::list(int level) const {
  const Level& l = refined_[static_cast<std::size_t>(level)];
  const std::int64_t nx = l.blocks[0], ny = l.blocks[1];
  const std::size_t end = l.first_word + (static_cast<std::size_t>(nx * ny * l.blocks[2]) + 63) / 64;
  std::vector<Index3> all;
  for (std::size_t w = l.first_word; w < end; ++w)
    for (std::uint64_t bits = words_[w]; bits != 0; bits &= bits - 1) {
      const auto i = static_cast<std::int64_t>(64 * (w - l.first_word)) + std::countr_zero(bits);
      all.push_back({i % nx, i / nx % ny, i / nx / ny});
    }
  return all;
}

bool Forest::add(int level, Index3 block, std::vector<Index3>& added) {
  if (!wrap(level, block) || refined(level, block)) return false;
  refine_block(level, block);
  added.push_back(block);
  return true;
}

// The cells in the place of the blocks, and those around them, must be of the level before.
void Forest::nest(int level, const std::vector<Index3>& blocks, std::vector<Index3>& added) {
  const Index3 n = cells(level - 1);
  for (const Index3& b : blocks)  // also a cell of level - 1
    for (int o = 0; o < 27; ++o) {
      Index3 cell = sum(b, {o % 3 - 1, o / 3 % 3 - 1, o / 9 - 1});
      bool inside = true;
      for (std::size_t d = 0; d < 3; ++d) {
        if (periodic_[d]) cell[d] = (cell[d] + n[d]) % n[d];
        inside = inside && cell[d] >= 0 && cell[d] < n[d];
      }
      if (inside) add(level - 1, {cell[0] / 2, cell[1] / 2, cell[2] / 2}, added);
    }
}

// Refines leaves that have no valid transition, as long as there are any beside the changed blocks.
void Forest::repair(int level, std::vector<Index3> changed, std::vector<Index3>& added) {
  while (!changed.empty()) {
    std::vector<Index3> beside;
    for (const Index3& b : changed)
      for (const auto& offset : kBlockOffset) {
        Index3 other = sum(b, offset);
        if (wrap(level, other) && !refined(level, other)) beside.push_back(other);
      }
    std::sort(beside.begin(), beside.end());
    beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
    std::erase_if(beside, [&](const Index3& b) { return has_transition(level, b); });
    changed.clear();
    for (const Index3& b : beside) add(level, b, changed);
    added.insert(added.end(), changed.begin(), changed.end());
  }
}

// Whether a leaf can be cut as its neighbours ask, and the blocks beside it as well.
bool Forest::has_transition(int level, const Index3& block) const {
  const std::uint32_t p = pattern(level, block);
  if (!transition_exists(p, ends(level, block))) return false;
  const std::uint8_t doubles = transition(p, ends(level, block)).double_sides;
  for (std::size_t side = 0; doubles != 0 && side < 6; ++side) {
    if (!(doubles >> side & 1)) continue;
    Index3 other = sum(block, kBlockOffset[side]);
    if (!wrap(level, other)) return false;  // a side of the domain
    if (refined(level, other)) continue;
    const std::uint32_t beyond = pattern(level, other);
    if (transition_exists(beyond, ends(level, other)) &&
        transition(beyond, ends(level, other)).double_sides >> (side ^ 1) & 1)
      return false;
  }
  return true;
}

std::int64_t Forest::close() {
  std::int64_t count = 0;
  std::vector<std::vector<Index3>> changed;  // per level: blocks whose neighbourhood was not looked at yet
  for (int l = 0; l < levels(); ++l) changed.push_back(list(l));
  for (bool again = true; again;) {
    again = false;
    for (int l = levels() - 1; l >= 0; --l) {
      std::vector<Index3> now = std::move(changed[static_cast<std::size_t>(l)]), more;
      changed[static_cast<std::size_t>(l)].clear();
      if (now.empty()) continue;
      repair(l, now, more);
      count += static_cast<std::int64_t>(more.size());
      if (l == 0) continue;
      now.insert(now.end(), more.begin(), more.end());
      auto& coarser = changed[static_cast<std::size_t>(l - 1)];
      const std::size_t before = coarser.size();
      nest(l, now, coarser);
      count += static_cast<std::int64_t>(coarser.size() - before);
    }
    for (const auto& list_of : changed) again = again || !list_of.empty();
  }
  return count;
}

std::uint32_t Forest::pattern(int level, const Index3& block) const {
  std::uint32_t bits = 0;
  for (std::size_t b = 0; b < kBlockNeighbours; ++b) {
    bool hidden = false;  // an edge of a refined face is marked by that already
    for (std::size_t d = 0; b >= 6 && d < 3; ++d)
      hidden =
          hidden || (kBlockOffset[b][d] != 0 && (bits >> (2 * d + (kBlockOffset[b][d] > 0 ? 1 : 0)) & 1));
    if (!hidden && refined(level, sum(block, kBlockOffset[b]))) bits |= 1U << b;
  }
  return bits;
}

unsigned Forest::ends(int level, const Index3& block) const {
  const Index3 n = cells(level);
  unsigned bits = 0;
  for (std::size_t d = 0; d < 3; ++d)
    if (n[d] % 2 != 0 && block[d] == n[d] / 2 && fits(level, d)) bits |= 1U << d;
  return bits;
}

void Forest::for_each_leaf(const Index3& base_block,
                           const std::function<void(int, const Index3&)>& visit) const {
  visit_leaves(0, base_block, visit);
}

void Forest::visit_leaves(int level, const Index3& block,
                          const std::function<void(int, const Index3&)>& visit) const {
  if (!refined(level, block)) return visit(level, block);
  const Index3 n = cells(level);
  for (unsigned octant = 0; octant < 8; ++octant) {
    const Index3 cell{2 * block[0] + (octant & 1), 2 * block[1] + (octant >> 1 & 1),
                      2 * block[2] + (octant >> 2)};
    if (cell[0] < n[0] && cell[1] < n[1] && cell[2] < n[2]) visit_leaves(level + 1, cell, visit);
  }
}

}  // namespace sculpt
