#include "sculpt/distribute/cartesian.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "sculpt/base/error.hpp"

namespace sculpt {
namespace {

std::int64_t ceiling(std::int64_t a, std::int64_t b) { return (a + b - 1) / b; }

// Smaller is better: area between ranks, largest box, then fewest segments in z, y, x reversed.
using Score = std::tuple<std::int64_t, std::int64_t, std::int64_t, std::int64_t>;

Score score(const Index3& n, const Index3& p) {
  const std::int64_t area = (p[0] - 1) * n[1] * n[2] + (p[1] - 1) * n[0] * n[2] + (p[2] - 1) * n[0] * n[1];
  const std::int64_t largest = ceiling(n[0], p[0]) * ceiling(n[1], p[1]) * ceiling(n[2], p[2]);
  return {area, largest, -p[2], -p[1]};
}

bool best_factors(const Index3& n, std::int64_t ranks, const Index3& user, Index3& best) {
  Score best_score{std::numeric_limits<std::int64_t>::max(), 0, 0, 0};
  bool found = false;
  for (std::int64_t px = 1; px <= std::min(ranks, n[0]); ++px) {
    if (ranks % px != 0 || (user[0] != 0 && px != user[0])) continue;
    for (std::int64_t py = 1; py <= std::min(ranks / px, n[1]); ++py) {
      const std::int64_t pz = ranks / px / py;
      if (ranks / px % py != 0 || pz > n[2] || (user[1] != 0 && py != user[1]) ||
          (user[2] != 0 && pz != user[2]))
        continue;
      const Index3 p{px, py, pz};
      if (!found || score(n, p) < best_score) {
        best = p;
        best_score = score(n, p);
        found = true;
      }
    }
  }
  return found;
}

// The spacing of the doubles around x.
double spacing(double x) { return std::ldexp(1.0, std::ilogb(x) - 52); }

// Makes the local entities of one rank, images included.
class LatticeMaker {
 public:
  LatticeMaker(HexMesh& mesh, const Grid& grid, const CartesianParts& parts, int layers, int ranks)
      : mesh_(mesh), grid_(grid), parts_(parts), ranks_(ranks), ids_(numbered_grid(parts, layers)) {
    for (std::size_t d = 0; d < 3; ++d) {
      if (!parts.periodic[d]) continue;
      any_periodic_ = true;
      shift_[d] = layers;
    }
    set_period(mesh, grid, parts.periodic, layers);
    // On an axis with an odd number of cells the last ones would meet the first in one colour.
    for (std::size_t d = 0; d < 3; ++d) colours_[d] = parts.periodic[d] && parts.cells[d] % 2 != 0 ? 3 : 2;
    mesh.colours = static_cast<int>(colours_[0] * colours_[1] * colours_[2]);
  }

  void add_nodes(const IndexBox& box) {
    const auto count =
        static_cast<std::size_t>((box.extent(0) + 1) * (box.extent(1) + 1) * (box.extent(2) + 1));
    mesh_.position.reserve(count);
    mesh_.node_id.reserve(count);
    mesh_.node_owner.reserve(count);
    mesh_.box_sides.reserve(count);
    mesh_.colour.reserve(count);
    for (std::int64_t k = box.lo[2]; k <= box.hi[2]; ++k)
      for (std::int64_t j = box.lo[1]; j <= box.hi[1]; ++j)
        for (std::int64_t i = box.lo[0]; i <= box.hi[0]; ++i) add_node({i, j, k});
  }

