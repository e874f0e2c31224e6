#include "adapt/template_shape.hpp"

#include <algorithm>

#include "sculpt/geom/hex.hpp"

namespace sculpt {
namespace {

constexpr int kPasses = 8;
constexpr double kGood = 0.45,
                 kFair = 0.35;  // worst corners (scaled Jacobian) that are left alone, or nearly
constexpr double kPerEdge =
    3;  // an edge of this times its length, in cells, counts as a corner of that value
constexpr double kFirstStep = 0.15, kShorter = 0.7;  // steps along the axes, in cells, and from pass to pass

class Relaxation {
 public:
  Relaxation(BlockTemplate& block, unsigned ends)
      : block_(block), ends_(ends), corners_(block.node.size()), neighbours_(block.node.size()) {
    for (std::size_t h = 0; h < block.hex.size(); ++h)
      for (std::size_t c = 0; c < 8; ++c) {
        const std::uint16_t n = block.hex[h][c];
        corners_[n].push_back({h, c});
        for (const int k : kCornerNeighbours[c]) {
          const std::uint16_t other = block.hex[h][static_cast<std::size_t>(k)];
          auto& list = neighbours_[n];
          if (std::find(list.begin(), list.end(), other) == list.end()) list.push_back(other);
        }
      }
  }

  void run() {
    double step = kFirstStep;
    for (int pass = 0; pass < kPasses; ++pass, step *= kShorter)
      for (std::size_t n = block_.surface; n < block_.node.size(); ++n) improve(n, step);
  }

 private:
  void improve(std::size_t n, double step) {
    double worst = worst_at(n);
    if (worst >= kGood) return;
    Vec3 middle;
    for (const std::uint16_t other : neighbours_[n]) middle += block_.node[other];
    try_move(n, (1.0 / static_cast<double>(neighbours_[n].size())) * middle - block_.node[n], worst);
    if (worst >= kFair) return;
    for (std::size_t d = 0; d < 3; ++d)
      for (const double way : {-step, step}) {
        Vec3 move;
        move[d] = way;
        try_move(n, move, worst);
      }
  }
  void try_move(std::size_t n, Vec3 move, double& worst) {
    const Vec3 before = block_.node[n];
    for (std::size_t d = 0; d < 3; ++d)
      if (ends_ >> d & 1 && before[d] == 1) move[d] = 0;
    block_.node[n] += move;
    const double now = worst_at(n);
    if (now > worst)
      worst = now;
    else
      block_.node[n] = before;
  }
  // Smallest scaled Jacobian of the corners that the node has a part in; short edges count as well.
  [[nodiscard]] double worst_at(std::size_t n) const {
    double worst = 2;
    for (const auto& [h, c] : corners_[n]) {
      HexCorners p;
      for (std::size_t i = 0; i < 8; ++i) p[i] = block_.node[block_.hex[h][i]];
      worst = std::min(worst, corner_scaled_jacobian(p, static_cast<int>(c)));
      for (const int k : kCornerNeighbours[c])
        worst = std::min(
            {worst, corner_scaled_jacobian(p, k), kPerEdge * norm(p[static_cast<std::size_t>(k)] - p[c])});
    }
    return worst;
  }

  BlockTemplate& block_;
  unsigned ends_;
  std::vector<std::vector<std::pair<std::size_t, std::size_t>>>
      corners_;                                         // per node: hexes and which corner it is
  std::vector<std::vector<std::uint16_t>> neighbours_;  // along edges
};

}  // namespace

void relax_interior(BlockTemplate& block, unsigned ends) { Relaxation(block, ends).run(); }

}  // namespace sculpt
