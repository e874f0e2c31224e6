#include "input/micro.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "input/deck_grid.hpp"
#include "input/micro_rows.hpp"
#include "input/number_stream.hpp"
#include "input/summary.hpp"
#include "input/tec_header.hpp"

namespace sculpt {
namespace {

using Stream = NumberStream<RealText>;

// What is known of the file before its rows are read; the same on every rank.
struct MicroLayout {
  std::int64_t size = 0;        // bytes of the file
  std::int64_t data_begin = 0;  // byte at which the rows start
  std::int64_t row_length = 0;  // numbers per row
  CentroidGrid centroids;

  [[nodiscard]] std::size_t materials() const { return static_cast<std::size_t>(row_length - 3); }
  [[nodiscard]] std::int64_t numbers() const {
    return centroids.cells[0] * centroids.cells[1] * centroids.cells[2] * row_length;
  }
};

AgreedError wrong_count(const std::string& path, const MicroLayout& layout, std::int64_t found) {
  const auto& [nx, ny, nz] = layout.centroids.cells;
  return AgreedError(
      fmt::format("{}: found {} numbers ({} rows of {}), expected I x J x K = {} x {} x {} = {} rows", path,
                  found, found / layout.row_length, layout.row_length, nx, ny, nz, nx * ny * nz));
}

class MicroSource final : public MaterialSource {
 public:
  MicroSource(TextFile file, const MicroLayout& layout, Grid grid, const IndexBox& clip, int expand,
              const Log& log)
      : file_(std::move(file)),
        layout_(layout),
        grid_(std::move(grid)),
        clip_(clip),
        expand_layers_(expand),
        log_(log) {}

  [[nodiscard]] const Grid& grid() const override { return grid_; }

  [[nodiscard]] MaterialData read(const Comm& comm, std::span<const IndexBox> wanted) override {
    const auto me = static_cast<std::size_t>(comm.rank());
    std::vector<FractionEntry> entries;
    MicroRows rows;
    Stream stream(comm, file_, layout_.data_begin, layout_.size);
    while (stream.next(comm)) {
      collectively(comm, "reading " + file_.path(), [&] { take_rows(stream, me, rows); });
      exchange(comm, wanted, rows, entries);
    }
    if (stream.total() != layout_.numbers()) throw wrong_count(file_.path(), layout_, stream.total());
    MaterialData data;
    collectively(comm, "reading " + file_.path(),
                 [&] { data.fractions = assemble(wanted[me], entries, clip_.lo, file_.path()); });
    data.table.block_id.resize(layout_.materials());
    std::iota(data.table.block_id.begin(), data.table.block_id.end(), std::int64_t{1});
    print_voxel_summary(log_, "micro", file_.path(), grid_, expand_layers_, layout_.materials());
    return data;
  }

 private:
  // The rows that start among my numbers of this round.
  void take_rows(const Stream& stream, std::size_t me, MicroRows& rows) const {
    rows.clear();
    const std::int64_t length = layout_.row_length, first = stream.firsts()[me];
    const std::span<const double> values = stream.values();
    const auto count = static_cast<std::int64_t>(values.size());
    for (std::int64_t at = (length - first % length) % length; at < count && first + at < layout_.numbers();
         at += length) {
      std::string defect;
      if (at + length <= count) {
        defect = rows.add(values.subspan(static_cast<std::size_t>(at), static_cast<std::size_t>(length)),
                          layout_.centroids);
      } else {
        std::vector<double> row(values.begin() + at, values.end());
        const std::vector<double> rest = stream.following(at + length - count);
        row.insert(row.end(), rest.begin(), rest.end());
        if (row.size() < static_cast<std::size_t>(length)) return;  // the file ends here: the count will tell
        defect = rows.add(row, layout_.centroids);
      }
      if (!defect.empty()) throw Error(file_.place(stream.offset_of(at)) + defect);
    }
  }

  // Collective. Sends each rank the rows of its box; those of mine are appended to `entries`.
  void exchange(const Comm& comm, std::span<const IndexBox> wanted, const MicroRows& rows,
                std::vector<FractionEntry>& entries) const {
    const auto me = static_cast<std::size_t>(comm.rank());
    const Index3& shift = clip_.lo;
    IndexBox bounds = rows.bounds();
    for (std::size_t d = 0; d < 3; ++d) {
      bounds.lo[d] -= shift[d];
      bounds.hi[d] -= shift[d];
    }
    std::vector<std::vector<FractionEntry>> to(wanted.size());
    for (std::size_t r = 0; r < wanted.size(); ++r)
      if (!intersection(bounds, wanted[r]).empty()) rows.select(wanted[r], shift, r == me ? entries : to[r]);
    if (comm.size() == 1) return;
    for (const std::vector<FractionEntry>& from : comm.all_to_all(to))
      entries.insert(entries.end(), from.begin(), from.end());
  }

