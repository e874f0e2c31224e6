#include "sculpt/adapt/criteria.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adapt/periodic_field.hpp"
#include "sculpt/adapt/leaf_mesh.hpp"
#include "sculpt/geom/hex.hpp"
#include "sculpt/geom/plane_cut.hpp"

namespace sculpt {
namespace {

constexpr double kJustOutside = 1e-3;  // of the finest cell

// Largest difference, over the materials, of cells i and j.
double difference(const Fractions& f, LocalId i, LocalId j) {
  double most = 0;
  for (const auto& [a, b] : {std::pair{i, j}, std::pair{j, i}})
    for (auto e = static_cast<std::size_t>(f.offset[at(a)]);
         e < static_cast<std::size_t>(f.offset[at(a) + 1]); ++e)
      most = std::max(most, std::fabs(f.value[e] - fraction_of(f, b, f.material[e])));
  return most;
}

void clear(Fractions& f) {
  f.offset.assign(1, 0);
  f.material.clear();
  f.value.clear();
}

Box grown(const Box& box, const Vec3& by) { return {box.lo - by, box.hi + by}; }

Box octant(const Box& box, unsigned o) {
  const Vec3 middle = 0.5 * (box.lo + box.hi);
  Box part;
  for (std::size_t d = 0; d < 3; ++d) {
    part.lo[d] = o >> d & 1 ? middle[d] : box.lo[d];
    part.hi[d] = o >> d & 1 ? box.hi[d] : middle[d];
  }
  return part;
}

// The plane that stands for the interface between the two materials that fill most of a box.
struct Cut {
  bool exists = false;
  std::int32_t a = 0, b = 0;
  Vec3 point, normal;  // unit
};

class Marker {
 public:
  Marker(const Grid& grid, MaterialField& field, const AdaptCriterion& criterion, Forest& forest)
      : grid_(grid), field_(field, grid, forest.periodic()), criterion_(criterion), forest_(forest) {}

  void visit(int level, const Index3& cell) {
    const Index3 n = forest_.cells(level);
    if (level == forest_.levels() || cell[0] >= n[0] || cell[1] >= n[1] || cell[2] >= n[2] ||
        !wants(level, cell))
      return;
    forest_.refine_cell(level, cell);
    for (unsigned o = 0; o < 8; ++o)
      visit(level + 1, {2 * cell[0] + (o & 1), 2 * cell[1] + (o >> 1 & 1), 2 * cell[2] + (o >> 2)});
  }

  // Halves the cells around a node of the grid, and around the nodes that come into being there.
  void separate(int level, const Index3& node) {
    if (level == forest_.levels()) return;
    std::array<std::int32_t, 8> material{};
    std::array<bool, 8> inside{};
    for (unsigned o = 0; o < 8; ++o) {
      const Index3 cell = around(node, o);
      inside[o] = in_grid(level, cell);
      material[o] = inside[o] ? most_of(cell_box(level, cell)) : -1;
    }
    if (is_manifold(material)) return;
    for (unsigned o = 0; o < 8; ++o)
      if (inside[o]) forest_.refine_cell(level, wrapped(level, around(node, o)));
    for (std::int64_t k = -1; k <= 1; ++k)
      for (std::int64_t j = -1; j <= 1; ++j)
        for (std::int64_t i = -1; i <= 1; ++i)
          separate(level + 1, {2 * node[0] + i, 2 * node[1] + j, 2 * node[2] + k});
  }

 private:
  [[nodiscard]] Box cell_box(int level, const Index3& cell) const {
    Box box{};
    const Index3 n = forest_.cells(level);
    Vec3 move;
    Index3 c = cell;
    for (std::size_t d = 0; d < 3; ++d)  // cells beyond a periodic end keep the size of those they stand for
      if (c[d] < 0 || c[d] >= n[d]) {
        const double period = grid_.planes[d].back() - grid_.planes[d].front();
        move[d] = c[d] < 0 ? -period : period;
        c[d] += c[d] < 0 ? n[d] : -n[d];
      }
    box.lo = move + grid_point(grid_, level, c);
    box.hi = move + grid_point(grid_, level, {c[0] + 1, c[1] + 1, c[2] + 1});
    return box;
  }
  [[nodiscard]] bool in_grid(int level, const Index3& cell) const {
    const Index3 n = forest_.cells(level);
    for (std::size_t d = 0; d < 3; ++d)
      if (!forest_.periodic()[d] && (cell[d] < 0 || cell[d] >= n[d])) return false;
    return true;
  }
  [[nodiscard]] Index3 wrapped(int level, Index3 cell) const {
    const Index3 n = forest_.cells(level);
    for (std::size_t d = 0; d < 3; ++d) cell[d] = (cell[d] + n[d]) % n[d];
    return cell;
  }
  static Index3 around(const Index3& node, unsigned o) {
    return {node[0] - 1 + (o & 1), node[1] - 1 + (o >> 1 & 1), node[2] - 1 + (o >> 2)};
  }

