#pragma once
// What all operations of the filter share: the materials of the cells, the price of changing one, and the
// record of what was changed. Local unless said otherwise.
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sculpt/base/lot.hpp"
#include "sculpt/filter/filter.hpp"
#include "sculpt/mesh/adjacency.hpp"
#include "sculpt/mesh/edge_walk.hpp"
#include "sculpt/mesh/hex_mesh.hpp"

namespace sculpt {

class Edits {
 public:
  static constexpr int kFreezeAfter =
      4;  // changes of one cell; then the manifold repair leaves it but as a last resort

  Edits(HexMesh& of, const Fractions& their_fractions, const FaceNeighbours& their_neighbours,
        const NodeHexes& around_nodes)
      : mesh(of),
        fractions(their_fractions),
        neighbours(their_neighbours),
        around(around_nodes),
        changes_(of.hexes.size(), 0),
        unshared_(of.hexes.size(), 0) {}

  HexMesh& mesh;
  const Fractions& fractions;
  const FaceNeighbours& neighbours;
  const NodeHexes& around;

  [[nodiscard]] const Comm& comm() const { return mesh.hex_exchange.comm(); }
  [[nodiscard]] std::int32_t material(LocalId cell) const { return mesh.material[at(cell)]; }
  [[nodiscard]] bool owned(LocalId cell) const { return mesh.layer[at(cell)] == 0; }
  [[nodiscard]] bool frozen(LocalId cell) const { return changes_[at(cell)] >= kFreezeAfter; }
  [[nodiscard]] bool locked(LocalId cell) const { return !locked_.empty() && locked_[at(cell)] != 0; }

  // Loss of fraction when a cell goes to a material, and a price for having changed before that grows as 2^n
  // - 1 (the report, section 2.7.1: changes must stick).
  [[nodiscard]] double loss(LocalId cell, std::int32_t to) const;
  // Ties between cells are broken by this, then by id.
  [[nodiscard]] std::uint64_t lot(LocalId cell) const { return lot_of(mesh.hex_homes()[at(cell)]); }

  // Price of taking a cell from a rare material: 1 / its cells in the input of the filter (0 for one that had
  // none).
  [[nodiscard]] double rarity(std::int32_t material) const {
    const auto m = at(material);
    return m < cells_of_.size() && cells_of_[m] > 0 ? 1 / static_cast<double>(cells_of_[m]) : 0;
  }
  // Collective. Counts the cells of the materials for rarity().
  void count_materials();

  // Every rank that sees the cell makes the same change.
  void change(LocalId cell, std::int32_t to);
  // By the owner alone; the others learn of it from share().
  void change_owned(LocalId cell, std::int32_t to);
  void share();  // collective

  // Cells in the order of their changes, ghosts included; a cell may occur several times.
  [[nodiscard]] const std::vector<LocalId>& changed() const { return changed_; }

  // Collective. Locks one cell of every material, such that none can vanish: the cell in the largest
  // connected piece of the material with most of it around. Materials that have no cell get the one with most
  // of them.
  void lock_materials(std::int64_t materials);

 private:
  std::vector<std::uint8_t> changes_;   // per cell
  std::vector<std::uint8_t> unshared_;  // per cell: changed by its owner since the last share()
  std::vector<std::uint8_t> locked_;    // per cell; empty: none
  std::vector<std::int64_t> cells_of_;  // per material, all ranks, when counted
  std::vector<LocalId> changed_, pending_;
};

// Face-connected pieces of equal material. Collective.
struct Pieces {
  std::vector<std::int32_t> of;      // per local cell: index into the next ones
  std::vector<GlobalId> label;       // smallest cell id of the piece
  std::vector<std::int64_t> size;    // cells on all ranks, right up to `most`, more is not told apart
  std::vector<std::uint8_t> shared;  // 1: other ranks may hold a part of it
};
[[nodiscard]] Pieces pieces(const Edits& edits, std::int64_t most);

struct IslandReport {
  std::int64_t islands = 0, cells = 0;  // removed, all ranks
};
// Collective. Every piece of at most `most` cells takes the material of the larger piece that it has most
// faces in common with.
IslandReport remove_islands(Edits& edits, std::int64_t most);

// Makes every node manifold. Looks at all nodes first and from then on at those around changed cells only.
class ManifoldRepair {
 public:
  explicit ManifoldRepair(Edits& edits);
  ~ManifoldRepair();
  ManifoldRepair(const ManifoldRepair&) = delete;
  ManifoldRepair& operator=(const ManifoldRepair&) = delete;
  // Collective. Returns the number of changes on all ranks. Always ends: after a fixed number of passes what
  // is left is settled by a rule that only ever lowers material indices.
  std::int64_t run(FilterReport& report);
  // Collective. Removes reversals (the report, section 2.7.3) as far as that leaves all nodes manifold: two
  // faces of one interface that meet at a node and look in opposite directions. Returns the number of
  // changes.
  std::int64_t remove_reversals(FilterReport& report);

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

// An operation that changes single cells for reasons found within a few cells around, until there are no
// candidates. Candidates claim the cells around them; the cheapest go first.
class CellChanges {
 public:
  virtual ~CellChanges() = default;
  CellChanges(const CellChanges&) = delete;
  CellChanges& operator=(const CellChanges&) = delete;
  // Collective. Looks at all cells first, later at those around changes only. Returns the number of changes
  // on all ranks.
  std::int64_t run();

 protected:
  // reach: what is decided about a cell depends on cells this far away (1: sharing a node), at most 2.
  CellChanges(Edits& edits, int reach) : edits_(edits), reach_(reach) {}
  // Local. The material that an owned cell should go to, kNone for a cell that stays. Every change must bring
  // the end nearer.
  [[nodiscard]] virtual std::int32_t better(LocalId cell) const = 0;

  Edits& edits_;

 private:
  void collect();
  std::int64_t pass();
  [[nodiscard]] bool wins(LocalId cell);
  const std::vector<LocalId>& around(LocalId cell);

  int reach_;
  bool first_ = true;
  std::size_t seen_ = 0;            // changes of the cells looked at so far
  std::vector<LocalId> examine_;    // owned cells to look at
  std::vector<double> claim_;       // per cell: price of its candidate change in this pass
  std::vector<std::uint8_t> flag_;  // per cell, scratch
  std::vector<LocalId> claimed_ghosts_, around_;
};

// Protrusions and isthmuses: cells with at least four faces towards other materials.
class Protrusions : public CellChanges {
 public:
  // at_box: faces on the box count as faces towards other materials.
  Protrusions(Edits& edits, bool at_box) : CellChanges(edits, 1), at_box_(at_box) {}

 private:
  [[nodiscard]] std::int32_t better(LocalId cell) const override;
  bool at_box_;
};

// Collapses small surfaces: contacts of two materials in a single face.
class Collapses : public CellChanges {
 public:
  explicit Collapses(Edits& edits) : CellChanges(edits, 2) {}

 private:
  [[nodiscard]] std::int32_t better(LocalId cell) const override;
  [[nodiscard]] bool goes_on(HexFace face, LocalId a, LocalId b) const;
  [[nodiscard]] bool alone(HexFace face) const;
  [[nodiscard]] int alone_beyond(HexFace face, LocalId a, LocalId b, bool& closed) const;
  [[nodiscard]] int alone_around(LocalId cell) const;
  [[nodiscard]] bool manifold_around(LocalId cell) const;
  [[nodiscard]] std::vector<LocalId> instances_within_reach(LocalId cell) const;
};

}  // namespace sculpt