  void add_cells(const IndexBox& box, const IndexBox& owned) {
    const auto count = static_cast<std::size_t>(box.size());
    mesh_.hexes.reserve(count);
    mesh_.hex_id.reserve(count);
    mesh_.hex_owner.reserve(count);
    mesh_.layer.reserve(count);
    for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k)
      for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j)
        for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) add_cell({i, j, k}, box, owned);
  }

 private:
  // Takes the index of an image into the grid.
  [[nodiscard]] Image unwrap(Index3& index) const {
    Image image{0, 0, 0};
    for (std::size_t d = 0; d < 3; ++d) {
      if (!parts_.periodic[d]) continue;
      const std::int64_t n = parts_.cells[d], periods = (index[d] + n * shift_[d]) / n - shift_[d];
      image[d] = static_cast<std::int16_t>(periods);
      index[d] -= n * periods;
    }
    return image;
  }
  [[nodiscard]] GlobalId id(const Index3& index, std::int64_t more) const {
    return index[0] + shift_[0] +
           (ids_[0] + more) * (index[1] + shift_[1] + (ids_[1] + more) * (index[2] + shift_[2]));
  }
  [[nodiscard]] std::int32_t owner(const Index3& cell, const Image& image) const {
    return parts_.owner(cell) + (image == Image{0, 0, 0} ? 0 : ranks_);
  }

  void add_node(const Index3& index) {
    Index3 home = index;
    const Image image = unwrap(home);
    Vec3 p;
    unsigned sides = 0, colour = 0, stride = 1;
    for (std::size_t d = 0; d < 3; ++d) {
      p[d] = grid_.planes[d][static_cast<std::size_t>(home[d])];
      if (!parts_.periodic[d] && home[d] == 0) sides |= 1U << (2 * d);
      if (!parts_.periodic[d] && home[d] == parts_.cells[d]) sides |= 2U << (2 * d);
      const bool last = colours_[d] == 3 && home[d] == parts_.cells[d] - 1;
      colour += stride * (last ? 2U : static_cast<unsigned>(home[d] & 1));
      stride *= colours_[d];
    }
    round_to_quantum(mesh_, p);
    mesh_.node_id.push_back(id(index, 1));
    if (any_periodic_) {
      mesh_.node_home.push_back(id(home, 1));
      mesh_.node_image.push_back(image);
    }
    const auto node = static_cast<LocalId>(mesh_.position.size());
    mesh_.position.push_back(position_of_ghost(mesh_, node, p));
    // Owner of the cell with the smallest id around the node; the domain begins at its low sides.
    for (std::int64_t& i : home) i = std::max<std::int64_t>(i - 1, 0);
    mesh_.node_owner.push_back(owner(home, image));
    mesh_.box_sides.push_back(static_cast<std::uint8_t>(sides));
    mesh_.colour.push_back(static_cast<std::uint8_t>(colour));
  }

  void add_cell(const Index3& index, const IndexBox& box, const IndexBox& owned) {
    const std::int64_t sy = box.extent(0) + 1, sz = sy * (box.extent(1) + 1);
    const std::int64_t first =
        (index[0] - box.lo[0]) + sy * (index[1] - box.lo[1]) + sz * (index[2] - box.lo[2]);
    Hex hex;
    for (std::size_t v = 0; v < 8; ++v)
      hex[v] = static_cast<LocalId>(first + kCornerOffset[v][0] + sy * kCornerOffset[v][1] +
                                    sz * kCornerOffset[v][2]);
    std::int64_t layer = 0;
    for (std::size_t d = 0; d < 3; ++d)
      layer = std::max({layer, owned.lo[d] - index[d], index[d] - owned.hi[d] + 1});
    Index3 home = index;
    const Image image = unwrap(home);
    mesh_.hexes.push_back(hex);
    mesh_.hex_id.push_back(id(index, 0));
    if (any_periodic_) {
      mesh_.hex_home.push_back(id(home, 0));
      mesh_.hex_image.push_back(image);
    }
    mesh_.hex_owner.push_back(owner(home, image));
    mesh_.layer.push_back(static_cast<std::uint8_t>(layer));
  }

  HexMesh& mesh_;
  const Grid& grid_;
  const CartesianParts& parts_;
  int ranks_;
  Index3 ids_;             // cells per axis of the numbering
  Index3 shift_{0, 0, 0};  // of indices in the numbering
  bool any_periodic_ = false;
  std::array<unsigned, 3> colours_{2, 2, 2};  // per axis
};

}  // namespace

