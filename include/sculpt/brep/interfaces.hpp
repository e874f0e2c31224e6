#pragma once
// The material interfaces of the overlay mesh as a surface mesh, and the class of every interface node (the
// report, section 2.8). Local, built from the local cells; complete at all nodes of owned cells and of the
// first ghost layer.
#include <array>
#include <span>
#include <vector>

#include "sculpt/mesh/adjacency.hpp"
#include "sculpt/mesh/hex_mesh.hpp"

namespace sculpt {

// A cell face between two materials. Nodes circulate so that the normal points from cell[0] to cell[1];
// cell[0] has the smaller global id.
struct InterfaceQuad {
  std::array<LocalId, 4> node;  // mesh nodes
  std::array<LocalId, 2> cell;
  int face;  // of cell[0], kFaces index
};

enum class NodeClass : std::uint8_t { kSurface, kCurve, kVertex };

// Items per entry in one array.
class Table {
 public:
  [[nodiscard]] std::span<const LocalId> operator[](std::size_t entry) const {
    return {items_.data() + offset_[entry], items_.data() + offset_[entry + 1]};
  }
  void reserve(std::size_t entries, std::size_t items) {
    offset_.reserve(entries + 1);
    items_.reserve(items);
  }
  void add(LocalId item) { items_.push_back(item); }
  void end_entry() { offset_.push_back(static_cast<std::int64_t>(items_.size())); }

 private:
  std::vector<std::int64_t> offset_{0};
  std::vector<LocalId> items_;
};

struct Interfaces {
  std::vector<InterfaceQuad> quads;  // ascending in (cell[0], face)
  std::vector<std::int32_t> part;    // per quad: the part of its surface that it is on; empty: all are on one
  std::vector<LocalId> nodes;        // mesh nodes on interfaces, ascending; "interface node" = index here
  std::vector<LocalId> index_of;     // per mesh node: its interface node or kNone
  std::vector<NodeClass> kind;       // per interface node
  Table node_quads;                  // per interface node: 4 * quad + corner, ascending
  Table neighbours;        // per interface node: interface nodes joined to it by a quad edge, ascending
  Table curve_neighbours;  // those of them joined by an edge that bounds or joins surfaces or their parts

  // The two materials a quad separates, smaller dense index first.
  [[nodiscard]] static std::array<std::int32_t, 2> materials(const HexMesh& mesh, const InterfaceQuad& q) {
    const auto a = mesh.material[static_cast<std::size_t>(q.cell[0])],
               b = mesh.material[static_cast<std::size_t>(q.cell[1])];
    return a < b ? std::array{a, b} : std::array{b, a};
  }
};

[[nodiscard]] Interfaces trace_interfaces(const HexMesh& mesh, const FaceNeighbours& neighbours);

// Local. Divides the surfaces: edges between quads of different parts become curves. part: per quad, right
// for all quads that have a cell in the first ghost layer or better.
void divide_surfaces(const HexMesh& mesh, Interfaces& faces, std::vector<std::int32_t> part);

}  // namespace sculpt
