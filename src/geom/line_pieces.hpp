#pragma once
// The pieces of a row of lines, line by line, until they are laid out in layers.
#include <cstddef>
#include <vector>

#include "sculpt/geom/chord_row.hpp"

namespace sculpt {

struct Interval {
  double lo, hi;
};

class LinePieces {
 public:
  // Forgets all lines and keeps the storage.
  void clear() {
    pieces_.clear();
    ends_.clear();
  }
  // Where the pieces of the next line are to be appended.
  std::vector<Interval>& pieces() { return pieces_; }
  void end_line() { ends_.push_back(pieces_.size()); }
  // Where those of the line that has not ended yet begin.
  [[nodiscard]] std::size_t line_begin() const { return begin(ends_.size()); }
  // Adds all lines that have ended to the row, which asks for as many.
  void append_to(ChordRow& row) const;

 private:
  [[nodiscard]] std::size_t begin(std::size_t line) const { return line == 0 ? 0 : ends_[line - 1]; }

  std::vector<Interval> pieces_;
  std::vector<std::size_t> ends_;  // by line
};

}  // namespace sculpt
