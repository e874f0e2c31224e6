#pragma once
// The pieces that a solid cuts from a row of lines.
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace sculpt {

// Pieces in layers: each layer has at most one piece [lo, hi] per line (lo >= hi: none). The pieces of one
// line do not overlap. Keeps its storage from row to row.
class ChordRow {
 public:
  struct Layer {
    std::span<double> lo, hi;
  };
  // A new row without layers. Of its lines only [first, first + count) are asked for.
  void begin(std::size_t lines, std::size_t first, std::size_t count) {
    lines_ = lines;
    first_ = first;
    count_ = count;
    layers_ = 0;
  }
  void begin(std::size_t lines) { begin(lines, 0, lines); }
  // A further layer: its part that is asked for, to be filled; the other lines have no piece. Earlier spans
  // become invalid.
  Layer add_layer() {
    const std::size_t from = lines_ * layers_++;
    if (lo_.size() < from + lines_) {
      lo_.resize(from + lines_);
      hi_.resize(from + lines_);
    }
    if (count_ < lines_) {
      std::fill_n(lo_.begin() + static_cast<std::ptrdiff_t>(from), lines_, 0.0);
      std::fill_n(hi_.begin() + static_cast<std::ptrdiff_t>(from), lines_, 0.0);
    }
    return {{lo_.data() + from + first_, count_}, {hi_.data() + from + first_, count_}};
  }

  [[nodiscard]] std::size_t lines() const { return lines_; }
  [[nodiscard]] std::size_t layers() const { return layers_; }
  // All lines of the row.
  [[nodiscard]] const double* lo(std::size_t layer) const { return lo_.data() + lines_ * layer; }
  [[nodiscard]] const double* hi(std::size_t layer) const { return hi_.data() + lines_ * layer; }
  [[nodiscard]] Layer layer(std::size_t l) {
    return {{lo_.data() + lines_ * l, lines_}, {hi_.data() + lines_ * l, lines_}};
  }

 private:
  std::size_t lines_ = 0, first_ = 0, count_ = 0, layers_ = 0;
  std::vector<double> lo_, hi_;  // by layer and line
};

}  // namespace sculpt
