#include "input/micro_rows.hpp"

#include <fmt/core.h>

#include <cmath>

#include "sculpt/base/error.hpp"

namespace sculpt {
namespace {

constexpr double kCentroidTolerance = 0.01;  // of the spacing; rounded text of six digits is within
constexpr double kNegativeTolerance = 1e-6;
constexpr double kSumTolerance = 1e-3;
constexpr double kAbsent = 1e-12;  // smaller fractions are dropped

// What is wrong with the fractions of a row, or an empty text.
std::string defect(std::span<const double> fractions) {
  double sum = 0;
  for (std::size_t m = 0; m < fractions.size(); ++m) {
    if (!std::isfinite(fractions[m]) || fractions[m] < -kNegativeTolerance)
      return fmt::format("the volume fraction of material {} is {}, expected 0 to 1", m + 1, fractions[m]);
    sum += fractions[m];
  }
  if (std::fabs(sum - 1) > kSumTolerance)
    return fmt::format("the volume fractions add up to {}, expected 1", sum);
  return {};
}

}  // namespace

std::optional<Index3> CentroidGrid::cell(const Vec3& centroid) const {
  Index3 index;
  for (std::size_t d = 0; d < 3; ++d) {
    const double steps = centroid[d] - first[d];
    if (!(steps > -0.5 && steps < static_cast<double>(cells[d]) - 0.5)) return std::nullopt;
    const double nearest = std::floor(steps + 0.5);
    if (std::fabs(steps - nearest) > kCentroidTolerance) return std::nullopt;
    index[d] = static_cast<std::int64_t>(nearest);
  }
  return index;
}

void MicroRows::clear() {
  cells.clear();
  offset.resize(1);
  items.clear();
}

std::string MicroRows::add(std::span<const double> row, const CentroidGrid& grid) {
  const auto cell = grid.cell({row[0], row[1], row[2]});
  if (!cell)
    return fmt::format(
        "the centroid ({}, {}, {}) is none of the {} x {} x {} unit cells that begin at ({}, {}, {})", row[0],
        row[1], row[2], grid.cells[0], grid.cells[1], grid.cells[2], grid.first.x, grid.first.y,
        grid.first.z);
  const auto fractions = row.subspan(3);
  if (std::string what = defect(fractions); !what.empty()) return what;
  double sum = 0;
  for (const double f : fractions)
    if (f > kAbsent) sum += f;
  for (std::size_t m = 0; m < fractions.size(); ++m)
    if (fractions[m] > kAbsent) items.push_back({static_cast<std::int32_t>(m), fractions[m] / sum});
  cells.push_back(*cell);
  offset.push_back(items.size());
  return {};
}

IndexBox MicroRows::bounds() const {
  if (cells.empty()) return {};
  IndexBox box{cells[0], cells[0]};
  for (const Index3& cell : cells)
    for (std::size_t d = 0; d < 3; ++d) {
      box.lo[d] = std::min(box.lo[d], cell[d]);
      box.hi[d] = std::max(box.hi[d], cell[d]);
    }
  for (std::size_t d = 0; d < 3; ++d) ++box.hi[d];
  return box;
}

void MicroRows::select(const IndexBox& box, const Index3& shift, std::vector<FractionEntry>& to) const {
  for (std::size_t r = 0; r < cells.size(); ++r) {
    const Index3 cell{cells[r][0] - shift[0], cells[r][1] - shift[1], cells[r][2] - shift[2]};
    if (!box.contains(cell)) continue;
    const std::int64_t position = box.position(cell);
    for (std::size_t i = offset[r]; i < offset[r + 1]; ++i)
      to.push_back({position, items[i].material, items[i].value});
  }
}

Fractions assemble(const IndexBox& box, const std::vector<FractionEntry>& entries, const Index3& shift,
                   const std::string& path) {
  const auto cells = static_cast<std::size_t>(box.size());
  const auto complain = [&](std::int64_t position, const char* found) {
    const Index3 c = box.cell(position);
    throw Error(fmt::format("{}: {} for the cell ({}, {}, {}), counted from 0, expected one", path, found,
                            c[0] + shift[0], c[1] + shift[1], c[2] + shift[2]));
  };
  Fractions fractions;
  fractions.offset.assign(cells + 1, 0);
  for (std::size_t e = 0; e < entries.size(); ++e) {
    std::int64_t& count = fractions.offset[static_cast<std::size_t>(entries[e].position) + 1];
    const bool continues = e > 0 && entries[e].position == entries[e - 1].position &&
                           entries[e].material > entries[e - 1].material;
    if (count > 0 && !continues) complain(entries[e].position, "two rows");
    ++count;
  }
  for (std::size_t c = 0; c < cells; ++c) {
    if (fractions.offset[c + 1] == 0) complain(static_cast<std::int64_t>(c), "no row");
    fractions.offset[c + 1] += fractions.offset[c];
  }
  fractions.material.resize(entries.size());
  fractions.value.resize(entries.size());
  std::int64_t at = 0;
  for (std::size_t e = 0; e < entries.size(); ++e) {
    const bool starts = e == 0 || entries[e].position != entries[e - 1].position;
    if (starts) at = fractions.offset[static_cast<std::size_t>(entries[e].position)];
    fractions.material[static_cast<std::size_t>(at)] = entries[e].material;
    fractions.value[static_cast<std::size_t>(at)] = entries[e].value;
    ++at;
  }
  return fractions;
}

}  // namespace sculpt
