#include "geom/line_pieces.hpp"

#include <algorithm>

namespace sculpt {

void LinePieces::append_to(ChordRow& row) const {
  std::size_t layers = 0;
  for (std::size_t l = 0; l < ends_.size(); ++l) layers = std::max(layers, ends_[l] - begin(l));
  for (std::size_t k = 0; k < layers; ++k) {
    const ChordRow::Layer layer = row.add_layer();
    for (std::size_t l = 0; l < ends_.size(); ++l) {
      const std::size_t at = begin(l) + k;
      const Interval piece = at < ends_[l] ? pieces_[at] : Interval{0, 0};
      layer.lo[l] = piece.lo;
      layer.hi[l] = piece.hi;
    }
  }
}

}  // namespace sculpt
