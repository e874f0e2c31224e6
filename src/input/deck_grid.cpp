#include "input/deck_grid.hpp"

#include <fmt/core.h>

#include <limits>

#include "sculpt/base/error.hpp"

namespace sculpt {
namespace {

constexpr std::array<const char*, 3> kCountNames{"nelx", "nely", "nelz"};
constexpr std::array<const char*, 3> kLowNames{"xmin", "ymin", "zmin"};
constexpr std::array<const char*, 3> kHighNames{"xmax", "ymax", "zmax"};

Vec3 low_corner(const Deck& deck) { return {deck.xmin, deck.ymin, deck.zmin}; }
Vec3 high_corner(const Deck& deck) { return {deck.xmax, deck.ymax, deck.zmax}; }

}  // namespace

Index3 deck_intervals(const Deck& deck, const std::string& option) {
  const Index3 cells{deck.nelx, deck.nely, deck.nelz};
  std::int64_t room = std::numeric_limits<std::int64_t>::max() / 8;  // nodes and faces are numbered too
  for (std::size_t d = 0; d < 3; ++d) {
    if (cells[d] < 1)
      throw Error(fmt::format("{} needs {}, found {}, expected a number of cells >= 1", option,
                              kCountNames[d],
                              deck.given(kCountNames[d]) ? std::to_string(cells[d]) : "none"));
    room /= cells[d];
  }
  if (room == 0)
    throw Error(fmt::format("nelx x nely x nelz = {} x {} x {}: more cells than can be numbered", cells[0],
                            cells[1], cells[2]));
  return cells;
}

IndexBox deck_clip(const Deck& deck, const Grid& grid, const std::string& path) {
  const Vec3 lo = low_corner(deck), hi = high_corner(deck);
  IndexBox clip;
  for (std::size_t d = 0; d < 3; ++d) {
    const bool has_lo = deck.given(kLowNames[d]), has_hi = deck.given(kHighNames[d]);
    const std::vector<double>& planes = grid.planes[d];
    const auto inside = [&](std::int64_t i) {
      const auto at = static_cast<std::size_t>(i);
      const double centre = 0.5 * (planes[at] + planes[at + 1]);
      return (!has_lo || centre >= lo[d]) && (!has_hi || centre <= hi[d]);
    };
    while (clip.lo[d] < grid.cells[d] && !inside(clip.lo[d])) ++clip.lo[d];
    clip.hi[d] = clip.lo[d];
    while (clip.hi[d] < grid.cells[d] && inside(clip.hi[d])) ++clip.hi[d];
    if (clip.extent(d) > 0) continue;
    throw Error(
        fmt::format("{}: no cell is left: {} = {}, {} = {}, but the centres of the cells lie from {} to {}",
                    path, kLowNames[d], has_lo ? fmt::format("{}", lo[d]) : "none", kHighNames[d],
                    has_hi ? fmt::format("{}", hi[d]) : "none", 0.5 * (planes[0] + planes[1]),
                    0.5 * (planes[planes.size() - 2] + planes.back())));
  }
  return clip;
}

Grid part_of(const Grid& grid, const IndexBox& box) {
  Grid part;
  for (std::size_t d = 0; d < 3; ++d) {
    part.cells[d] = box.extent(d);
    part.planes[d].assign(grid.planes[d].begin() + box.lo[d], grid.planes[d].begin() + box.hi[d] + 1);
  }
  return part;
}

}  // namespace sculpt
