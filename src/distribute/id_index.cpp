#include "distribute/id_index.hpp"

#include <algorithm>
#include <bit>

namespace sculpt {

IdIndex::IdIndex(std::span<const std::array<GlobalId, 8>> corners) {
  if (corners.empty()) return;
  GlobalId lo = corners[0][0], hi = lo;
  for (const auto& hex : corners)
    for (const GlobalId id : hex) {
      lo = std::min(lo, id);
      hi = std::max(hi, id);
    }
  const auto words = static_cast<std::size_t>((hi - lo) / 64 + 1);
  if (words <= 8 * corners.size()) {
    start_ = lo;
    bits_.assign(words, 0);
    for (const auto& hex : corners)
      for (const GlobalId id : hex)
        bits_[static_cast<std::size_t>((id - lo) / 64)] |= std::uint64_t{1} << ((id - lo) % 64);
    before_.resize(words);
    LocalId count = 0;
    for (std::size_t w = 0; w < words; ++w) {
      before_[w] = count;
      count += std::popcount(bits_[w]);
    }
    ids_.reserve(at(count));
    for (std::size_t w = 0; w < words; ++w)
      for (std::uint64_t left = bits_[w]; left != 0; left &= left - 1)
        ids_.push_back(lo + static_cast<GlobalId>(64 * w) + std::countr_zero(left));
  } else {
    ids_.reserve(8 * corners.size());
    for (const auto& hex : corners) ids_.insert(ids_.end(), hex.begin(), hex.end());
    std::sort(ids_.begin(), ids_.end());
    ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
  }
}

LocalId IdIndex::index(GlobalId id) const {
  if (bits_.empty()) {
    const auto found = std::lower_bound(ids_.begin(), ids_.end(), id);
    return found != ids_.end() && *found == id ? static_cast<LocalId>(found - ids_.begin()) : kNone;
  }
  if (id < start_) return kNone;
  const auto word = static_cast<std::size_t>((id - start_) / 64);
  if (word >= bits_.size()) return kNone;
  const std::uint64_t bit = std::uint64_t{1} << ((id - start_) % 64);
  if ((bits_[word] & bit) == 0) return kNone;
  return before_[word] + std::popcount(bits_[word] & (bit - 1));
}

}  // namespace sculpt
