#pragma once
// The material ids that occur in a voxel file, and their dense indices. Ids are 0 .. 2^31-1.
#include <cstdint>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace sculpt {

// A set of ids that swallows hundreds of millions of them quickly: runs of equal ids cost a comparison.
class IdSet {
 public:
  void insert(std::span<const std::int32_t> ids);
  [[nodiscard]] std::vector<std::int32_t> sorted() const;

 private:
  static constexpr std::int32_t kSmall = std::int32_t{1} << 20;
  std::vector<char> small_ = std::vector<char>(static_cast<std::size_t>(kSmall), 0);  // ids below kSmall
  std::unordered_set<std::int32_t> large_;
};

// Replaces each id by its position in `known`, which ascends and holds them all.
void make_dense(std::span<const std::int64_t> known, std::span<std::int32_t> ids);

}  // namespace sculpt