  [[nodiscard]] bool wants(int level, const Index3& cell) {
    const Box box = cell_box(level, cell);
    switch (criterion_.measure) {
      case AdaptMeasure::kFractions:
        return fractions_differ(level, cell, box);
      case AdaptMeasure::kMaterial:
        return holds_material(level, box);
      default:
        return !field_.sole_material(box) && deviation(box) > criterion_.threshold;
    }
  }

  [[nodiscard]] bool fractions_differ(int level, const Index3& cell, const Box& box) {
    const Vec3 outside = std::ldexp(kJustOutside, level - forest_.levels()) * (box.hi - box.lo);
    if (field_.sole_material(grown(box, outside))) return false;
    return parts_differ(box) || differs_from_outside(level, cell, box, outside);
  }

  // A part that is pure and one that is not tell enough in most cells.
  [[nodiscard]] bool parts_differ(const Box& box) {
    std::array<std::optional<std::int32_t>, 8> sole;
    for (unsigned o = 0; o < 8; ++o) sole[o] = field_.sole_material(octant(box, o));
    if (sole[0] && std::all_of(sole.begin(), sole.end(), [&](const auto& s) { return s == sole[0]; }))
      return false;
    clear(scratch_);
    for (unsigned o = 0; o < 8; ++o) {
      if (sole[o]) {
        scratch_.add(*sole[o], 1);
        scratch_.end_cell();
      } else {
        field_.measure(octant(box, o), scratch_);
      }
      // The average is nearer than half of the difference to one of any two at most.
      if (o > 0 && 0.5 * difference(scratch_, 0, o) > criterion_.threshold) return true;
    }
    for (std::size_t e = 0; e < scratch_.material.size(); ++e) {
      const std::int32_t m = scratch_.material[e];
      double mean = 0;
      for (std::size_t o = 0; o < 8; ++o) mean += 0.125 * fraction_of(scratch_, o, m);
      for (std::size_t o = 0; o < 8; ++o)
        if (std::fabs(fraction_of(scratch_, o, m) - mean) > criterion_.threshold) return true;
    }
    return false;
  }

  // Interfaces may run between cells: what lies just inside a side, an edge or a corner is compared with what
  // lies just outside.
  [[nodiscard]] bool differs_from_outside(int level, const Index3& cell, const Box& box,
                                          const Vec3& thickness) {
    for (int o = 0; o < 27; ++o) {
      const std::array<int, 3> side{o % 3 - 1, o / 3 % 3 - 1, o / 9 - 1};
      if (o == 13 || !in_grid(level, {cell[0] + side[0], cell[1] + side[1], cell[2] + side[2]})) continue;
      Box inside = box, outside = box;
      for (std::size_t d = 0; d < 3; ++d) {
        if (side[d] < 0) {
          inside.hi[d] = box.lo[d] + thickness[d];
          outside.hi[d] = box.lo[d];
          outside.lo[d] = box.lo[d] - thickness[d];
        } else if (side[d] > 0) {
          inside.lo[d] = box.hi[d] - thickness[d];
          outside.lo[d] = box.hi[d];
          outside.hi[d] = box.hi[d] + thickness[d];
        }
      }
      clear(scratch_);
      field_.measure(inside, scratch_);
      field_.measure(outside, scratch_);
      if (difference(scratch_, 0, 1) > criterion_.threshold) return true;
    }
    return false;
  }

  [[nodiscard]] bool holds_material(int level, const Box& box) {
    for (const AdaptCriterion::Material& m : criterion_.materials) {
      if (level >= m.levels) continue;
      if (holds(box, m)) return true;
      if (m.distance > 0 && holds(inside_domain(grown(box, {m.distance, m.distance, m.distance})), m))
        return true;
    }
    return false;
  }
  [[nodiscard]] bool holds(const Box& box, const AdaptCriterion::Material& m) {
    if (const auto sole = field_.sole_material(box)) return *sole == m.material && 1 > m.fraction;
    clear(scratch_);
    field_.measure(box, scratch_);
    return fraction_of(scratch_, 0, m.material) > m.fraction;
  }
  [[nodiscard]] Box inside_domain(Box box) const {
    for (std::size_t d = 0; d < 3; ++d) {
      if (forest_.periodic()[d]) continue;
      box.lo[d] = std::max(box.lo[d], grid_.planes[d].front());
      box.hi[d] = std::min(box.hi[d], grid_.planes[d].back());
    }
    return box;
  }

