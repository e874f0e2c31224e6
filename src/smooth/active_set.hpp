#pragma once
// What all smoothing phases share: quality of each hex, sets of nodes to move, and the sweep that moves them
// colour by colour with the exchange in between. Collective unless said otherwise.
#include <array>
#include <functional>
#include <vector>

#include "sculpt/mesh/adjacency.hpp"
#include "sculpt/mesh/hex_mesh.hpp"

namespace sculpt {

class ActiveSet {
 public:
  explicit ActiveSet(HexMesh& mesh);

  [[nodiscard]] HexMesh& mesh() const { return mesh_; }
  [[nodiscard]] const Comm& comm() const { return mesh_.node_exchange.comm(); }
  [[nodiscard]] const NodeHexes& around() const { return around_; }
  [[nodiscard]] bool owned(LocalId node) const {
    return mesh_.node_owner[static_cast<std::size_t>(node)] == comm().rank();
  }
  [[nodiscard]] const std::vector<float>& quality() const {
    return quality_;
  }  // scaled Jacobian per local hex

  // Chooses the owned nodes of hexes below `quality` and of `layers` layers of hexes around them. only_near:
  // of these the ones in a hex with a node that moved far in the last sweep. Returns their number on all
  // ranks.
  std::int64_t choose(double quality, int layers, bool only_near);

  // Chooses the owned nodes for which wanted(node) holds. Returns their number on all ranks.
  std::int64_t choose_if(const std::function<bool(LocalId)>& wanted);
  // The chosen nodes in ascending order.
  [[nodiscard]] std::vector<LocalId> chosen() const;

  // Moves the chosen nodes: step(node) changes the position of one owned node and tells whether it did. Nodes
  // of one colour are visited in ascending order before the ghosts learn of their moves. far: the length of a
  // move that the neighbours shall hear of (choose). Returns the moves on all ranks.
  std::int64_t sweep(const std::function<bool(LocalId)>& step, double far);

  struct Worst {
    std::int64_t not_positive = 0, below_02 = 0, below_target = 0;
    double quality = 1;
  };
  // Over the hexes of all ranks, each counted once.
  [[nodiscard]] Worst worst(double target) const;
  // Smallest corner determinant, in cells, of the hexes below 0.1; 1 when there are none. scale: 1 / cell
  // size, at level 0.
  [[nodiscard]] double least_determinant(const Vec3& scale) const;
  void refresh_all_quality();
  // After moves that were made outside sweep() and are known to the ghosts: nodes that moved, ghosts
  // included.
  void refresh_quality_around(const std::vector<LocalId>& moved);
  // Gives hexes whose Jacobian is not positive somewhere inside the quality 0 until a node of theirs moves.
  // Returns their number on all ranks.
  std::int64_t mark_folded();
  // Gives hexes with an edge shorter than this (at level 0) the quality 0, until a node of theirs moves or
  // refresh_all_quality(). Returns their number on all ranks.
  std::int64_t mark_short(double edge);

 private:
  // Marks the nodes of all hexes that have a node of `front` (all marked 1); front becomes the newly marked
  // ones.
  void spread(std::vector<std::uint8_t>& marks, std::vector<LocalId>& front);
  void fetch_ahead(LocalId hexes_of, LocalId positions_of) const;
  void exchange_moves(double far_squared, int colour);
  void refresh_dirty(LocalId first, LocalId last);

  HexMesh& mesh_;
  NodeHexes around_;
  std::vector<float> quality_;
  std::vector<std::uint8_t> marked_;          // per node
  std::vector<std::uint8_t> changed_;         // per node: to be told to the ghosts
  std::vector<std::uint8_t> near_;            // per node: see choose
  std::vector<std::uint8_t> far_moved_;       // per node: moved far in this sweep
  std::vector<std::vector<LocalId>> chosen_;  // per colour
  std::vector<LocalId> moved_;                // in this sweep, ghosts included
  std::vector<std::uint8_t> dirty_;           // per hex
};

}  // namespace sculpt
