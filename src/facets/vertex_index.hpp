#pragma once
// Finds vertices by their coordinates: a hash table with open addresses over the list of vertices.
#include <bit>
#include <vector>

#include "sculpt/base/lot.hpp"
#include "sculpt/base/types.hpp"
#include "sculpt/base/vec3.hpp"

namespace sculpt {

class VertexIndex {
 public:
  explicit VertexIndex(std::vector<Vec3>& vertices) : vertices_(vertices), slot_(kFirstSlots, kNone) {}

  // The vertex with these coordinates, which are finite; it is added if there is none. -0 is 0.
  LocalId find_or_add(const Vec3& coordinates) {
    const Vec3 p{coordinates.x + 0.0, coordinates.y + 0.0, coordinates.z + 0.0};
    std::size_t s = hash(p) & (slot_.size() - 1);
    for (; slot_[s] != kNone; s = (s + 1) & (slot_.size() - 1))
      if (vertices_[at(slot_[s])] == p) return slot_[s];
    slot_[s] = static_cast<LocalId>(vertices_.size());
    vertices_.push_back(p);
    if (2 * vertices_.size() > slot_.size()) grow();
    return static_cast<LocalId>(vertices_.size()) - 1;
  }

 private:
  static constexpr std::size_t kFirstSlots = 1024;

  static std::uint64_t hash(const Vec3& p) {
    std::uint64_t h = 0;
    for (std::size_t d = 0; d < 3; ++d)
      h = lot_of(static_cast<std::int64_t>(h ^ std::bit_cast<std::uint64_t>(p[d])));
    return h;
  }
  void grow() {
    slot_.assign(2 * slot_.size(), kNone);
    for (std::size_t v = 0; v < vertices_.size(); ++v) {
      std::size_t s = hash(vertices_[v]) & (slot_.size() - 1);
      while (slot_[s] != kNone) s = (s + 1) & (slot_.size() - 1);
      slot_[s] = static_cast<LocalId>(v);
    }
  }

  std::vector<Vec3>& vertices_;
  std::vector<LocalId> slot_;
};

}  // namespace sculpt