  // Distances of planes and geometry, at the parts of the cell that the interface runs through.
  [[nodiscard]] double deviation(const Box& box) {
    const Cut whole_cell = cut_of(box);
    if (!whole_cell.exists) return 0;
    double most = 0;
    for (unsigned o = 0; o < 8; ++o) {
      const Box part = octant(box, o);
      if (field_.sole_material(part)) continue;
      const Vec3 centre = 0.5 * (part.lo + part.hi);
      const auto to_plane = [&](const Vec3& p) { return dot(p - whole_cell.point, whole_cell.normal); };
      if (criterion_.measure == AdaptMeasure::kSurfaceToSurface) {
        const Cut finer = cut_of(part);
        if (finer.exists) most = std::max(most, std::fabs(to_plane(finer.point)));
      } else if (criterion_.measure == AdaptMeasure::kFacetToSurface) {
        if (const auto q = criterion_.exact(centre, whole_cell.a, whole_cell.b))
          most = std::max(most, std::fabs(to_plane(*q)));
      } else {
        const Vec3 r = centre - to_plane(centre) * whole_cell.normal;
        if (const auto q = criterion_.exact(r, whole_cell.a, whole_cell.b))
          most = std::max(most, norm(*q - r));
      }
    }
    return most;
  }

  // Where the two materials with most of the box share it, across the direction in which they change. A box
  // twice as large tells that direction: in one of which a corner is cut off, its own parts tell little.
  [[nodiscard]] Cut cut_of(const Box& box) {
    clear(scratch_);
    field_.measure(box, scratch_);
    Cut cut;
    if (scratch_.material.size() < 2) return cut;
    std::vector<std::pair<double, std::int32_t>> most;
    for (std::size_t e = 0; e < scratch_.material.size(); ++e)
      most.emplace_back(-scratch_.value[e], scratch_.material[e]);
    std::sort(most.begin(), most.end());  // ties by material
    cut.a = most[0].second;
    cut.b = most[1].second;
    const Vec3 size = box.hi - box.lo;
    const Box around = grown(box, 0.5 * size);
    clear(scratch_);
    for (unsigned o = 0; o < 8; ++o) field_.measure(octant(around, o), scratch_);
    Vec3 slope;  // of a - b, per cell
    for (unsigned o = 0; o < 8; ++o)
      for (std::size_t d = 0; d < 3; ++d)
        slope[d] +=
            (o >> d & 1 ? 0.25 : -0.25) * (fraction_of(scratch_, o, cut.a) - fraction_of(scratch_, o, cut.b));
    if (!(norm(slope) > 0)) return cut;
    const Vec3 down = unit(-slope);  // from a to b, in cells
    const double share = most[0].first / (most[0].first + most[1].first);
    cut.point = 0.5 * (box.lo + box.hi) + scaled(plane_offset(share, down) * down, size);
    cut.normal = unit(scaled(down, {1 / size.x, 1 / size.y, 1 / size.z}));
    cut.exists = true;
    return cut;
  }

  [[nodiscard]] std::int32_t most_of(const Box& box) {
    if (const auto sole = field_.sole_material(box)) return *sole;
    clear(scratch_);
    field_.measure(box, scratch_);
    return scratch_.material[static_cast<std::size_t>(
        std::max_element(scratch_.value.begin(), scratch_.value.end()) - scratch_.value.begin())];
  }

  // Of the eight cells around a node: the cells of every material and all others each hang together by faces.
  static bool is_manifold(const std::array<std::int32_t, 8>& material) {
    const auto connected = [](unsigned set) {
      unsigned reached = set & (~set + 1);
      for (unsigned before = 0; before != reached;) {
        before = reached;
        for (unsigned c = 0; c < 8; ++c)
          if (reached >> c & 1) reached |= set & (1U << (c ^ 1) | 1U << (c ^ 2) | 1U << (c ^ 4));
      }
      return reached == set;
    };
    unsigned all = 0;
    for (unsigned c = 0; c < 8; ++c) all |= material[c] >= 0 ? 1U << c : 0;
    for (unsigned c = 0; c < 8; ++c) {
      unsigned same = 0;
      for (unsigned o = 0; o < 8; ++o) same |= material[o] == material[c] ? 1U << o : 0;
      if (material[c] >= 0 && (!connected(same) || !connected(all & ~same))) return false;
    }
    return true;
  }

  const Grid& grid_;
  PeriodicField field_;
  const AdaptCriterion& criterion_;
  Forest& forest_;
  Fractions scratch_;
};

}  // namespace

void mark_cells(const Grid& grid, const IndexBox& cells, MaterialField& field,
                const AdaptCriterion& criterion, Forest& forest) {
  Marker marker(grid, field, criterion, forest);
  for (std::int64_t c = 0; c < cells.size(); ++c) marker.visit(0, cells.cell(c));
  if (!criterion.non_manifold || cells.empty()) return;
  IndexBox nodes = cells;  // the low ones of each cell, and those on the high sides of the grid
  for (std::size_t d = 0; d < 3; ++d)
    if (!forest.periodic()[d] && nodes.hi[d] == grid.cells[d]) ++nodes.hi[d];
  for (std::int64_t n = 0; n < nodes.size(); ++n) marker.separate(0, nodes.cell(n));
}

}  // namespace sculpt
