#include "input/data_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sculpt/base/error.hpp"

namespace sculpt {
namespace {

constexpr double kSnap = 1e-6;  // in cells: planes that are closer than this are the same

// The cells along one axis, the outermost ones without end.
class Axis {
 public:
  explicit Axis(std::vector<double> planes) : planes_(std::move(planes)) {
    last_ = static_cast<std::int64_t>(planes_.size()) - 2;
    per_length_ = static_cast<double>(last_ + 1) / (planes_.back() - planes_.front());
    equal_ = true;
    for (std::int64_t i = 0; i <= last_; ++i) equal_ = equal_ && std::fabs(relative_width(i) - 1) <= kSnap;
  }

  // The cells [first, last] that [lo, hi] overlaps and how much of the first and of the last one it covers.
  struct Range {
    std::int64_t first, last;
    double of_first, of_last;
  };
  [[nodiscard]] Range overlap(double lo, double hi) const {
    Place from = place(lo), to = place(hi);
    if (from.in_cell >= 1 - kSnap && from.cell < last_) from = {from.cell + 1, 0};
    if (to.in_cell <= kSnap && to.cell > 0) to = {to.cell - 1, 1};
    if (to.cell < from.cell) from = to = place(0.5 * (lo + hi));  // thinner than the tolerance
    if (from.cell == to.cell) return {from.cell, from.cell, 1, 1};
    return {from.cell, to.cell, share(1 - from.in_cell), share(to.in_cell)};
  }
  // What a cell weighs: its width, or 1 where all are equal, so that averages of whole cells are exact.
  [[nodiscard]] double weight(std::int64_t cell) const { return equal_ ? 1 : relative_width(cell); }

 private:
  struct Place {
    std::int64_t cell;
    double in_cell;  // 0 at its lower plane, 1 at its upper plane; beyond that in outermost cells
  };
  // Exactly 1 for a whole cell.
  [[nodiscard]] static double share(double s) { return std::fabs(s - 1) <= kSnap ? 1 : s; }
  [[nodiscard]] double plane(std::int64_t i) const { return planes_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] double relative_width(std::int64_t cell) const {
    return (plane(cell + 1) - plane(cell)) * per_length_;
  }
  [[nodiscard]] Place place(double x) const {
    std::int64_t cell = 0;
    if (equal_) {
      const double guess = (x - planes_.front()) * per_length_;
      cell = static_cast<std::int64_t>(std::clamp(guess, 0.0, static_cast<double>(last_)));
      while (cell < last_ && plane(cell + 1) <= x) ++cell;
      while (cell > 0 && plane(cell) > x) --cell;
    } else {
      const auto above = std::upper_bound(planes_.begin(), planes_.end(), x);
      cell = std::clamp<std::int64_t>(above - planes_.begin() - 1, 0, last_);
    }
    return {cell, (x - plane(cell)) / (plane(cell + 1) - plane(cell))};
  }

  std::vector<double> planes_;
  std::int64_t last_;  // cell
  double per_length_;  // cells
  bool equal_;
};

// The cells that a box overlaps, and their weights per axis.
class Overlap {
 public:
  Overlap(const Grid& grid, const IndexBox& known)
      : axes_{Axis(grid.planes[0]), Axis(grid.planes[1]), Axis(grid.planes[2])}, known_(known) {}

  [[nodiscard]] IndexBox cells(const Box& box) {
    IndexBox cells;
    for (std::size_t d = 0; d < 3; ++d) {
      range_[d] = axes_[d].overlap(box.lo[d], box.hi[d]);
      cells.lo[d] = range_[d].first;
      cells.hi[d] = range_[d].last + 1;
    }
    check(intersection(cells, known_) == cells, "a box reaches beyond the cells that were read");
    return cells;
  }
  // Of the cells of the last box, by position along the axis.
  [[nodiscard]] const std::vector<double>& weights(std::size_t d) {
    const Axis::Range& r = range_[d];
    std::vector<double>& w = weight_[d];
    w.resize(static_cast<std::size_t>(r.last - r.first + 1));
    for (std::size_t i = 0; i < w.size(); ++i) w[i] = axes_[d].weight(r.first + static_cast<std::int64_t>(i));
    w.front() *= r.of_first;
    w.back() *= w.size() > 1 ? r.of_last : 1;
    return w;
  }

