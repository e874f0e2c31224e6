#include "input/material_ids.hpp"

#include <algorithm>

namespace sculpt {

void IdSet::insert(std::span<const std::int32_t> ids) {
  std::int32_t previous = -1;
  for (const std::int32_t id : ids) {
    if (id == previous) continue;
    previous = id;
    if (id < kSmall)
      small_[static_cast<std::size_t>(id)] = 1;
    else
      large_.insert(id);
  }
}

std::vector<std::int32_t> IdSet::sorted() const {
  std::vector<std::int32_t> ids;
  for (std::int32_t id = 0; id < kSmall; ++id)
    if (small_[static_cast<std::size_t>(id)] != 0) ids.push_back(id);
  const auto small_count = static_cast<std::ptrdiff_t>(ids.size());
  ids.insert(ids.end(), large_.begin(), large_.end());
  std::sort(ids.begin() + small_count, ids.end());
  return ids;
}

void make_dense(std::span<const std::int64_t> known, std::span<std::int32_t> ids) {
  constexpr std::int64_t kTableLimit = std::int64_t{1} << 22;  // 16 MB
  if (known.empty()) return;
  if (known.back() < kTableLimit) {
    std::vector<std::int32_t> dense(static_cast<std::size_t>(known.back() + 1), -1);
    for (std::size_t m = 0; m < known.size(); ++m)
      dense[static_cast<std::size_t>(known[m])] = static_cast<std::int32_t>(m);
    for (std::int32_t& id : ids) id = dense[static_cast<std::size_t>(id)];
    return;
  }
  std::unordered_map<std::int32_t, std::int32_t> dense;
  for (std::size_t m = 0; m < known.size(); ++m)
    dense.emplace(static_cast<std::int32_t>(known[m]), static_cast<std::int32_t>(m));
  for (std::int32_t& id : ids) id = dense.find(id)->second;
}

}  // namespace sculpt
