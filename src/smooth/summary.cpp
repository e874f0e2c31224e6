#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sculpt/smooth/smooth.hpp"
#include "smooth/quality.hpp"

namespace sculpt {
namespace {

constexpr double kUnits = 1099511627776.0;  // 2^40 per unit of quality

// What one rank finds; sums are integers.
struct Tally {
  std::array<std::int64_t, 5> counts{0, 0, 0, 0, 0};  // hexes, <= 0, < 0.2, < 0.3, not positive inside
  std::int64_t units = 0, carries = 0;                // sum of quality = (carries 2^40 + units) / 2^40
  double least = 2, shortest = std::numeric_limits<double>::infinity();
  LocalId worst = kNone;

  void add(const HexMesh& mesh, LocalId h, double q, double edge) {
    ++counts[0];
    counts[1] += q <= 0;
    counts[2] += q < 0.2;
    counts[3] += q < 0.3;
    counts[4] += q < kNeverFolds && !is_positive_inside(mesh.corners(h));
    units += static_cast<std::int64_t>(std::llround(q * kUnits));
    carries += units >> 40;
    units &= (std::int64_t{1} << 40) - 1;
    shortest = std::min(shortest, edge);
    if (q < least) {
      least = q;
      worst = h;
    }
  }
};

Tally tally_owned(const HexMesh& mesh) {
  Tally tally;
  std::array<LocalId, 8> batch;
  std::size_t count = 0;
  const auto measure = [&] {
    const HexQuality q = quality_of(mesh.hexes, mesh.position, {batch.data(), count});
    for (std::size_t i = 0; i < count; ++i)
      tally.add(mesh, batch[i], q.scaled_jacobian[i], q.shortest_edge[i]);
    count = 0;
  };
  for (LocalId h = 0; h < mesh.size(); ++h) {
    if (mesh.layer[at(h)] != 0) continue;
    batch[count++] = h;
    if (count == batch.size()) measure();
  }
  if (count > 0) measure();
  return tally;
}

// Where the worst hex is, and whose: ties go to the smallest id.
void locate_worst(const Comm& comm, const HexMesh& mesh, const Tally& tally, QualitySummary& s) {
  const bool mine = tally.worst != kNone && tally.least == s.least;
  const GlobalId none = std::numeric_limits<GlobalId>::max();
  s.least_hex = comm.min(mine ? mesh.hex_id[at(tally.worst)] : none);
  const bool named = mine && mesh.hex_id[at(tally.worst)] == s.least_hex;
  s.least_rank = static_cast<int>(comm.max(std::int64_t{named ? comm.rank() : 0}));
  std::vector<Vec3> centre(1);
  if (named)
    for (const Vec3& p : mesh.corners(tally.worst)) centre[0] += 0.125 * p;
  comm.broadcast(centre, s.least_rank);
  s.least_at = centre[0];
}

}  // namespace

QualitySummary summarise(const Comm& comm, const HexMesh& mesh) {
  Tally tally = tally_owned(mesh);
  comm.sum(tally.counts);
  QualitySummary s;
  s.hexes = tally.counts[0];
  s.not_positive = tally.counts[1];
  s.below_02 = tally.counts[2];
  s.below_03 = tally.counts[3];
  s.not_positive_inside = tally.counts[4];
  s.least = comm.min(tally.least);
  s.shortest_edge = comm.min(tally.shortest);
  locate_worst(comm, mesh, tally, s);
  const double all =
      static_cast<double>(comm.sum(tally.carries)) + static_cast<double>(comm.sum(tally.units)) / kUnits;
  s.average = s.hexes > 0 ? all / static_cast<double>(s.hexes) : 0;
  return s;
}

}  // namespace sculpt
