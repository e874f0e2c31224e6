#pragma once
// One material per cell, such that every interface is manifold and, where asked for, free of features too
// small for good elements (the report, section 2.7). A node is manifold when, for every material at it, the
// cells of the material and the other cells each form one face-connected set; and where it is on the boundary
// of the domain, the cells of a material at each edge there, too.
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "sculpt/input/material_source.hpp"
#include "sculpt/mesh/adjacency.hpp"
#include "sculpt/mesh/hex_mesh.hpp"

namespace sculpt {

// Collective. mesh.material of every local cell = the material with the largest fraction; ties go to the one
// with more in the face neighbours, then to the smaller id.
void assign_materials(HexMesh& mesh, const Fractions& fractions, const FaceNeighbours& neighbours);

struct FilterOptions {
  // micro_shave: cells on the box without a face neighbour of their own material take this one (measured on
  // real Sculpt: always the smallest material id).
  std::optional<std::int32_t> shave_to;
  bool defeature = false;           // remove islands, protrusions and isthmuses
  std::int64_t min_vol_cells = 5;   // a connected piece with this many cells or fewer is an island
  bool collapse = false;            // remove contacts of two materials in a single face
  bool defeature_box = false;       // faces on the box count as faces towards other materials
  int defeature_rounds = 10;        // most rounds of defeaturing and manifold repair
  bool reversals = false;           // remove faces of one interface that are back to back at a node
  std::int64_t keep_materials = 0;  // number of materials, none of which may vanish; 0: they may
};

struct FilterReport {
  std::int64_t shaved = 0;  // cells
  std::int64_t islands = 0, island_cells = 0, protrusions = 0;
  std::int64_t collapses = 0;       // cells changed to remove contacts in a single face
  int rounds = 0;                   // of defeaturing
  bool settled = true;              // the last round changed nothing
  std::int64_t reversals = 0;       // nodes with a reversal before they were removed
  std::int64_t bad_nodes = 0;       // non-manifold nodes found at the start
  std::int64_t manifold_cells = 0;  // changes made for them (a cell may change more than once)
  std::int64_t forced_nodes = 0;    // nodes settled by the last resort, which merges materials
  int manifold_passes = 0;
};

// Collective. Reassigns cells until every node is manifold (needs two ghost layers); before that, in turn
// with it, what the options ask for. Always ends; every node is manifold then. said(line) takes a line per
// round of defeaturing.
FilterReport filter_materials(HexMesh& mesh, const Fractions& fractions, const FaceNeighbours& neighbours,
                              const NodeHexes& around, const FilterOptions& options = {},
                              const std::function<void(const std::string&)>& said = {});

// Local. Whether all nodes of the owned cells are manifold.
[[nodiscard]] bool interfaces_are_manifold(const HexMesh& mesh, const FaceNeighbours& neighbours,
                                           const NodeHexes& around);

}  // namespace sculpt