 private:
  std::array<Axis, 3> axes_;
  IndexBox known_;
  std::array<Axis::Range, 3> range_{};
  std::array<std::vector<double>, 3> weight_;
};

// What both kinds of data share: from a box to its cells.
class DataField : public VoxelField {
 public:
  DataField(const Grid& grid, const IndexBox& known, std::int32_t materials)
      : overlap_(grid, known), known_(known), shares_(materials) {}

  void measure(const Box& box, Fractions& out) final {
    const IndexBox cells = overlap_.cells(box);
    if (cells.size() == 1) {
      put_cell(position(cells.lo), out);
      return;
    }
    const std::vector<double>&wx = overlap_.weights(0), &wy = overlap_.weights(1), &wz = overlap_.weights(2);
    for (std::int64_t k = cells.lo[2]; k < cells.hi[2]; ++k)
      for (std::int64_t j = cells.lo[1]; j < cells.hi[1]; ++j)
        add_row(position({cells.lo[0], j, k}), wx,
                wy[static_cast<std::size_t>(j - cells.lo[1])] * wz[static_cast<std::size_t>(k - cells.lo[2])],
                shares_);
    shares_.move_to(out);
  }

  [[nodiscard]] std::optional<std::int32_t> sole_material(const Box& box) final {
    return sole_material(overlap_.cells(box));
  }
  [[nodiscard]] std::optional<std::int32_t> sole_material(const IndexBox& cells) const final {
    check(intersection(cells, known_) == cells, "a hex reaches beyond the cells that were read");
    const std::optional<std::int32_t> sole = sole_of(position(cells.lo));
    if (!sole) return std::nullopt;
    const auto length = static_cast<std::size_t>(cells.extent(0));
    for (std::int64_t k = cells.lo[2]; k < cells.hi[2]; ++k)
      for (std::int64_t j = cells.lo[1]; j < cells.hi[1]; ++j)
        if (!row_is(position({cells.lo[0], j, k}), length, *sole)) return std::nullopt;
    return sole;
  }

  void add(const Index3& cell, double weight, Shares& shares) const final {
    check(known_.contains(cell), "a hex reaches beyond the cells that were read");
    add_cell(position(cell), weight, shares);
  }

 private:
  [[nodiscard]] std::size_t position(const Index3& cell) const {
    return static_cast<std::size_t>(known_.position(cell));
  }
  virtual void put_cell(std::size_t cell, Fractions& out) const = 0;
  virtual void add_cell(std::size_t cell, double weight, Shares& shares) const = 0;
  // Adds a row of cells along x, with weights along x times that of the row.
  virtual void add_row(std::size_t first, const std::vector<double>& wx, double row,
                       Shares& shares) const = 0;
  [[nodiscard]] virtual std::optional<std::int32_t> sole_of(std::size_t cell) const = 0;
  [[nodiscard]] virtual bool row_is(std::size_t first, std::size_t length, std::int32_t sole) const = 0;

  Overlap overlap_;
  IndexBox known_;
  Shares shares_;
};

// One material per cell.
class PureField final : public DataField {
 public:
  PureField(const Grid& grid, const IndexBox& known, std::vector<std::int32_t> material,
            std::int32_t materials)
      : DataField(grid, known, materials), material_(std::move(material)) {}

