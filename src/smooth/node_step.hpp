#pragma once
// One step of one node: a guarded Newton step on the energy of its star, or a climb of its worst corner.
// Local; the caller sees to it that no neighbour moves at the same time.
#include "sculpt/smooth/smooth.hpp"
#include "smooth/star.hpp"

namespace sculpt {

// What a Newton step minimises and must respect.
struct StepRules {
  int power = 1;      // r of the energy sum s^r
  double eps = 1e-9;  // regularisation of determinants
  Star::Target target_lengths = Star::Target::kPresent;
  double penalty = 1;          // weight of deviations of interface nodes, per tetrahedron
  bool guarded = true;         // the mesh is valid: neither quality nor edges may suffer
  double least_quality = 0.3;  // guarded: the worst corner may fall, but not below this
  double least_edge = 0.1;     // guarded: likewise for the shortest edge, in cells
  double least_move = 1e-3;    // shorter steps are not made, in cells
  double release_curves_below =
      -1;  // curve nodes with a worse corner deviate at a tenth of the price; negative: tenfold
  double farthest =
      std::numeric_limits<double>::infinity();  // of interface nodes from the geometry: see limit()
};

class NodeStep {
 public:
  // limits_by_level: limits of deviation are those at level 0.
  NodeStep(HexMesh& mesh, const NodeHexes& around, const Geometry& geometry, bool limits_by_level)
      : mesh_(mesh), around_(around), geometry_(geometry), limits_by_level_(limits_by_level) {}

  // Coordinates are multiplied by this before lengths are compared: 1 / cell size, at level 0.
  void set_scale(const Vec3& scale) { scale_ = scale; }
  // All return whether the node was moved.
  bool newton(LocalId node, const StepRules& rules);
  bool climb(LocalId node, const StepRules& rules);
  // An interface node goes towards its point of the geometry as far as quality and edges allow.
  bool fit(LocalId node, const StepRules& rules);
  // An interface node farther than the limit from the geometry is pulled back to that distance.
  bool pull_back(LocalId node, double farthest);

  // A limit of deviation at a node, a length.
  [[nodiscard]] double limit(LocalId node, double farthest) const {
    return limits_by_level_ ? farthest * mesh_.unit(node) : farthest;
  }

  // From an owned interface node to its point of the geometry, along its box sides.
  [[nodiscard]] Vec3 towards_geometry(LocalId node, const Vec3& from) const;

 private:
  // A step (in units of 1/scale) that ends on the exterior, where the node is on one.
  [[nodiscard]] Vec3 landed(LocalId node, const Freedom& free, const Vec3& step, const Vec3& scale) const;
  [[nodiscard]] bool too_far(LocalId node, const Vec3& step, double farthest) const;
  [[nodiscard]] double price(LocalId node, const StepRules& rules) const;
  [[nodiscard]] Vec3 deviation(LocalId entry, LocalId node) const;
  // What turns lengths at a node into cells.
  [[nodiscard]] Vec3 scale_at(LocalId node) const { return (1 / mesh_.unit(node)) * scale_; }

  HexMesh& mesh_;
  const NodeHexes& around_;
  const Geometry& geometry_;
  bool limits_by_level_;
  Vec3 scale_{1, 1, 1};
  Star star_;
};

}  // namespace sculpt
