#include "input/cart_exo.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "sculpt/exo/read_exodus.hpp"

namespace sculpt {
namespace {

using Ids = std::vector<std::int32_t>;

constexpr std::int32_t kUnset = -1;

// What the file says: the grid by its corners, and the dense material of each cell, x fastest.
struct CartesianFile {
  Index3 cells{0, 0, 0};
  Vec3 lo, hi;
  std::vector<std::int64_t> block_id;  // ascending
  Ids material;
};

std::string text(const Vec3& p) { return fmt::format("({}, {}, {})", p.x, p.y, p.z); }
std::string text(const Index3& c) { return fmt::format("({}, {}, {})", c[0], c[1], c[2]); }

// Recognises the grid in two passes over the hexes: the first finds the corners of the grid and the size of a
// cell, the second gives each hex its cell.
class GridReader {
 public:
  explicit GridReader(const std::string& path) : reader_(path), path_(path) {
    const auto& blocks = reader_.header().blocks;
    std::int64_t element = 1;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      if (blocks[b].count > 0 && !is_hex(blocks[b]))
        throw Error(fmt::format("'{}', block {}: elements of type {} with {} nodes, expected HEX8", path_,
                                blocks[b].id, blocks[b].type, blocks[b].nodes_per_element));
      if (blocks[b].count > 0) parts_.push_back({b, blocks[b].id, element});
      element += blocks[b].count;
    }
    if (parts_.empty()) throw Error(fmt::format("'{}' has no hexes", path_));
    if (const auto first = std::min_element(parts_.begin(), parts_.end(), by_id); first->id < 0)
      throw Error(fmt::format("'{}', block {}: expected block ids of 0 and up, as they are material ids",
                              path_, first->id));
    reader_.coordinates(x_, y_, z_);
  }

  CartesianFile read() {
    measure();
    count_cells();
    place_nodes();
    fill_cells();
    return std::move(file_);
  }

 private:
  // A block with hexes.
  struct Part {
    std::size_t index;  // in the file
    std::int64_t id;
    std::int64_t first_element;  // from 1, as the user counts
  };
  static bool by_id(const Part& a, const Part& b) { return a.id < b.id; }

  [[nodiscard]] Vec3 node(std::int32_t n) const {
    const auto at = static_cast<std::size_t>(n - 1);
    return {x_[at], y_[at], z_[at]};
  }
  [[noreturn]] void not_a_grid(const Part& part, std::size_t hex, const std::string& why) const {
    throw Error(fmt::format("'{}' is not a regular Cartesian grid: element {} (block {}) {}", path_,
                            part.first_element + static_cast<std::int64_t>(hex), part.id, why));
  }

  // Bounds of the nodes in use; size of the first hex.
  void measure() {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    file_.lo = {kFar, kFar, kFar};
    file_.hi = {-kFar, -kFar, -kFar};
    for (const Part& part : parts_) {
      const Ids nodes = reader_.connectivity(part.index);
      for (std::size_t n = 0; n < nodes.size(); ++n) {
        const Vec3 p = node(nodes[n]);
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
          not_a_grid(part, n / 8, "has a corner at " + text(p));
        for (std::size_t d = 0; d < 3; ++d) {
          file_.lo[d] = std::min(file_.lo[d], p[d]);
          file_.hi[d] = std::max(file_.hi[d], p[d]);
        }
        if (&part == &parts_.front() && n == 7) cell_ = file_.hi - file_.lo;
      }
    }
  }

  void count_cells() {
    double cells = 1;
    for (std::size_t d = 0; d < 3; ++d) {
      if (cell_[d] <= 0) not_a_grid(parts_.front(), 0, "is flat");
      const double n = std::round((file_.hi[d] - file_.lo[d]) / cell_[d]);
      cells *= n;
      constexpr double kMostPlanes = std::numeric_limits<std::int32_t>::max();
      if (n >= kMostPlanes)
        cells = std::numeric_limits<double>::infinity();
      else
        file_.cells[d] = static_cast<std::int64_t>(n);
    }
    const std::int64_t elements = reader_.header().elements;
    if (cells > 8.0 * static_cast<double>(elements))
      throw Error(fmt::format(
          "'{}' is not a full Cartesian grid: its first hex measures {}, so that its box {} to {} "
          "has room for {:.0f} cells, but there are {} hexes",
          path_, text(cell_), text(file_.lo), text(file_.hi), cells, elements));
    for (std::size_t d = 0; d < 3; ++d)
      cell_[d] = (file_.hi[d] - file_.lo[d]) / static_cast<double>(file_.cells[d]);
  }