void set_period(HexMesh& mesh, const Grid& grid, const std::array<bool, 3>& periodic, int layers) {
  for (std::size_t d = 0; d < 3; ++d) {
    if (!periodic[d]) continue;
    const double lo = grid.planes[d].front(), hi = grid.planes[d].back(),
                 beyond = (layers + 1) * mesh.cell_size[d];
    mesh.period[d] = hi - lo;
    mesh.quantum[d] =
        std::max({spacing(hi - lo), spacing(std::fabs(lo) + beyond), spacing(std::fabs(hi) + beyond)});
  }
}

IndexBox CartesianParts::owned(int rank) const {
  if (rank >= segments[0] * segments[1] * segments[2]) return {};
  const IndexBox all{{0, 0, 0}, segments};
  const Index3 s = all.cell(rank);
  IndexBox box;
  for (std::size_t d = 0; d < 3; ++d) {
    box.lo[d] = cuts[d][static_cast<std::size_t>(s[d])];
    box.hi[d] = cuts[d][static_cast<std::size_t>(s[d] + 1)];
  }
  return box;
}

IndexBox CartesianParts::ghosted(int rank, int layers) const {
  IndexBox box = owned(rank);
  if (box.empty()) return box;
  for (std::size_t d = 0; d < 3; ++d) {
    box.lo[d] -= layers;
    box.hi[d] += layers;
    if (periodic[d]) continue;
    box.lo[d] = std::max<std::int64_t>(box.lo[d], 0);
    box.hi[d] = std::min(box.hi[d], cells[d]);
  }
  return box;
}

int CartesianParts::owner(const Index3& cell) const {
  Index3 s;
  for (std::size_t d = 0; d < 3; ++d)
    s[d] = std::upper_bound(cuts[d].begin(), cuts[d].end(), cell[d]) - cuts[d].begin() - 1;
  return static_cast<int>(s[0] + segments[0] * (s[1] + segments[1] * s[2]));
}

CartesianParts cut_grid(const Index3& cells, int ranks, const Index3& user) {
  CartesianParts parts;
  parts.cells = cells;
  const bool fixed = user[0] != 0 || user[1] != 0 || user[2] != 0;
  bool found = best_factors(cells, ranks, user, parts.segments);
  if (!found && fixed)
    throw Error(fmt::format(
        "iproc, jproc, kproc = {}, {}, {} (0 = free): cannot cut a grid of {} x {} x {} cells into {} "
        "parts; expected factors of the number of ranks, each at most the cells of its axis",
        user[0], user[1], user[2], cells[0], cells[1], cells[2], ranks));
  for (std::int64_t fewer = ranks - 1; !found; --fewer)
    found = best_factors(cells, fewer, user, parts.segments);
  for (std::size_t d = 0; d < 3; ++d)
    for (std::int64_t s = 0; s <= parts.segments[d]; ++s)
      parts.cuts[d].push_back(ceiling(s * cells[d], parts.segments[d]));
  return parts;
}

Index3 numbered_grid(const CartesianParts& parts, int layers) {
  Index3 cells = parts.cells;
  for (std::size_t d = 0; d < 3; ++d)
    if (parts.periodic[d]) cells[d] += 2 * layers;
  return cells;
}

HexMesh lattice_mesh(const Comm& comm, const Grid& grid, const CartesianParts& parts, int layers) {
  HexMesh mesh;
  mesh.cell_size = grid.cell_size();
  mesh.ghost_layers = layers;
  collectively(comm, "building the overlay grid", [&] {
    for (std::size_t d = 0; d < 3; ++d)
      check(!parts.periodic[d] || parts.cells[d] > 1, "a periodic axis with fewer than two cells");
    LatticeMaker maker(mesh, grid, parts, layers, comm.size());
    const IndexBox box = parts.ghosted(comm.rank(), layers);
    if (box.empty()) return;
    if (box.size() > std::numeric_limits<LocalId>::max() / 8)
      throw Error(fmt::format("{} cells on one rank: at most {} fit; use more ranks", box.size(),
                              std::numeric_limits<LocalId>::max() / 8));
    for (std::size_t d = 0; d < 3; ++d) mesh.lattice[d] = static_cast<LocalId>(box.extent(d));
    maker.add_nodes(box);
    maker.add_cells(box, parts.owned(comm.rank()));
  });
  connect_ranks(comm, mesh);
  return mesh;
}

}  // namespace sculpt
