#pragma once
// The rows of a Tecplot point file as cells: x y z of the centroid, then a fraction per material.
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sculpt/base/vec3.hpp"
#include "sculpt/grid/index_box.hpp"
#include "sculpt/input/material_source.hpp"

namespace sculpt {

// The unit-spaced grid of the centroids of a file.
struct CentroidGrid {
  Index3 cells{0, 0, 0};
  Vec3 first;  // the smallest centroid
  [[nodiscard]] std::optional<Index3> cell(const Vec3& centroid) const;
};

// A volume fraction under way to the rank that wants it. A row's entries stay together, materials ascending.
struct FractionEntry {
  std::int64_t position;  // of the cell in the box of the rank that wants it
  std::int32_t material;  // dense index
  double value;
};

// Rows, checked and normalised, with only the materials that are present.
struct MicroRows {
  struct Item {
    std::int32_t material;
    double value;
  };
  std::vector<Index3> cells;
  std::vector<std::size_t> offset{0};
  std::vector<Item> items;

  void clear();
  // Adds a row; returns what is wrong with it, or an empty text.
  [[nodiscard]] std::string add(std::span<const double> row, const CentroidGrid& grid);
  // The smallest box around all cells.
  [[nodiscard]] IndexBox bounds() const;
  // Appends the rows whose cells, moved by -shift, lie in the box.
  void select(const IndexBox& box, const Index3& shift, std::vector<FractionEntry>& to) const;
};

// The fractions of a box from the entries of its cells in any order of the rows. `shift` and `path` are for
// the message: Error when a cell has no row or more than one.
[[nodiscard]] Fractions assemble(const IndexBox& box, const std::vector<FractionEntry>& entries,
                                 const Index3& shift, const std::string& path);

}  // namespace sculpt