  // The grid plane of each node per axis. A node may be off by a millionth of a cell, or by what single
  // precision makes of its coordinate; if it is off by more, or outside, it gets no plane.
  void place_nodes() {
    constexpr double kSinglePrecision = 1.0 / (1 << 22);
    const std::array<const std::vector<double>*, 3> axes{&x_, &y_, &z_};
    for (std::size_t d = 0; d < 3; ++d) {
      const std::vector<double>& at = *axes[d];
      const double largest = std::max(std::fabs(file_.lo[d]), std::fabs(file_.hi[d]));
      const double tolerance = std::min(1e-6 * cell_[d] + kSinglePrecision * largest, 0.01 * cell_[d]);
      plane_[d].resize(at.size());
      for (std::size_t n = 0; n < at.size(); ++n) {
        const double i = std::round((at[n] - file_.lo[d]) / cell_[d]);
        const bool on_plane = i >= 0 && i <= static_cast<double>(file_.cells[d]) &&
                              std::fabs(file_.lo[d] + i * cell_[d] - at[n]) <= tolerance;
        plane_[d][n] = on_plane ? static_cast<std::int32_t>(i) : kUnset;
      }
    }
  }

  void fill_cells() {
    std::vector<Part> ordered = parts_;
    std::sort(ordered.begin(), ordered.end(), by_id);
    const IndexBox box = whole(file_.cells);
    file_.material.assign(static_cast<std::size_t>(box.size()), kUnset);
    for (const Part& part : ordered) {
      const auto material = static_cast<std::int32_t>(file_.block_id.size());
      file_.block_id.push_back(part.id);
      const Ids nodes = reader_.connectivity(part.index);
      for (std::size_t hex = 0; hex < nodes.size() / 8; ++hex) {
        const Index3 cell = cell_of(part, hex, std::span(nodes).subspan(8 * hex, 8));
        std::int32_t& place = file_.material[static_cast<std::size_t>(box.position(cell))];
        if (place != kUnset) not_a_grid(part, hex, "fills cell " + text(cell) + ", as another element does");
        place = material;
      }
    }
    const auto missing = std::find(file_.material.begin(), file_.material.end(), kUnset);
    if (missing == file_.material.end()) return;
    const Index3 cell = box.cell(missing - file_.material.begin());
    Vec3 centre;
    for (std::size_t d = 0; d < 3; ++d)
      centre[d] = file_.lo[d] + (static_cast<double>(cell[d]) + 0.5) * cell_[d];
    throw Error(fmt::format(
        "'{}' is not a full Cartesian grid: no element fills cell {} around {}; found {} elements, "
        "expected {} x {} x {} = {}",
        path_, text(cell), text(centre), reader_.header().elements, file_.cells[0], file_.cells[1],
        file_.cells[2], box.size()));
  }

  // The cell whose eight corners are these nodes, in whatever order.
  Index3 cell_of(const Part& part, std::size_t hex, std::span<const std::int32_t> nodes) const {
    std::array<std::int32_t, 3> low{};
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = plane_[d][static_cast<std::size_t>(nodes[0] - 1)];
      for (const std::int32_t n : nodes) {
        const std::int32_t plane = plane_[d][static_cast<std::size_t>(n - 1)];
        if (plane == kUnset)
          not_a_grid(part, hex,
                     "has a corner at " + text(node(n)) + ", off the planes of the grid of cells " +
                         text(cell_) + " that begins at " + text(file_.lo));
        low[d] = std::min(low[d], plane);
      }
    }
    unsigned corners = 0;
    for (const std::int32_t n : nodes) {
      unsigned corner = 0;
      for (std::size_t d = 0; d < 3; ++d) {
        const std::int32_t plane = plane_[d][static_cast<std::size_t>(n - 1)];
        if (plane > low[d] + 1)
          not_a_grid(part, hex, "is longer than one cell " + text(cell_) + "; corner at " + text(node(n)));
        corner |= static_cast<unsigned>(plane - low[d]) << d;
      }
      corners |= 1U << corner;
    }
    if (corners != 0xFF) not_a_grid(part, hex, "does not have eight different corners");
    return {low[0], low[1], low[2]};
  }

  ExodusReader reader_;
  const std::string& path_;
  std::vector<Part> parts_;
  std::vector<double> x_, y_, z_;
  std::array<Ids, 3> plane_;
  Vec3 cell_;
  CartesianFile file_;
};

class CartExoSource final : public MaterialSource {
 public:
  CartExoSource(std::string path, Grid grid, MaterialTable table, Ids material, const Log& log)
      : path_(std::move(path)),
        grid_(std::move(grid)),
        table_(std::move(table)),
        material_(std::move(material)),
        log_(log) {}

  [[nodiscard]] const Grid& grid() const override { return grid_; }

