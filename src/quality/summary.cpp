#include "sculpt/quality/summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "sculpt/base/fixed_point.hpp"
#include "sculpt/geom/hex_quality.hpp"

namespace sculpt {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// To cells of level 0.
Vec3 per_cell(const HexMesh& mesh) {
  return {1 / mesh.cell_size.x, 1 / mesh.cell_size.y, 1 / mesh.cell_size.z};
}

// Calls visit(batch, count) for all hexes in groups of up to eight, owned ones only or all.
template <class Visit>
void in_batches(const HexMesh& mesh, bool owned_only, const Visit& visit) {
  std::array<LocalId, 8> batch;
  std::size_t count = 0;
  for (LocalId h = 0; h < mesh.size(); ++h) {
    if (owned_only && mesh.layer[at(h)] != 0) continue;
    batch[count++] = h;
    if (count < batch.size()) continue;
    visit(batch, count);
    count = 0;
  }
  if (count > 0) visit(batch, count);
}

int bin_of(double q) {
  int bin = std::clamp(static_cast<int>(std::floor((q + 1) * 10)), 0, QualitySummary::kBins - 1);
  while (bin > 0 && q < QualitySummary::bin_begin(bin)) --bin;
  while (bin + 1 < QualitySummary::kBins && q >= QualitySummary::bin_begin(bin + 1)) ++bin;
  return bin;
}

// The first hexes of an order by quality: values and local hexes, at most `most`.
class Worst {
 public:
  explicit Worst(std::size_t most) : most_(most) {}
  void add(double q, LocalId h) {
    if (kept_.size() == most_ && q >= kept_.back().first) return;  // an equal one before it has a smaller id
    const auto place = std::upper_bound(kept_.begin(), kept_.end(), std::pair(q, h));
    kept_.insert(place, {q, h});
    if (kept_.size() > most_) kept_.pop_back();
  }
  [[nodiscard]] const std::vector<std::pair<double, LocalId>>& hexes() const { return kept_; }

 private:
  std::size_t most_;
  std::vector<std::pair<double, LocalId>> kept_;
};

// What one rank finds; sums are integers.
struct Tally {
  enum { kHexes, kNotPositive, kBelow01, kBelow02, kBelow03, kBelow05, kInvalid, kCounts };
  std::array<std::int64_t, kCounts> counts{};
  std::array<std::int64_t, QualitySummary::kBins> histogram{};
  double shortest = kInfinity, shortest_cells = kInfinity;
  std::vector<std::int64_t> hexes, quality, volume;  // per material; the last two in fixed point
  std::vector<double> least;
  Worst worst{kWorstListed}, invalid{kInvalidListed};

  explicit Tally(std::size_t materials)
      : hexes(materials, 0), quality(materials, 0), volume(materials, 0), least(materials, 2) {}

