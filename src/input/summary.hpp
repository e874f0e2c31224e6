#pragma once
// The summary that Sculpt prints of a voxel file.
#include <cstdint>
#include <string>
#include <string_view>

#include "sculpt/base/log.hpp"
#include "sculpt/grid/grid.hpp"

namespace sculpt {

inline void print_voxel_summary(const Log& log, std::string_view format, const std::string& path,
                                const Grid& grid, int expand_layers, std::size_t materials) {
  const auto& [x, y, z] = grid.planes;
  log.line("Summary of imported Microstructures {} file grid parameters", format);
  log.line("  File Name            {}", path);
  log.line("  Intervals            {} {} {}", grid.cells[0], grid.cells[1], grid.cells[2]);
  log.line("  Grid Bounds Min      {:f} {:f} {:f}", x.front(), y.front(), z.front());
  log.line("  Grid Bounds Max      {:f} {:f} {:f}", x.back(), y.back(), z.back());
  log.line("  Expanded initial Cartesian grid by {} layers", expand_layers);
  log.line("  Number of Materials  {}", materials);
}

}  // namespace sculpt