  [[nodiscard]] MaterialData read(const Comm& comm, std::span<const IndexBox> wanted) override {
    const IndexBox& mine = wanted[static_cast<std::size_t>(comm.rank())];
    MaterialData data;
    Fractions& fractions = data.fractions;
    collectively(comm, "distributing " + path_, [&] {
      const auto cells = static_cast<std::size_t>(mine.size());
      fractions.material.resize(cells);
      fractions.value.assign(cells, 1.0);
      fractions.offset.resize(cells + 1);
      std::iota(fractions.offset.begin(), fractions.offset.end(), std::int64_t{0});
    });
    for (std::int64_t k = 0; k < grid_.cells[2];) {
      const IndexBox slab = next_slab(wanted, k);
      hand_out(comm, wanted, slab, fractions.material);
      k = slab.hi[2];
    }
    data.table = table_;
    print_summary();
    return data;
  }

 private:
  // Layers from k on, as many as may travel at once.
  [[nodiscard]] IndexBox next_slab(std::span<const IndexBox> wanted, std::int64_t k) const {
    constexpr std::int64_t kCellsAtOnce = std::int64_t{1} << 24;
    IndexBox slab = whole(grid_.cells);
    slab.lo[2] = k;
    std::int64_t travelling = 0;
    for (slab.hi[2] = k; slab.hi[2] < grid_.cells[2]; ++slab.hi[2]) {
      for (const IndexBox& box : wanted)
        if (slab.hi[2] >= box.lo[2] && slab.hi[2] < box.hi[2]) travelling += box.extent(0) * box.extent(1);
      if (travelling > kCellsAtOnce && slab.hi[2] > k) break;
    }
    return slab;
  }

  // Collective. Rank 0 sends each rank the cells of the slab that it wants.
  void hand_out(const Comm& comm, std::span<const IndexBox> wanted, const IndexBox& slab,
                Ids& materials) const {
    std::vector<Ids> to(wanted.size());
    for (std::size_t r = 0; comm.rank() == 0 && r < wanted.size(); ++r) {
      const IndexBox part = intersection(wanted[r], slab);
      to[r].reserve(static_cast<std::size_t>(part.size()));
      for_each_row(part, [&](const Index3& cell, std::int64_t length) {
        const auto from = material_.begin() + grid_.cell_id(cell);
        to[r].insert(to[r].end(), from, from + length);
      });
    }
    const std::vector<Ids> arrived = comm.all_to_all(to);
    const IndexBox& mine = wanted[static_cast<std::size_t>(comm.rank())];
    const IndexBox part = intersection(mine, slab);
    check(static_cast<std::int64_t>(arrived[0].size()) == part.size(),
          "input_cart_exo: cells lost on the way");
    auto next = arrived[0].begin();
    for_each_row(part, [&](const Index3& cell, std::int64_t length) {
      std::copy(next, next + length, materials.begin() + mine.position(cell));
      next += length;
    });
  }

  template <class Row>
  static void for_each_row(const IndexBox& box, const Row& row) {
    if (box.empty()) return;
    for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k)
      for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) row(Index3{box.lo[0], j, k}, box.extent(0));
  }

  void print_summary() const {
    const auto& [x, y, z] = grid_.planes;
    log_.line("Summary of imported Cartesian exodus file grid parameters");
    log_.line("  File Name            {}", path_);
    log_.line("  Intervals            {} {} {}", grid_.cells[0], grid_.cells[1], grid_.cells[2]);
    log_.line("  Grid Bounds Min      {:f} {:f} {:f}", x.front(), y.front(), z.front());
    log_.line("  Grid Bounds Max      {:f} {:f} {:f}", x.back(), y.back(), z.back());
    log_.line("  Number of Materials  {}", table_.block_id.size());
  }

  std::string path_;
  Grid grid_;
  MaterialTable table_;
  Ids material_;  // of all cells, on rank 0 only
  Log log_;
};

}  // namespace

std::unique_ptr<MaterialSource> open_cart_exo(const Comm& comm, const Deck& deck, const Log& log) {
  const std::string& path = deck.input_cart_exo;
  CartesianFile file;
  collectively(comm, "reading " + path, [&] {
    if (comm.rank() == 0) file = GridReader(path).read();
  });
  std::vector<std::int64_t> cells(file.cells.begin(), file.cells.end());
  std::vector<Vec3> corners{file.lo, file.hi};
  comm.broadcast(cells, 0);
  comm.broadcast(corners, 0);
  comm.broadcast(file.block_id, 0);
  MaterialTable table;
  table.block_id = file.block_id;
  if (deck.given("void_mat") && !deck.mesh_void) {  // without mesh_void it names the material to leave out
    const auto at = std::lower_bound(table.block_id.begin(), table.block_id.end(), deck.void_mat);
    if (at != table.block_id.end() && *at == deck.void_mat)
      table.void_material = static_cast<std::int32_t>(at - table.block_id.begin());
  }
  Grid grid = box_grid({cells[0], cells[1], cells[2]}, corners[0], corners[1]);
  return std::make_unique<CartExoSource>(path, std::move(grid), std::move(table), std::move(file.material),
                                         log);
}

}  // namespace sculpt
