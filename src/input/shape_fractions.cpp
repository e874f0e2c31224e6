#include "input/shape_fractions.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace sculpt {
namespace {

constexpr std::size_t kLines = 32;  // per direction across a cell
constexpr double kAbsent = 1e-12;   // smaller fractions are rounding

using Row = std::array<double, kLines>;

// Measures one cell at a time by lines along the axis in which the surface is steepest: exact along the line,
// midpoint rule across.
class CellMeter {
 public:
  CellMeter(std::span<const InsertedShape> shapes, std::int32_t outside)
      : shapes_(shapes), outside_(outside) {}

  // Appends the fractions of a cell to the list. `candidates`: shapes that may reach it, in the order of
  // insertion.
  void measure(const Box& cell, std::span<const std::int32_t> candidates, Fractions& fractions) {
    if (const auto sole = sole_material(cell, candidates)) {
      fractions.add(*sole, 1.0);
    } else {
      sample(cell);
      append(cell, fractions);
    }
    fractions.end_cell();
  }

  // The material that fills the cell; nothing when only a measurement could tell.
  [[nodiscard]] std::optional<std::int32_t> sole_material(const Box& cell,
                                                          std::span<const std::int32_t> candidates) {
    select(cell, candidates);
    if (reaching_.empty()) return outside_;
    const std::int32_t first = material(0);
    if (!filled_ && first != outside_) return std::nullopt;
    for (std::size_t s = 1; s < reaching_.size(); ++s)
      if (material(s) != first) return std::nullopt;
    return first;
  }

 private:
  [[nodiscard]] const Shape& shape(std::size_t s) const { return *shapes_[reaching_[s]].shape; }
  [[nodiscard]] std::int32_t material(std::size_t s) const { return shapes_[reaching_[s]].material; }

  // The shapes that count: those that reach the cell, up to the first that fills it.
  void select(const Box& cell, std::span<const std::int32_t> candidates) {
    reaching_.clear();
    filled_ = false;
    for (const std::int32_t c : candidates) {
      const auto at = static_cast<std::size_t>(c);
      if (shapes_[at].shape->misses(cell)) continue;
      reaching_.push_back(at);
      filled_ = shapes_[at].shape->contains(cell);
      if (filled_) return;
    }
  }

  // Sums in length_[s] what shape s gets of all lines, cell by cell of the line grid.
  void sample(const Box& cell) {
    const std::size_t axis = shape(0).steepest_axis(0.5 * (cell.lo + cell.hi));
    const std::size_t axis_u = (axis + 1) % 3, axis_v = (axis + 2) % 3;
    const double from = cell.lo[axis], to = cell.hi[axis];
    Row v;
    for (std::size_t l = 0; l < kLines; ++l) v[l] = line(cell, axis_v, l);
    length_.assign(reaching_.size(), Row{});
    lo_.resize(reaching_.size());
    hi_.resize(reaching_.size());
    for (std::size_t l = 0; l < kLines; ++l) {
      const double u = line(cell, axis_u, l);
      for (std::size_t s = 0; s < reaching_.size(); ++s) shape(s).chords(axis, u, v, lo_[s], hi_[s]);
      if (reaching_.size() == 1)
        add_row(from, to);
      else
        for (std::size_t column = 0; column < kLines; ++column) share_line(from, to, column);
    }
  }
  [[nodiscard]] static double line(const Box& cell, std::size_t axis, std::size_t l) {
    const double t = (static_cast<double>(l) + 0.5) / static_cast<double>(kLines);
    return cell.lo[axis] + t * (cell.hi[axis] - cell.lo[axis]);
  }

  void add_row(double from, double to) {
    const Row &lo = lo_[0], &hi = hi_[0];
    Row& length = length_[0];
    for (std::size_t l = 0; l < kLines; ++l) {
      const double start = lo[l] > from ? lo[l] : from, end = hi[l] < to ? hi[l] : to;
      const double inside = end - start;
      length[l] += inside > 0.0 ? inside : 0.0;
    }
  }

  // Deals the line out: each shape takes what is left of its chord.
  void share_line(double from, double to, std::size_t column) {
    left_.assign(1, {from, to});
    for (std::size_t s = 0; s < reaching_.size() && !left_.empty(); ++s) {
      const double lo = lo_[s][column], hi = hi_[s][column];
      if (!(lo < hi)) continue;
      next_.clear();
      for (const Piece& piece : left_) {
        const double start = std::max(piece.from, lo), end = std::min(piece.to, hi);
        if (!(start < end)) {
          next_.push_back(piece);
          continue;
        }
        length_[s][column] += end - start;
        if (piece.from < start) next_.push_back({piece.from, start});
        if (end < piece.to) next_.push_back({end, piece.to});
      }
      left_.swap(next_);
    }
  }

  // Turns the lengths into fractions by material, ascending, whose sum is 1.
  void append(const Box& cell, Fractions& fractions) {
    const std::size_t axis = shape(0).steepest_axis(0.5 * (cell.lo + cell.hi));
    const double whole = static_cast<double>(kLines * kLines) * (cell.hi[axis] - cell.lo[axis]);
    shares_.clear();
    double covered = 0;
    for (std::size_t s = 0; s < reaching_.size(); ++s) {
      double length = 0;
      for (const double part : length_[s]) length += part;
      shares_.push_back({material(s), length / whole});
      covered += length / whole;
    }
    shares_.push_back({outside_, filled_ ? 0.0 : std::max(0.0, 1 - covered)});
    std::stable_sort(shares_.begin(), shares_.end(),
                     [](const Share& a, const Share& b) { return a.material < b.material; });
    std::size_t kept = 0;
    for (std::size_t s = 0; s < shares_.size(); ++s) {
      if (kept > 0 && shares_[kept - 1].material == shares_[s].material)
        shares_[kept - 1].value += shares_[s].value;
      else
        shares_[kept++] = shares_[s];
    }
    shares_.resize(kept);
    double sum = 0;
    for (const Share& share : shares_)
      if (share.value > kAbsent) sum += share.value;
    for (const Share& share : shares_)
      if (share.value > kAbsent) fractions.add(share.material, share.value / sum);
  }

