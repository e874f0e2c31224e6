#include <algorithm>
#include <vector>

#include "sculpt/smooth/smooth.hpp"

namespace sculpt {
namespace {

constexpr std::size_t kMost = 10;

struct WorstHex {
  double quality;
  GlobalId id;
  Vec3 centre;
  bool operator<(const WorstHex& other) const {
    return quality < other.quality || (quality == other.quality && id < other.id);
  }
};

void keep_worst(std::vector<WorstHex>& hexes) {
  std::sort(hexes.begin(), hexes.end());
  if (hexes.size() > kMost) hexes.resize(kMost);
}

}  // namespace

void print_worst_hexes(const HexMesh& mesh, double below, const Log& log) {
  std::vector<WorstHex> worst;
  for (LocalId h = 0; h < mesh.size(); ++h) {
    if (mesh.layer[at(h)] != 0) continue;
    const HexCorners p = mesh.corners(h);
    const double quality = scaled_jacobian(p);
    if (!(quality < below)) continue;
    Vec3 centre;
    for (const Vec3& corner : p) centre += 0.125 * corner;
    worst.push_back({quality, mesh.hex_id[at(h)], centre});
    if (worst.size() > 4 * kMost) keep_worst(worst);
  }
  keep_worst(worst);
  worst = mesh.hex_exchange.comm().concatenate(worst);
  keep_worst(worst);
  log.line("Worst hexes (scaled Jacobian, at x y z):");
  for (const WorstHex& h : worst)
    log.line("  {:f} at {:g} {:g} {:g}", h.quality, h.centre.x, h.centre.y, h.centre.z);
}

}  // namespace sculpt
