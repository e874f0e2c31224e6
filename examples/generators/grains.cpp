#include "grains.hpp"

#include <algorithm>

#include "noise.hpp"

namespace microstructure {
namespace {

constexpr std::int64_t kUnit = 16;         // of lengths, per voxel
constexpr int kLloydSteps = 3;             // evens out the grain sizes
constexpr std::int64_t kLloydPoints = 32;  // sample points per axis there, at most
constexpr std::int64_t kWarpRadius = 6;

struct Seeds {
  std::vector<std::int32_t> x, y, z, weight;

  // The seed with the least power distance to a point; ties go to the first.
  [[nodiscard]] std::int32_t nearest(std::int32_t px, std::int32_t py, std::int32_t pz,
                                     std::vector<std::int32_t>& power) const {
    power.resize(x.size());
    for (std::size_t s = 0; s < x.size(); ++s) {
      const std::int32_t dx = x[s] - px, dy = y[s] - py, dz = z[s] - pz;
      power[s] = dx * dx + dy * dy + dz * dz - weight[s];
    }
    return static_cast<std::int32_t>(std::min_element(power.begin(), power.end()) - power.begin());
  }
};

Seeds scatter(const GrainOptions& o, Random& random) {
  Seeds seeds;
  // Mean distance of the seeds squared, from the volume (area) per grain.
  std::int64_t volume = 1, spacing = 1;
  int dimensions = 0;
  for (const std::int64_t n : o.n)
    if (n > 1) {
      volume *= n;
      ++dimensions;
    }
  const auto power = [&](std::int64_t s) { return dimensions < 2 ? s : dimensions == 2 ? s * s : s * s * s; };
  while (power(spacing + 1) * o.grains <= volume) ++spacing;
  const std::int64_t most = spacing * spacing * kUnit * kUnit / 3;
  for (std::int64_t g = 0; g < o.grains; ++g) {
    seeds.x.push_back(static_cast<std::int32_t>(random.below(o.n[0] * kUnit)));
    seeds.y.push_back(static_cast<std::int32_t>(random.below(o.n[1] * kUnit)));
    seeds.z.push_back(static_cast<std::int32_t>(random.below(o.n[2] * kUnit)));
    seeds.weight.push_back(static_cast<std::int32_t>(random.below(most + 1)));
  }
  return seeds;
}

// Moves every seed to the centre of its region, found on a coarse lattice of points.
void centre_seeds(const Counts& n, Seeds& seeds) {
  Counts step;
  for (std::size_t d = 0; d < 3; ++d) step[d] = (n[d] + kLloydPoints - 1) / kLloydPoints;
  std::vector<std::array<std::int64_t, 4>> sums(seeds.x.size(), {0, 0, 0, 0});
  std::vector<std::int32_t> power;
  for (std::int64_t i = 0; i < n[0]; i += step[0])
    for (std::int64_t j = 0; j < n[1]; j += step[1])
      for (std::int64_t k = 0; k < n[2]; k += step[2]) {
        const std::int64_t p[3] = {i * kUnit + step[0] * kUnit / 2, j * kUnit + step[1] * kUnit / 2,
                                   k * kUnit + step[2] * kUnit / 2};
        auto& sum = sums[static_cast<std::size_t>(seeds.nearest(static_cast<std::int32_t>(p[0]),
                                                                static_cast<std::int32_t>(p[1]),
                                                                static_cast<std::int32_t>(p[2]), power))];
        for (std::size_t d = 0; d < 3; ++d) sum[d] += p[d];
        ++sum[3];
      }
  for (std::size_t s = 0; s < sums.size(); ++s) {
    if (sums[s][3] == 0) continue;
    seeds.x[s] = static_cast<std::int32_t>(sums[s][0] / sums[s][3]);
    seeds.y[s] = static_cast<std::int32_t>(sums[s][1] / sums[s][3]);
    seeds.z[s] = static_cast<std::int32_t>(sums[s][2] / sums[s][3]);
  }
}

Voxels tessellate(const GrainOptions& o, const Seeds& seeds, Random& random) {
  std::vector<Box<std::int64_t>> shift;
  for (int d = 0; d < 3; ++d) shift.push_back(smooth_noise(o.n, kWarpRadius, o.warp, random));
  Voxels voxels(o.n);
  std::vector<std::int32_t> power;
  for (std::int64_t i = 0; i < o.n[0]; ++i)
    for (std::int64_t j = 0; j < o.n[1]; ++j)
      for (std::int64_t k = 0; k < o.n[2]; ++k) {
        const auto x = static_cast<std::int32_t>(i * kUnit + kUnit / 2 + shift[0].at(i, j, k));
        const auto y = static_cast<std::int32_t>(j * kUnit + kUnit / 2 + shift[1].at(i, j, k));
        const auto z = static_cast<std::int32_t>(k * kUnit + kUnit / 2 + shift[2].at(i, j, k));
        voxels.at(i, j, k) = 1 + seeds.nearest(x, y, z, power);
      }
  return voxels;
}

// Metropolis steps that propose the id of a random neighbour; the energy counts unlike neighbours.
class Potts {
 public:
  Potts(Voxels& voxels, Random& random) : voxels_(voxels), random_(random) {
    // exp(-1 / 0.7) in units of 2^-32, and its powers by whole multiplications.
    constexpr std::uint64_t kOne = std::uint64_t{1} << 32, kStep = 1029293364;
    std::uint64_t p = kOne;
    for (std::uint64_t& chance : chance_) {
      chance = p;
      p = (p * kStep) >> 32;
    }
  }

  void sweep() {
    const auto [nx, ny, nz] = voxels_.n;
    for (std::int64_t i = 0; i < nx; ++i)
      for (std::int64_t j = 0; j < ny; ++j)
        for (std::int64_t k = 0; k < nz; ++k) step(i, j, k);
  }

 private:
  void step(std::int64_t i, std::int64_t j, std::int64_t k) {
    const std::int64_t pick = random_.below(27);
    const std::int64_t a = i + pick / 9 - 1, b = j + pick / 3 % 3 - 1, c = k + pick % 3 - 1;
    if (!inside(a, b, c)) return;
    const std::int32_t own = voxels_.at(i, j, k), other = voxels_.at(a, b, c);
    if (own == other) return;
    std::int64_t rise = 0;
    for (std::int64_t x = i - 1; x <= i + 1; ++x)
      for (std::int64_t y = j - 1; y <= j + 1; ++y)
        for (std::int64_t z = k - 1; z <= k + 1; ++z) {
          if (!inside(x, y, z) || (x == i && y == j && z == k)) continue;
          const std::int32_t near = voxels_.at(x, y, z);
          rise += (near == own) - (near == other);
        }
    if (rise > 0 && (random_.bits() >> 32) >= chance_[static_cast<std::size_t>(rise)]) return;
    voxels_.at(i, j, k) = other;
  }
  [[nodiscard]] bool inside(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return i >= 0 && j >= 0 && k >= 0 && i < voxels_.n[0] && j < voxels_.n[1] && k < voxels_.n[2];
  }

  Voxels& voxels_;
  Random& random_;
  std::array<std::uint64_t, 27> chance_{};
};

}  // namespace

Voxels make_grains(const GrainOptions& options) {
  Random random(options.seed);
  Seeds seeds = scatter(options, random);
  for (int step = 0; step < kLloydSteps; ++step) centre_seeds(options.n, seeds);
  Voxels voxels = tessellate(options, seeds, random);
  Potts potts(voxels, random);
  for (int sweep = 0; sweep < options.sweeps; ++sweep) potts.sweep();
  return voxels;
}

}  // namespace microstructure
