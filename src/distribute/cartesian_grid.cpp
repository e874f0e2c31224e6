#include "sculpt/distribute/cartesian_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "distribute/id_index.hpp"
#include "sculpt/base/even_parts.hpp"
#include "sculpt/geom/hex.hpp"
#include "sculpt/mesh/node_directory.hpp"

namespace sculpt {
namespace {

constexpr double kTolerance = 1e-9;  // of the spacing

struct Box {
  Vec3 lo, hi;
};

// Collective. Of points of all ranks; hi < lo when there are none.
Box box_of(const Comm& comm, std::span<const Vec3> points) {
  constexpr double kMost = std::numeric_limits<double>::max();
  Box box{{kMost, kMost, kMost}, {-kMost, -kMost, -kMost}};
  for (const Vec3& p : points)
    for (std::size_t d = 0; d < 3; ++d) {
      box.lo[d] = std::min(box.lo[d], p[d]);
      box.hi[d] = std::max(box.hi[d], p[d]);
    }
  for (std::size_t d = 0; d < 3; ++d) {
    box.lo[d] = comm.min(box.lo[d]);
    box.hi[d] = comm.max(box.hi[d]);
  }
  return box;
}

// Collective. The box of the element number 0.
Box first_element_box(const Comm& comm, const ElementShare& share) {
  std::array<std::int64_t, 8> corner{0, 0, 0, 0, 0, 0, 0, 0};
  if (!share.element.empty() && share.element[0] == 0)
    std::copy(share.corner[0].begin(), share.corner[0].end(), corner.begin());
  comm.sum(corner);
  std::vector<Vec3> points;
  for (const GlobalId node : corner) {
    const auto found = std::lower_bound(share.node.begin(), share.node.end(), node);
    if (found != share.node.end() && *found == node)
      points.push_back(share.position[static_cast<std::size_t>(found - share.node.begin())]);
  }
  return box_of(comm, points);
}

// The only grid that the mesh can be, by its box, one element and the numbers of elements and nodes.
std::optional<Grid> candidate(const Comm& comm, const ElementShare& share) {
  if (share.elements == 0) return {};
  const Box all = box_of(comm, share.position), one = first_element_box(comm, share);
  Index3 cells;
  double volume = 1, corners = 1;  // in doubles: no overflow
  for (std::size_t d = 0; d < 3; ++d) {
    const double spacing = one.hi[d] - one.lo[d], count = std::round((all.hi[d] - all.lo[d]) / spacing);
    if (!(spacing > 0) || !(count >= 1) || !(count <= static_cast<double>(share.elements))) return {};
    cells[d] = static_cast<std::int64_t>(count);
    volume *= count;
    corners *= count + 1;
  }
  if (volume != static_cast<double>(share.elements) || corners != static_cast<double>(share.nodes)) return {};
  return box_grid(cells, all.lo, all.hi);
}

// From places to the indices of planes.
class Planes {
 public:
  explicit Planes(const Grid& grid) : grid_(grid), size_(grid.cell_size()) {
    for (std::size_t d = 0; d < 3; ++d) {
      const double greatest = std::max(std::fabs(grid.planes[d].front()), std::fabs(grid.planes[d].back()));
      slack_[d] = std::max(kTolerance * size_[d], 4 * std::numeric_limits<double>::epsilon() * greatest);
    }
  }
  [[nodiscard]] bool find(const Vec3& p, Index3& index) const {
    for (std::size_t d = 0; d < 3; ++d) {
      const double i = std::round((p[d] - grid_.planes[d].front()) / size_[d]);
      if (!(i >= 0) || !(i <= static_cast<double>(grid_.cells[d]))) return false;
      index[d] = static_cast<std::int64_t>(i);
      if (!(std::fabs(p[d] - grid_.planes[d][static_cast<std::size_t>(index[d])]) <= slack_[d])) return false;
    }
    return true;
  }

 private:
  const Grid& grid_;
  Vec3 size_, slack_;
};

// The cell with these corners in one of the right-handed orders, or -1.
GlobalId cell_of(const Grid& grid, const std::array<Index3, 8>& corner) {
  Index3 low = corner[0];
  for (const Index3& c : corner)
    for (std::size_t d = 0; d < 3; ++d) low[d] = std::min(low[d], c[d]);
  Index3 edge[3];  // from corner 0 along the axes of the element
  const std::size_t ends[3] = {1, 3, 4};
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t d = 0; d < 3; ++d) edge[a][d] = corner[ends[a]][d] - corner[0][d];
  for (const Index3& e : edge)
    if (std::abs(e[0]) + std::abs(e[1]) + std::abs(e[2]) != 1) return -1;
  const std::int64_t handed = edge[0][0] * (edge[1][1] * edge[2][2] - edge[1][2] * edge[2][1]) +
                              edge[0][1] * (edge[1][2] * edge[2][0] - edge[1][0] * edge[2][2]) +
                              edge[0][2] * (edge[1][0] * edge[2][1] - edge[1][1] * edge[2][0]);
  if (handed != 1) return -1;
  for (std::size_t v = 0; v < 8; ++v)
    for (std::size_t d = 0; d < 3; ++d)
      if (corner[v][d] != corner[0][d] + kCornerOffset[v][0] * edge[0][d] + kCornerOffset[v][1] * edge[1][d] +
                              kCornerOffset[v][2] * edge[2][d])
        return -1;
  return grid.cell_id(low);
}

// Collective. Whether no cell occurs twice.
bool all_differ(const Comm& comm, const Grid& grid, std::span<const GlobalId> cells) {
  const EvenParts ranges{grid.cell_count(), comm.size()};
  std::vector<std::vector<GlobalId>> out(static_cast<std::size_t>(comm.size()));
  for (const GlobalId cell : cells) out[ranges.part_of(cell)].push_back(cell);
  std::vector<std::uint8_t> seen(ranges.size(comm.rank()), 0);
  std::int64_t good = 1;
  for (const auto& from : comm.all_to_all(out))
    for (const GlobalId cell : from) {
      std::uint8_t& s = seen[static_cast<std::size_t>(cell - ranges.begin(comm.rank()))];
      if (s != 0) good = 0;
      s = 1;
    }
  return comm.min(good) != 0;
}

}  // namespace

std::optional<CartesianShare> cartesian_grid_of(const Comm& comm, const ElementShare& share) {
  const std::optional<Grid> grid = candidate(comm, share);
  if (!grid) return {};
  const Planes planes(*grid);
  Index3 index;
  std::int64_t good = 1;
  for (const Vec3& p : share.position)
    if (!planes.find(p, index)) {
      good = 0;
      break;
    }
  if (comm.min(good) == 0) return {};

  CartesianShare result{*grid, {}};
  const IdIndex nodes(share.corner);
  std::vector<Index3> place;
  for (const Vec3& p : positions_of(comm, share, nodes.ids())) {
    if (!planes.find(p, index)) index = {0, 0, 0};  // never: it did above
    place.push_back(index);
  }
  for (const auto& corner : share.corner) {
    std::array<Index3, 8> corners;
    for (std::size_t v = 0; v < 8; ++v) corners[v] = place[at(nodes.index(corner[v]))];
    result.cell.push_back(cell_of(*grid, corners));
    if (result.cell.back() < 0) {
      good = 0;
      break;
    }
  }
  // As many elements as cells, so all cells are there; their corners are all places, and there are no more
  // nodes than places, so no two nodes share one.
  if (comm.min(good) == 0 || !all_differ(comm, *grid, result.cell)) return {};
  return result;
}

}  // namespace sculpt
