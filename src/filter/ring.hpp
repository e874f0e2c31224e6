#pragma once
// The cells around one node as a small graph: bit masks of cells, connected through shared faces. Pure.
#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "sculpt/mesh/adjacency.hpp"

namespace sculpt {

struct Ring {
  static constexpr int kMost = 64;
  int size = 0;
  std::array<LocalId, kMost> cell;
  std::array<std::uint64_t, kMost> touching;  // cells sharing a face at the node with this one
  // Around the node's edges on the boundary of the domain: their cells, where there are three or more. Boxes
  // have no such edges, and meshes with an exterior have them where it bends inwards, for one.
  int edges = 0;
  std::array<std::uint64_t, kMost> at_edge;

  [[nodiscard]] std::uint64_t all() const {
    return size == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << size) - 1;
  }

  // Whether the set is empty or one face-connected piece.
  [[nodiscard]] bool connected(std::uint64_t set) const {
    std::uint64_t reached = set & (~set + 1), front = reached;
    while (front != 0) {
      std::uint64_t next = 0;
      for (std::uint64_t f = front; f != 0; f &= f - 1)
        next |= touching[static_cast<std::size_t>(std::countr_zero(f))];
      front = next & set & ~reached;
      reached |= front;
    }
    return reached == set;
  }

  // Whether every material's cells and their complement are connected, and its cells at every edge of the
  // boundary: what touches the boundary in an edge only, between cells of one material, leaves no room for
  // layers there. material: of each cell of the ring.
  [[nodiscard]] bool manifold(std::span<const std::int32_t> material) const {
    std::uint64_t left = all();
    while (left != 0) {
      const auto first = static_cast<std::size_t>(std::countr_zero(left));
      std::uint64_t same = 0;
      for (std::uint64_t f = left; f != 0; f &= f - 1) {
        const auto c = static_cast<std::size_t>(std::countr_zero(f));
        if (material[c] == material[first]) same |= std::uint64_t{1} << c;
      }
      left &= ~same;
      if (!connected(same) || !connected(all() & ~same)) return false;
      for (int e = 0; e < edges; ++e)
        if (!connected(same & at_edge[static_cast<std::size_t>(e)])) return false;
    }
    return true;
  }
};

// The ring of a node of an inner cell, cells ascending. Throws Error for a node with more than Ring::kMost
// cells.
[[nodiscard]] Ring ring_of(const HexMesh& mesh, const FaceNeighbours& neighbours, const NodeHexes& around,
                           LocalId node);

}  // namespace sculpt