  struct Piece {
    double from, to;
  };
  struct Share {
    std::int32_t material;
    double value;
  };

  std::span<const InsertedShape> shapes_;
  std::int32_t outside_;
  std::vector<std::size_t> reaching_;  // positions in shapes_
  bool filled_ = false;                // the last of them fills the cell
  std::vector<Row> lo_, hi_, length_;  // per reaching shape
  std::vector<Piece> left_, next_;
  std::vector<Share> shares_;
};

// The cells of the box that the bounds touch.
IndexBox touched_cells(const Grid& grid, const IndexBox& box, const Box& bounds) {
  IndexBox touched;
  for (std::size_t d = 0; d < 3; ++d) {
    const std::vector<double>& planes = grid.planes[d];
    touched.lo[d] = std::upper_bound(planes.begin(), planes.end(), bounds.lo[d]) - planes.begin() - 1;
    touched.hi[d] = std::lower_bound(planes.begin(), planes.end(), bounds.hi[d]) - planes.begin();
  }
  return intersection(touched, box);
}

// Which shapes may reach each cell of one z layer of a box: CSR, in the order of insertion.
struct LayerCandidates {
  std::vector<std::int64_t> offset;
  std::vector<std::int32_t> shape;

  void build(const IndexBox& layer, const std::vector<IndexBox>& touched) {
    offset.assign(static_cast<std::size_t>(layer.size()) + 1, 0);
    for_each_cell(layer, touched, [&](std::size_t cell, std::int32_t) { ++offset[cell + 1]; });
    for (std::size_t c = 1; c < offset.size(); ++c) offset[c] += offset[c - 1];
    shape.resize(static_cast<std::size_t>(offset.back()));
    fill_ = offset;
    for_each_cell(layer, touched, [&](std::size_t cell, std::int32_t s) {
      shape[static_cast<std::size_t>(fill_[cell]++)] = s;
    });
  }

 private:
  template <class Visit>
  static void for_each_cell(const IndexBox& layer, const std::vector<IndexBox>& touched, const Visit& visit) {
    for (std::size_t s = 0; s < touched.size(); ++s) {
      const IndexBox part = intersection(layer, touched[s]);
      if (part.empty()) continue;
      for (std::int64_t j = part.lo[1]; j < part.hi[1]; ++j) {
        const std::int64_t start = layer.position({part.lo[0], j, part.lo[2]});
        for (std::int64_t i = 0; i < part.extent(0); ++i)
          visit(static_cast<std::size_t>(start + i), static_cast<std::int32_t>(s));
      }
    }
  }

  std::vector<std::int64_t> fill_;
};

Box cell_box(const Grid& grid, const Index3& cell) {
  Box box;
  for (std::size_t d = 0; d < 3; ++d) {
    box.lo[d] = grid.planes[d][static_cast<std::size_t>(cell[d])];
    box.hi[d] = grid.planes[d][static_cast<std::size_t>(cell[d]) + 1];
  }
  return box;
}

class ShapeField final : public MaterialField {
 public:
  ShapeField(std::shared_ptr<const std::vector<InsertedShape>> shapes, std::int32_t outside)
      : shapes_(std::move(shapes)), meter_(*shapes_, outside), all_(shapes_->size()) {
    std::iota(all_.begin(), all_.end(), 0);
  }

  void measure(const Box& box, Fractions& out) override { meter_.measure(box, all_, out); }
  [[nodiscard]] std::optional<std::int32_t> sole_material(const Box& box) override {
    return meter_.sole_material(box, all_);
  }

 private:
  std::shared_ptr<const std::vector<InsertedShape>> shapes_;
  CellMeter meter_;
  std::vector<std::int32_t> all_;
};

}  // namespace

std::unique_ptr<MaterialField> shape_field(std::shared_ptr<const std::vector<InsertedShape>> shapes,
                                           std::int32_t outside) {
  return std::make_unique<ShapeField>(std::move(shapes), outside);
}

Fractions shape_fractions(const Grid& grid, const IndexBox& box, std::span<const InsertedShape> shapes,
                          std::int32_t outside) {
  Fractions fractions;
  const auto cells = static_cast<std::size_t>(box.size());
  fractions.reserve(cells, cells + cells / 8);
  std::vector<IndexBox> touched;
  for (const InsertedShape& inserted : shapes)
    touched.push_back(touched_cells(grid, box, inserted.shape->bounds()));
  CellMeter meter(shapes, outside);
  LayerCandidates candidates;
  if (box.empty()) return fractions;
  for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) {
    const IndexBox layer{{box.lo[0], box.lo[1], k}, {box.hi[0], box.hi[1], k + 1}};
    candidates.build(layer, touched);
    for (std::int64_t c = 0; c < layer.size(); ++c) {
      const auto at = static_cast<std::size_t>(c);
      const std::span<const std::int32_t> list(candidates.shape.data() + candidates.offset[at],
                                               candidates.shape.data() + candidates.offset[at + 1]);
      meter.measure(cell_box(grid, layer.cell(c)), list, fractions);
    }
  }
  return fractions;
}

}  // namespace sculpt
