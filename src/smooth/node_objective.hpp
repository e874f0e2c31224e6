#pragma once
// What the report's optimisation makes of one moving node: the smallest scaled Jacobian of the corners that
// the node has a part in, or, while any of them is not positive, the negative volume there (equations 2.9 to
// 2.13). Local.
#include <span>
#include <vector>

#include "sculpt/mesh/hex_mesh.hpp"

namespace sculpt {

class NodeObjective {
 public:
  // items: 8 * hex + corner of the hexes around the node. Lengths are in units of 1/scale, which is also the
  // target mesh size. size_aware: corners count by their shortest edge as well.
  void gather(const HexMesh& mesh, std::span<const std::int32_t> items, LocalId node, double scale,
              bool size_aware);

  struct Value {
    double jacobian;         // smallest over the corners
    double negative_volume;  // smallest over the hexes of the sum of negative corner volumes; at most 0
    int negative;            // corners that are not positive
    [[nodiscard]] bool valid() const { return negative == 0; }
    // One number to compare places by: any valid place is better than any other.
    [[nodiscard]] double quality() const { return valid() ? jacobian : negative_volume; }
  };
  // With the node displaced by y.
  [[nodiscard]] Value at_displacement(const Vec3& y) const;
  [[nodiscard]] double mean_edge() const { return mean_edge_; }

 private:
  struct Part {
    HexCorners corners;  // relative to the node
    int moving;
  };
  std::vector<Part> parts_;
  double mean_edge_ = 0;
  bool size_aware_ = false;
};

}  // namespace sculpt
