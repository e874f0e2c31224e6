#include "sculpt/distribute/block_parts.hpp"

#include <cmath>

namespace sculpt {
namespace {

void set_owners(BlockParts& parts) {
  parts.owner.assign(static_cast<std::size_t>(whole(parts.blocks).size()), 0);
  for (std::size_t r = 0; r < parts.box.size(); ++r)
    for (std::int64_t b = 0; b < parts.box[r].size(); ++b)
      parts.owner[static_cast<std::size_t>(whole(parts.blocks).position(parts.box[r].cell(b)))] =
          static_cast<std::int32_t>(r);
}

class Bisection {
 public:
  Bisection(const Index3& blocks, std::span<const std::int64_t> weight, std::vector<IndexBox>& box)
      : all_(whole(blocks)), weight_(weight), box_(box) {}

  // Cuts a box for the ranks [first, last).
  void cut(const IndexBox& box, std::size_t first, std::size_t last) {
    std::size_t axis = 0;
    for (std::size_t d = 1; d < 3; ++d)
      if (box.extent(d) > box.extent(axis)) axis = d;
    if (last - first == 1 || box.extent(axis) < 2) {
      box_[first] = box;
      return;
    }
    const std::size_t middle = first + (last - first) / 2;
    const std::vector<std::int64_t> layer = layers(box, axis);
    std::int64_t total = 0;
    for (const std::int64_t w : layer) total += w;
    // The first layer at which the part before it is nearest to its share.
    const double wanted =
        static_cast<double>(total) * static_cast<double>(middle - first) / static_cast<double>(last - first);
    std::int64_t before = layer[0], best = 1;
    double off = std::abs(static_cast<double>(before) - wanted);
    for (std::int64_t at = 2; at < box.extent(axis); ++at) {
      before += layer[static_cast<std::size_t>(at - 1)];
      if (std::abs(static_cast<double>(before) - wanted) >= off) continue;
      off = std::abs(static_cast<double>(before) - wanted);
      best = at;
    }
    IndexBox low = box, high = box;
    low.hi[axis] = high.lo[axis] = box.lo[axis] + best;
    cut(low, first, middle);
    cut(high, middle, last);
  }

 private:
  [[nodiscard]] std::vector<std::int64_t> layers(const IndexBox& box, std::size_t axis) const {
    std::vector<std::int64_t> sum(static_cast<std::size_t>(box.extent(axis)), 0);
    for (std::int64_t b = 0; b < box.size(); ++b) {
      const Index3 block = box.cell(b);
      sum[static_cast<std::size_t>(block[axis] - box.lo[axis])] +=
          weight_[static_cast<std::size_t>(all_.position(block))];
    }
    return sum;
  }

  IndexBox all_;
  std::span<const std::int64_t> weight_;
  std::vector<IndexBox>& box_;
};

}  // namespace

BlockParts block_parts(const CartesianParts& parts, int ranks) {
  BlockParts out{parts.cells, {}, {}};
  for (int r = 0; r < ranks; ++r) out.box.push_back(parts.owned(r));
  set_owners(out);
  return out;
}

BlockParts balanced_parts(const Index3& blocks, std::span<const std::int64_t> weight, int ranks) {
  BlockParts out{blocks, std::vector<IndexBox>(static_cast<std::size_t>(ranks)), {}};
  Bisection(blocks, weight, out.box).cut(whole(blocks), 0, static_cast<std::size_t>(ranks));
  set_owners(out);
  return out;
}

}  // namespace sculpt