  void add_quality(const HexMesh& mesh, LocalId h, double q) {
    ++counts[kHexes];
    counts[kNotPositive] += q <= 0;
    counts[kBelow01] += q < 0.1;
    counts[kBelow02] += q < 0.2;
    counts[kBelow03] += q < 0.3;
    counts[kBelow05] += q < 0.5;
    ++histogram[static_cast<std::size_t>(bin_of(q))];
    worst.add(q, h);
    if (q < kNeverFolds && !is_positive_inside(mesh.corners(h))) {
      ++counts[kInvalid];
      invalid.add(q, h);
    }
    const std::size_t m = at(mesh.material[at(h)]);
    ++hexes[m];
    quality[m] += to_units(q);
    least[m] = std::min(least[m], q);
  }
};

Tally tally_owned(const HexMesh& mesh, std::size_t materials) {
  Tally tally(materials);
  const Vec3 unit = per_cell(mesh);
  in_batches(mesh, true, [&](const std::array<LocalId, 8>& batch, std::size_t count) {
    const std::span<const LocalId> which{batch.data(), count};
    const HexQuality q = quality_of(mesh.hexes, mesh.position, which);
    const HexSize size = size_of(mesh.hexes, mesh.position, which, unit);
    for (std::size_t i = 0; i < count; ++i) {
      tally.add_quality(mesh, batch[i], q.scaled_jacobian[i]);
      tally.volume[at(mesh.material[at(batch[i])])] += to_units(size.volume[i]);
      tally.shortest = std::min(tally.shortest, q.shortest_edge[i]);
      tally.shortest_cells = std::min(tally.shortest_cells, size.shortest_edge[i] / mesh.hex_unit(batch[i]));
    }
  });
  return tally;
}

ListedHex described(const HexMesh& mesh, LocalId h, double q) {
  ListedHex listed;
  const HexCorners p = mesh.corners(h);
  listed.hex = mesh.hex_id[at(h)];
  listed.material = mesh.material[at(h)];
  listed.owner = mesh.hex_owner[at(h)];
  listed.scaled_jacobian = q;
  listed.shortest_edge = shortest_edge(p);
  listed.valid = is_positive_inside(p);
  const Vec3 unit = (1 / mesh.hex_unit(h)) * per_cell(mesh);
  const double cells = unit.x * unit.y * unit.z;
  double least = kInfinity;
  listed.least_determinant = kInfinity;
  for (int c = 0; c < 8; ++c) {
    const double there = corner_scaled_jacobian(p, c);
    if (there < least) {
      least = there;
      listed.corner = c + 1;
    }
    listed.least_determinant = std::min(listed.least_determinant, corner_determinant(p, c) * cells);
    listed.centre += 0.125 * p[static_cast<std::size_t>(c)];
  }
  return listed;
}

// The first of all ranks' hexes.
std::vector<ListedHex> gathered(const Comm& comm, const HexMesh& mesh, const Worst& worst, std::size_t most) {
  std::vector<ListedHex> all;
  for (const auto& [q, h] : worst.hexes()) all.push_back(described(mesh, h, q));
  all = comm.concatenate(all);
  std::sort(all.begin(), all.end(), [](const ListedHex& a, const ListedHex& b) {
    return std::tie(a.scaled_jacobian, a.hex) < std::tie(b.scaled_jacobian, b.hex);
  });
  if (all.size() > most) all.resize(most);
  return all;
}

// Gives hexes their numbers in the files: those before them in their block, and the blocks before.
void number_listed(const Comm& comm, const HexMesh& mesh, const std::vector<MaterialQuality>& materials,
                   std::vector<ListedHex>& listed) {
  std::vector<std::vector<GlobalId>> asked(materials.size());
  for (const ListedHex& l : listed) asked[at(l.material)].push_back(l.hex);
  for (auto& ids : asked) std::sort(ids.begin(), ids.end());
  std::vector<std::vector<std::int64_t>> between(materials.size());  // hexes from one listed hex to the next
  for (std::size_t m = 0; m < asked.size(); ++m) between[m].assign(asked[m].size() + 1, 0);
  for (LocalId h = 0; h < mesh.size(); ++h) {
    const std::size_t m = at(mesh.material[at(h)]);
    if (mesh.layer[at(h)] != 0 || asked[m].empty()) continue;
    ++between[m][static_cast<std::size_t>(
        std::upper_bound(asked[m].begin(), asked[m].end(), mesh.hex_id[at(h)]) - asked[m].begin())];
  }
  std::int64_t before = 0;
  std::vector<std::int64_t> first(materials.size());
  for (std::size_t m = 0; m < materials.size(); ++m) {
    first[m] = before;
    before += materials[m].hexes;
    if (!asked[m].empty()) comm.sum(between[m]);
  }
  for (ListedHex& l : listed) {
    const std::size_t m = at(l.material);
    const auto place = std::lower_bound(asked[m].begin(), asked[m].end(), l.hex) - asked[m].begin();
    l.element = first[m] + 1;
    for (std::ptrdiff_t i = 0; i <= place; ++i) l.element += between[m][static_cast<std::size_t>(i)];
  }
}

std::vector<MaterialQuality> by_material(const Comm& comm, Tally& tally) {
  comm.sum(tally.hexes);
  comm.sum(tally.quality);
  comm.sum(tally.volume);
  std::vector<MaterialQuality> materials(tally.hexes.size());
  for (std::size_t m = 0; m < materials.size(); ++m) {
    MaterialQuality& out = materials[m];
    out.hexes = tally.hexes[m];
    out.volume = from_units(tally.volume[m]);
    if (out.hexes > 0) out.mean = from_units(tally.quality[m]) / static_cast<double>(out.hexes);
  }
  const std::vector<double> least = comm.concatenate(tally.least);
  for (std::size_t i = 0; i < least.size(); ++i) {
    MaterialQuality& out = materials[i % materials.size()];
    if (out.hexes > 0) out.least = i < materials.size() ? least[i] : std::min(out.least, least[i]);
  }
  return materials;
}

}  // namespace

QualitySummary summarise(const Comm& comm, const HexMesh& mesh) {
  std::int64_t last = -1;
  for (const std::int32_t m : mesh.material) last = std::max<std::int64_t>(last, m);
  Tally tally = tally_owned(mesh, static_cast<std::size_t>(comm.max(last) + 1));
  comm.sum(tally.counts);
  comm.sum(tally.histogram);
  QualitySummary s;
  s.hexes = tally.counts[Tally::kHexes];
  s.not_positive = tally.counts[Tally::kNotPositive];
  s.below_01 = tally.counts[Tally::kBelow01];
  s.below_02 = tally.counts[Tally::kBelow02];
  s.below_03 = tally.counts[Tally::kBelow03];
  s.below_05 = tally.counts[Tally::kBelow05];
  s.not_positive_inside = tally.counts[Tally::kInvalid];
  s.histogram = tally.histogram;
  s.materials = by_material(comm, tally);
  s.worst = gathered(comm, mesh, tally.worst, kWorstListed);
  s.invalid = gathered(comm, mesh, tally.invalid, kInvalidListed);
  number_listed(comm, mesh, s.materials, s.worst);
  number_listed(comm, mesh, s.materials, s.invalid);
  if (s.hexes == 0) return s;
  s.least = s.worst.front().scaled_jacobian;
  s.shortest_edge = comm.min(tally.shortest);
  s.shortest_edge_cells = comm.min(tally.shortest_cells);
  double all = 0;
  for (const std::int64_t units : tally.quality) all += static_cast<double>(units);
  s.average = all / kUnits / static_cast<double>(s.hexes);
  return s;
}

std::vector<double> scaled_jacobians(const HexMesh& mesh) {
  std::vector<double> values(mesh.hexes.size());
  in_batches(mesh, false, [&](const std::array<LocalId, 8>& batch, std::size_t count) {
    const HexQuality q = quality_of(mesh.hexes, mesh.position, {batch.data(), count});
    for (std::size_t i = 0; i < count; ++i) values[at(batch[i])] = q.scaled_jacobian[i];
  });
  return values;
}

}  // namespace sculpt
