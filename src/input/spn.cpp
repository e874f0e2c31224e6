#include "input/spn.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>

#include "input/deck_grid.hpp"
#include "input/file_order.hpp"
#include "input/material_ids.hpp"
#include "input/number_stream.hpp"
#include "input/summary.hpp"

namespace sculpt {
namespace {

using Stream = NumberStream<IntegerText>;
using Ids = std::vector<std::int32_t>;

struct SpnOptions {
  std::string path;
  FileOrder order;
  bool compress = false;
  std::optional<std::int64_t> void_id;  // of the file: its cells are void
  int expand_layers = 0;
};

AgreedError wrong_count(const SpnOptions& options, std::int64_t found) {
  const auto& [nx, ny, nz] = options.order.cells;
  return AgreedError(fmt::format("{}: found {} integers, expected nelx x nely x nelz = {} x {} x {} = {}",
                                 options.path, found, nx, ny, nz, nx * ny * nz));
}

// The cells of one rank's box, filled from the rows of the file in any order.
class BoxIds {
 public:
  BoxIds(const FileOrder& order, const IndexBox& box, Ids& ids) : order_(order), box_(box), ids_(ids) {
    const std::array<std::int64_t, 3> strides{1, box.extent(0), box.extent(0) * box.extent(1)};
    stride_ = strides[order.axes[2]];
  }
  // Takes from the numbers [first, first + count) of the file those that lie in the box.
  void take(std::int64_t first, std::span<const std::int32_t> numbers) {
    rows_.clear();
    order_.for_each_row(box_, first, static_cast<std::int64_t>(numbers.size()),
                        [&](std::int64_t at, std::int64_t count, const Index3& cell) {
                          rows_.push_back({at, count, cell});
                        });
    put_rows(numbers);
  }
  // The same when only the numbers in the box were sent, one row after the other.
  void take_packed(std::int64_t first, std::int64_t count, std::span<const std::int32_t> packed) {
    rows_.clear();
    std::int64_t used = 0;
    order_.for_each_row(box_, first, count, [&](std::int64_t, std::int64_t length, const Index3& cell) {
      rows_.push_back({used, length, cell});
      used += length;
    });
    check(used == static_cast<std::int64_t>(packed.size()), "spn: a rank sent other cells than wanted");
    put_rows(packed);
  }

 private:
  struct Row {
    std::int64_t at, count;  // in the numbers
    Index3 cell;             // the first cell
  };

  void put_rows(std::span<const std::int32_t> numbers) {
    // With x in the outermost loop, neighbours in memory are a whole plane of the file apart: going through
    // the planes side by side writes each cache line once instead of once per plane.
    if (order_.axes[0] == 0) {
      const std::size_t middle = order_.axes[1];
      std::stable_sort(rows_.begin(), rows_.end(),
                       [middle](const Row& a, const Row& b) { return a.cell[middle] < b.cell[middle]; });
    }
    for (const Row& row : rows_) {
      std::int32_t* to = ids_.data() + box_.position(row.cell);
      const std::int32_t* const from = numbers.data() + row.at;
      for (std::int64_t i = 0; i < row.count; ++i, to += stride_) *to = from[i];
    }
  }

  const FileOrder& order_;
  const IndexBox& box_;
  Ids& ids_;
  std::vector<Row> rows_;
  std::int64_t stride_ = 1;
};

class SpnSource final : public MaterialSource {
 public:
  SpnSource(SpnOptions options, TextFile file, std::int64_t size, const Log& log)
      : options_(std::move(options)), file_(std::move(file)), size_(size), log_(log) {
    grid_ = uniform_grid(options_.order.cells, {0, 0, 0}, {1, 1, 1});
  }

  [[nodiscard]] const Grid& grid() const override { return grid_; }

  [[nodiscard]] MaterialData read(const Comm& comm, std::span<const IndexBox> wanted) override {
    const IndexBox& mine = wanted[static_cast<std::size_t>(comm.rank())];
    MaterialData data;
    Fractions& fractions = data.fractions;
    collectively(comm, "reading " + options_.path, [&] {
      const auto cells = static_cast<std::size_t>(mine.size());
      fractions.material.resize(cells);  // holds the ids of the file until all of them are known
      fractions.value.assign(cells, 1.0);
      fractions.offset.resize(cells + 1);
      std::iota(fractions.offset.begin(), fractions.offset.end(), std::int64_t{0});
    });
    const std::vector<std::int64_t> known = read_ids(comm, wanted, fractions.material);
    data.table = table_of(known);
    make_dense(known, fractions.material);
    print_voxel_summary(log_, "spn", options_.path, grid_, options_.expand_layers, known.size());
    return data;
  }

