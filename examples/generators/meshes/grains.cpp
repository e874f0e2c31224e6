#include <algorithm>
#include <stdexcept>

#include "mesh.hpp"
#include "random.hpp"

namespace hexmesh {
namespace {

constexpr int kSamples = 4;     // per axis of a hex
constexpr int kLloydSteps = 3;  // evens out the grain sizes

Vec3 point_in(const sculpt::HexCorners& p, double u, double v, double w) {
  Vec3 sum;
  for (std::size_t c = 0; c < 8; ++c) {
    const auto& o = sculpt::kCornerOffset[c];
    sum += (o[0] == 1 ? u : 1 - u) * (o[1] == 1 ? v : 1 - v) * (o[2] == 1 ? w : 1 - w) * p[c];
  }
  return sum;
}

std::size_t nearest(const std::vector<Vec3>& seeds, const Vec3& p) {
  std::size_t best = 0;
  double least = dot(seeds[0] - p, seeds[0] - p);
  for (std::size_t s = 1; s < seeds.size(); ++s) {
    const double d = dot(seeds[s] - p, seeds[s] - p);
    if (d < least) {
      least = d;
      best = s;
    }
  }
  return best;
}

// Centres of different hexes.
std::vector<Vec3> scatter(const std::vector<Vec3>& centres, std::int32_t grains,
                          microstructure::Random& random) {
  std::vector<std::size_t> taken;
  std::vector<Vec3> seeds;
  while (seeds.size() < static_cast<std::size_t>(grains)) {
    const auto hex = static_cast<std::size_t>(random.below(static_cast<std::int64_t>(centres.size())));
    if (std::find(taken.begin(), taken.end(), hex) != taken.end()) continue;
    taken.push_back(hex);
    seeds.push_back(centres[hex]);
  }
  return seeds;
}

}  // namespace

void add_grains(Mesh& mesh, std::int32_t grains, std::uint64_t seed) {
  if (static_cast<std::size_t>(grains) > mesh.hex.size())
    throw std::runtime_error("--grains: " + std::to_string(grains) + " grains in a mesh of " +
                             std::to_string(mesh.hex.size()) + " hexes");
  microstructure::Random random(seed);
  std::vector<Vec3> centres;
  for (std::size_t h = 0; h < mesh.hex.size(); ++h)
    centres.push_back(point_in(mesh.corners(h), 0.5, 0.5, 0.5));
  std::vector<Vec3> seeds = scatter(centres, grains, random);
  for (int step = 0; step < kLloydSteps; ++step) {
    std::vector<Vec3> sum(seeds.size());
    std::vector<double> count(seeds.size(), 0);
    for (const Vec3& c : centres) {
      const std::size_t s = nearest(seeds, c);
      sum[s] += c;
      count[s] += 1;
    }
    for (std::size_t s = 0; s < seeds.size(); ++s)
      if (count[s] > 0) seeds[s] = (1 / count[s]) * sum[s];
  }
  const std::size_t first = mesh.variables.size();
  for (std::int32_t g = 1; g <= grains; ++g)
    mesh.variables.push_back({"vf_" + std::to_string(g), std::vector<double>(mesh.hex.size(), 0)});
  for (std::size_t h = 0; h < mesh.hex.size(); ++h) {
    const sculpt::HexCorners p = mesh.corners(h);
    for (int i = 0; i < kSamples; ++i)
      for (int j = 0; j < kSamples; ++j)
        for (int k = 0; k < kSamples; ++k) {
          const std::size_t s =
              nearest(seeds, point_in(p, (i + 0.5) / kSamples, (j + 0.5) / kSamples, (k + 0.5) / kSamples));
          mesh.variables[first + s].value[h] += 1.0 / (kSamples * kSamples * kSamples);
        }
  }
}

}  // namespace hexmesh
