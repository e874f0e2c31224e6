#pragma once
// The energy of one moving node: the sum over the corner tetrahedra that contain it of s^r, where s is the
// inverse of a regularised scaled Jacobian (docs/smoothing.md; after Garanzha et al., Foldover-free maps,
// 2021). Eight hexes are worked on side by side, in lanes whose results are combined in a fixed order. Pure.
#include <span>
#include <vector>

#include "sculpt/base/types.hpp"
#include "sculpt/base/vec3.hpp"
#include "sculpt/geom/hex.hpp"
#include "sculpt/geom/lanes.hpp"

namespace sculpt {

// A corner tetrahedron per lane, as a function of the displacement y of the moving node: determinant D = d0 +
// G.y (edges divided by their target lengths) and squared norm n = W y.y - 2 S.y + S2.
struct TetLanes {
  Lanes gx, gy, gz, d0, w, sx, sy, sz, s2;
  Lanes fixed;  // D / (scaled Jacobian * lengths of the moving edges)
};

struct StarBatch {
  Lanes neighbour[3][3];  // edge neighbours of the moving node: [which][axis], relative to it
  TetLanes tet[4];        // 0: apex at the moving node; 1..3: apex at neighbour[k-1]
  Lanes used;             // 1 in lanes that hold a hex, 0 in the padding
};

struct Derivatives {
  double energy = 0;
  Vec3 gradient;
  double hessian[6] = {0, 0, 0, 0, 0, 0};  // xx xy xz yy yz zz
  int not_positive = 0;                    // determinants <= 0
};

class Star {
 public:
  // Target lengths of the edges: their present lengths with a floor (shape only), or 1 (size as well).
  enum class Target { kPresent, kUnit };

  // items: 8 * hex + corner of the hexes around the node. Lengths are measured in units of 1/scale per axis.
  void gather(const std::vector<Hex>& hexes, const std::vector<Vec3>& position,
              std::span<const std::int32_t> items, LocalId node, const Vec3& scale, Target target);

  [[nodiscard]] int tets() const { return tets_; }
  [[nodiscard]] double shortest_edge() const { return shortest_edge_; }  // at the node, before moving

  // Energy, gradient and Hessian at y = 0. r: 1, 2, 4 or 8. eps: regularisation of the determinant.
  [[nodiscard]] Derivatives derivatives(int r, double eps) const;
  struct Value {
    double energy;
    int not_positive;  // determinants <= 0
  };
  [[nodiscard]] Value value(const Vec3& y, int r, double eps) const;
  struct Shape {
    double scaled_jacobian;  // smallest of the tetrahedra that contain the node
    double edge;             // shortest edge at the node
  };
  [[nodiscard]] Shape shape(const Vec3& y) const;

 private:
  std::vector<StarBatch> batches_;
  std::size_t used_ = 0;
  int tets_ = 0;
  double shortest_edge_ = 0;
};

}  // namespace sculpt