  TextFile file_;
  MicroLayout layout_;
  Grid grid_;      // the clipped grid
  IndexBox clip_;  // its cells in the file's grid
  int expand_layers_;
  Log log_;
};

// The header, parsed by every rank from rank 0's text.
MicroLayout read_layout(const Comm& comm, const TextFile& file) {
  constexpr std::int64_t kLongestHeader = std::int64_t{4} << 20;
  MicroLayout layout;
  layout.size = comm.min(file.size());
  std::string text;
  TecHeader header;
  collectively(comm, "reading " + file.path(), [&] {
    if (comm.rank() != 0) return;
    text.resize(static_cast<std::size_t>(std::min(kLongestHeader, layout.size)));
    file.read(0, text);
    header = parse_tec_header(text, file.path());
    text.resize(header.data_begin + 1);
  });
  text = comm.broadcast(std::move(text), 0);
  collectively(comm, "reading " + file.path(), [&] {
    header = parse_tec_header(text, file.path());
    layout.data_begin = static_cast<std::int64_t>(header.data_begin);
    layout.row_length = static_cast<std::int64_t>(header.variables.size());
    layout.centroids.cells = header.cells;
    if (header.cells[0] * header.cells[1] * header.cells[2] > INT64_MAX / layout.row_length)
      throw Error(file.path() + ": the ZONE has more cells than can be numbered");
  });
  return layout;
}

// Local. The numbers that start in the bytes [begin, end).
std::vector<double> numbers_between(const TextFile& file, std::int64_t begin, std::int64_t end) {
  const Comm alone = Comm::self();
  Stream stream(alone, file, begin, end);
  std::vector<double> numbers;
  while (stream.next(alone)) numbers.insert(numbers.end(), stream.values().begin(), stream.values().end());
  return numbers;
}

// Local. The smallest centroid, from the first and the last row: whatever way the axes run, these are
// opposite corners. When they are not, the first row counts, and reading will name the row that does not fit.
Vec3 smallest_centroid(const TextFile& file, const MicroLayout& layout) {
  constexpr std::int64_t kNumberBytes = 64, kMargin = 4096;
  const std::int64_t window = layout.row_length * kNumberBytes + kMargin;
  const auto head =
      numbers_between(file, layout.data_begin, std::min(layout.size, layout.data_begin + window));
  if (head.size() < 3) throw Error(file.place(layout.data_begin) + "expected the centroid of the first cell");
  const Vec3 first{head[0], head[1], head[2]};
  std::vector<double> tail;
  try {
    tail = numbers_between(file, std::max(layout.data_begin, layout.size - window), layout.size);
  } catch (const Error&) {
    return first;  // text that is no number: reported with everything before it when the rows are read
  }
  if (tail.size() < static_cast<std::size_t>(layout.row_length)) return first;
  const auto row = tail.end() - layout.row_length;
  Vec3 smallest = first;
  for (std::size_t d = 0; d < 3; ++d) {
    const double last = row[static_cast<std::ptrdiff_t>(d)];
    const double steps = static_cast<double>(layout.centroids.cells[d] - 1);
    constexpr double kTolerance = 0.01;
    if (!(std::fabs(std::fabs(last - first[d]) - steps) < kTolerance)) return first;
    smallest[d] = std::min(first[d], last);
  }
  return smallest;
}

}  // namespace

std::unique_ptr<MaterialSource> open_micro(const Comm& comm, const Deck& deck, const Log& log) {
  const std::string& path = deck.input_micro;
  std::optional<TextFile> file;
  collectively(comm, "opening " + path, [&] { file.emplace(path, "input_micro"); });
  MicroLayout layout = read_layout(comm, *file);
  // A number takes two characters at least. Say so before anyone allocates a grid that the file cannot fill.
  if (layout.numbers() > (layout.size + 1) / 2) {
    Stream stream(comm, *file, layout.data_begin, layout.size);
    while (stream.next(comm)) {
    }
    throw wrong_count(path, layout, stream.total());
  }
  std::vector<Vec3> corner(1);
  collectively(comm, "reading " + path, [&] {
    if (comm.rank() == 0) corner[0] = smallest_centroid(*file, layout);
  });
  comm.broadcast(corner, 0);
  layout.centroids.first = corner[0];
  Grid grid;
  IndexBox clip;
  collectively(comm, "reading " + path, [&] {
    for (std::size_t d = 0; d < 3; ++d)
      if (!std::isfinite(corner[0][d]))
        throw Error(file->place(layout.data_begin) + "the first centroid is not a finite number");
    const Grid whole_grid = uniform_grid(layout.centroids.cells, corner[0] - Vec3{0.5, 0.5, 0.5}, {1, 1, 1});
    clip = deck_clip(deck, whole_grid, path);
    grid = part_of(whole_grid, clip);
  });
  return std::make_unique<MicroSource>(std::move(*file), layout, std::move(grid), clip, deck.micro_expand,
                                       log);
}

}  // namespace sculpt
