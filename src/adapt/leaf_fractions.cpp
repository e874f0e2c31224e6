#include "sculpt/adapt/leaf_fractions.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {
namespace {

constexpr int kSamples = 4;  // per axis of a hex in transition

// The point of a hex at (u,v,w) in [0,1]^3.
Vec3 inside(const HexCorners& p, double u, double v, double w) {
  Vec3 x;
  for (std::size_t c = 0; c < 8; ++c) {
    const auto& o = kCornerOffset[c];
    x += ((o[0] ? u : 1 - u) * (o[1] ? v : 1 - v) * (o[2] ? w : 1 - w)) * p[c];
  }
  return x;
}

class Meter {
 public:
  Meter(const Grid& grid, const LeafMesh& mesh, MaterialField& field)
      : grid_(grid), mesh_(mesh), field_(field) {}

  void measure(const Leaf& leaf, Fractions& out) {
    const Index3 low{2 * leaf.block[0], 2 * leaf.block[1], 2 * leaf.block[2]};
    Index3 high;
    const int level = leaf.level;
    for (std::size_t d = 0; d < 3; ++d) high[d] = std::min(low[d] + 2, grid_.cells[d] << level);
    const Box block{grid_point(grid_, level, low), grid_point(grid_, level, high)};
    if (const auto sole = field_.sole_material(block)) {
      for (LocalId h = leaf.first; h < leaf.end; ++h) {
        out.add(*sole, 1);
        out.end_cell();
      }
      return;
    }
    for (LocalId h = leaf.first; h < leaf.end; ++h) {
      const HexCorners p = mesh_.cells.corners(h);
      const Box bounds = bounds_of(p);
      const auto sole = field_.sole_material(bounds);
      if (sole) {
        out.add(*sole, 1);
        out.end_cell();
      } else if (leaf.transition) {
        sample(p, bounds, out);
      } else {
        field_.measure(bounds, out);
      }
    }
  }

 private:
  static Box bounds_of(const HexCorners& p) {
    Box box{p[0], p[0]};
    for (const Vec3& x : p)
      for (std::size_t d = 0; d < 3; ++d) {
        box.lo[d] = std::min(box.lo[d], x[d]);
        box.hi[d] = std::max(box.hi[d], x[d]);
      }
    return box;
  }

  // The average of small boxes around points that are evenly spread in the hex.
  void sample(const HexCorners& p, const Box& bounds, Fractions& out) {
    scratch_.offset.assign(1, 0);
    scratch_.material.clear();
    scratch_.value.clear();
    const Vec3 half = (0.25 / kSamples) * (bounds.hi - bounds.lo);
    for (int s = 0; s < kSamples * kSamples * kSamples; ++s) {
      const auto at_sample = [](int i) { return (i % kSamples + 0.5) / kSamples; };
      const Vec3 x = inside(p, at_sample(s), at_sample(s / kSamples), at_sample(s / kSamples / kSamples));
      field_.measure({x - half, x + half}, scratch_);
    }
    shares_.clear();
    for (std::size_t e = 0; e < scratch_.material.size(); ++e)
      shares_.emplace_back(scratch_.material[e], scratch_.value[e]);
    std::stable_sort(shares_.begin(), shares_.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    const double points = kSamples * kSamples * kSamples;
    for (std::size_t e = 0; e < shares_.size();) {
      double total = 0;
      const std::int32_t m = shares_[e].first;
      for (; e < shares_.size() && shares_[e].first == m; ++e) total += shares_[e].second;
      out.add(m, std::min(1.0, total / points));
    }
    out.end_cell();
  }

  const Grid& grid_;
  const LeafMesh& mesh_;
  MaterialField& field_;
  Fractions scratch_;
  std::vector<std::pair<std::int32_t, double>> shares_;
};

}  // namespace

Fractions leaf_fractions(const Grid& grid, const LeafMesh& mesh, MaterialField& field) {
  Fractions out;
  std::size_t cells = 0;
  for (const Leaf& leaf : mesh.leaves) cells += at(leaf.end - leaf.first);
  out.reserve(cells, cells + cells / 16);
  Meter meter(grid, mesh, field);
  for (const Leaf& leaf : mesh.leaves) meter.measure(leaf, out);
  return out;
}

}  // namespace sculpt