 private:
  void put_cell(std::size_t cell, Fractions& out) const override {
    out.add(material_[cell], 1.0);
    out.end_cell();
  }
  void add_cell(std::size_t cell, double weight, Shares& shares) const override {
    shares.add(material_[cell], weight);
  }
  void add_row(std::size_t first, const std::vector<double>& wx, double row, Shares& shares) const override {
    const std::int32_t* const material = material_.data() + first;
    std::int32_t current = material[0];
    double run = 0;
    for (std::size_t i = 0; i < wx.size(); ++i) {
      if (material[i] != current) {
        shares.add(current, run * row);
        current = material[i];
        run = 0;
      }
      run += wx[i];
    }
    shares.add(current, run * row);
  }
  [[nodiscard]] std::optional<std::int32_t> sole_of(std::size_t cell) const override {
    return material_[cell];
  }
  [[nodiscard]] bool row_is(std::size_t first, std::size_t length, std::int32_t sole) const override {
    std::int32_t differ = 0;  // no early exit: rows are short, and this loop becomes vector instructions
    for (std::size_t i = 0; i < length; ++i) differ |= material_[first + i] ^ sole;
    return differ == 0;
  }

  std::vector<std::int32_t> material_;
};

// Several materials in some cells.
class MixedField final : public DataField {
 public:
  MixedField(const Grid& grid, const IndexBox& known, Fractions fractions, std::int32_t materials)
      : DataField(grid, known, materials), fractions_(std::move(fractions)) {}

 private:
  [[nodiscard]] std::size_t begin(std::size_t cell) const {
    return static_cast<std::size_t>(fractions_.offset[cell]);
  }
  void put_cell(std::size_t cell, Fractions& out) const override {
    for (std::size_t e = begin(cell); e < begin(cell + 1); ++e)
      out.add(fractions_.material[e], fractions_.value[e]);
    out.end_cell();
  }
  void add_cell(std::size_t cell, double weight, Shares& shares) const override {
    for (std::size_t e = begin(cell); e < begin(cell + 1); ++e)
      shares.add(fractions_.material[e], fractions_.value[e] * weight);
  }
  // Pure cells in the runs in which PureField adds them: which class a rank takes depends on its part of the
  // data, what is said of a box must not.
  void add_row(std::size_t first, const std::vector<double>& wx, double row, Shares& shares) const override {
    std::optional<std::int32_t> current;
    double run = 0;
    for (std::size_t i = 0; i < wx.size(); ++i) {
      const std::optional<std::int32_t> sole = sole_of(first + i);
      if (current && sole != current) shares.add(*current, run * row);
      if (sole != current) run = 0;
      current = sole;
      if (sole)
        run += wx[i];
      else
        for (std::size_t e = begin(first + i); e < begin(first + i + 1); ++e)
          shares.add(fractions_.material[e], fractions_.value[e] * (wx[i] * row));
    }
    if (current) shares.add(*current, run * row);
  }
  [[nodiscard]] std::optional<std::int32_t> sole_of(std::size_t cell) const override {
    if (begin(cell + 1) != begin(cell) + 1) return std::nullopt;
    return fractions_.material[begin(cell)];
  }
  [[nodiscard]] bool row_is(std::size_t first, std::size_t length, std::int32_t sole) const override {
    for (std::size_t c = first; c < first + length; ++c)
      if (sole_of(c) != sole) return false;
    return true;
  }

  Fractions fractions_;
};

}  // namespace

std::unique_ptr<VoxelField> data_field(const Grid& grid, const IndexBox& known, Fractions fractions) {
  check(fractions.cells() == known.size(), "a field needs the fractions of all of its cells");
  const auto largest = std::max_element(fractions.material.begin(), fractions.material.end());
  const std::int32_t materials = largest == fractions.material.end() ? 0 : *largest + 1;
  if (static_cast<std::int64_t>(fractions.material.size()) == fractions.cells())
    return std::make_unique<PureField>(grid, known, std::move(fractions.material), materials);
  return std::make_unique<MixedField>(grid, known, std::move(fractions), materials);
}

std::unique_ptr<MaterialField> MaterialSource::field(Fractions fractions, const IndexBox& wanted) const {
  return data_field(grid(), wanted, std::move(fractions));
}

}  // namespace sculpt