 private:
  // The ids of my box in `ids`; returns the ids of the whole file, ascending.
  [[nodiscard]] std::vector<std::int64_t> read_ids(const Comm& comm, std::span<const IndexBox> wanted,
                                                   Ids& ids) const {
    const auto me = static_cast<std::size_t>(comm.rank());
    BoxIds box(options_.order, wanted[me], ids);
    IdSet seen;
    Stream stream(comm, file_, 0, size_);
    while (stream.next(comm)) {
      const auto numbers = stream.values().first(in_grid(stream, me));
      seen.insert(numbers);
      box.take(stream.firsts()[me], numbers);
      if (comm.size() > 1) exchange(comm, wanted, stream, box);
    }
    if (stream.total() != grid_.cell_count()) throw wrong_count(options_, stream.total());
    Ids all = comm.concatenate(seen.sorted());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return {all.begin(), all.end()};
  }

  // How many of rank r's numbers of this round belong to cells; the file may hold too many.
  [[nodiscard]] std::size_t in_grid(const Stream& stream, std::size_t r) const {
    const std::int64_t room = std::max<std::int64_t>(0, grid_.cell_count() - stream.firsts()[r]);
    return static_cast<std::size_t>(std::min(stream.counts()[r], room));
  }

  // Collective. Each rank sends the others the part of its numbers that they want, rows only.
  void exchange(const Comm& comm, std::span<const IndexBox> wanted, const Stream& stream, BoxIds& box) const {
    const auto ranks = static_cast<std::size_t>(comm.size()), me = static_cast<std::size_t>(comm.rank());
    const auto numbers = stream.values().first(in_grid(stream, me));
    std::vector<Ids> to(ranks);
    for (std::size_t r = 0; r < ranks; ++r) {
      if (r == me) continue;
      options_.order.for_each_row(wanted[r], stream.firsts()[me], static_cast<std::int64_t>(numbers.size()),
                                  [&](std::int64_t at, std::int64_t count, const Index3&) {
                                    to[r].insert(to[r].end(), numbers.begin() + at,
                                                 numbers.begin() + at + count);
                                  });
    }
    const std::vector<Ids> from = comm.all_to_all(to);
    for (std::size_t r = 0; r < ranks; ++r)
      if (r != me)
        box.take_packed(stream.firsts()[r], static_cast<std::int64_t>(in_grid(stream, r)), from[r]);
  }

  [[nodiscard]] MaterialTable table_of(const std::vector<std::int64_t>& known) const {
    MaterialTable table;
    table.block_id = known;
    if (options_.compress) std::iota(table.block_id.begin(), table.block_id.end(), std::int64_t{1});
    if (options_.void_id) {
      const auto at = std::lower_bound(known.begin(), known.end(), *options_.void_id);
      if (at != known.end() && *at == *options_.void_id)
        table.void_material = static_cast<std::int32_t>(at - known.begin());
    }
    return table;
  }

  SpnOptions options_;
  TextFile file_;
  std::int64_t size_;
  Log log_;
  Grid grid_;
};

SpnOptions spn_options(const Deck& deck) {
  constexpr std::array<std::array<std::size_t, 3>, 6> kAxes{
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  SpnOptions options;
  options.path = deck.input_spn;
  options.order.cells = deck_intervals(deck, "input_spn");
  if (deck.spn_xyz_order < kSpnXyz || deck.spn_xyz_order > kSpnZyx)
    throw Error(fmt::format("spn_xyz_order = {}: expected 0 to 5", deck.spn_xyz_order));
  options.order.axes = kAxes[static_cast<std::size_t>(deck.spn_xyz_order)];
  options.compress = deck.compress_spn_ids;
  if (deck.given("void_mat") && !deck.mesh_void) options.void_id = deck.void_mat;
  options.expand_layers = deck.micro_expand;
  return options;
}

}  // namespace

std::unique_ptr<MaterialSource> open_spn(const Comm& comm, const Deck& deck, const Log& log) {
  SpnOptions options;
  std::optional<TextFile> file;
  collectively(comm, "opening " + deck.input_spn, [&] {
    options = spn_options(deck);
    file.emplace(options.path, "input_spn");
  });
  const std::int64_t size = comm.min(file->size());
  // A cell takes two characters at least. Say so before anyone allocates a grid that the file cannot fill.
  if (const auto& [nx, ny, nz] = options.order.cells; nx * ny * nz > (size + 1) / 2) {
    Stream stream(comm, *file, 0, size);
    while (stream.next(comm)) {
    }
    throw wrong_count(options, stream.total());
  }
  return std::make_unique<SpnSource>(std::move(options), std::move(*file), size, log);
}

}  // namespace sculpt
