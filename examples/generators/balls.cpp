#include "balls.hpp"

#include <algorithm>
#include <stdexcept>

#include "random.hpp"

namespace microstructure {
namespace {

constexpr std::int64_t kTries = 100000;  // places looked at for one ball
constexpr std::int64_t kUnit = 2;        // of lengths, per voxel: the centres of voxels are odd
constexpr std::int64_t kGap = 2 * kUnit;

struct Ball {
  std::array<std::int64_t, 3> centre;
  std::int64_t radius;
};

std::int64_t squared_distance(const std::array<std::int64_t, 3>& a, const std::array<std::int64_t, 3>& b) {
  std::int64_t sum = 0;
  for (std::size_t d = 0; d < 3; ++d) sum += (a[d] - b[d]) * (a[d] - b[d]);
  return sum;
}

// Of equal balls that fill 0.3 of the box: 14 count r^3 = volume.
std::int64_t mean_radius(const BallOptions& o) {
  const std::int64_t volume = o.n[0] * o.n[1] * o.n[2] * kUnit * kUnit * kUnit;
  std::int64_t r = 0;
  while (14 * o.count * (r + 1) * (r + 1) * (r + 1) <= volume) ++r;
  return r;
}

}  // namespace

Voxels make_balls(const BallOptions& o) {
  const std::int64_t mean = mean_radius(o);
  if (mean < 2 * kUnit) throw std::runtime_error("the box is too small for so many balls");
  Random random(o.seed);
  std::vector<std::int64_t> radii;
  for (std::int64_t b = 0; b < o.count; ++b) radii.push_back(random.between(4 * mean / 5, 6 * mean / 5));
  std::sort(radii.rbegin(), radii.rend());  // large ones find room first
  std::vector<Ball> balls;
  for (const std::int64_t radius : radii)
    for (std::int64_t tries = 1;; ++tries) {
      if (tries > kTries) throw std::runtime_error("no room for so many balls");
      Ball ball{{}, radius};
      for (std::size_t d = 0; d < 3; ++d) ball.centre[d] = random.between(0, kUnit * o.n[d]);
      const auto is_near = [&ball](const Ball& other) {
        const std::int64_t reach = ball.radius + other.radius + kGap;
        return squared_distance(ball.centre, other.centre) < reach * reach;
      };
      if (std::any_of(balls.begin(), balls.end(), is_near)) continue;
      balls.push_back(ball);
      break;
    }
  Voxels voxels(o.n, 1);
  for (std::int64_t i = 0; i < o.n[0]; ++i)
    for (std::int64_t j = 0; j < o.n[1]; ++j)
      for (std::int64_t k = 0; k < o.n[2]; ++k)
        for (const Ball& b : balls)
          if (squared_distance(b.centre, {kUnit * i + 1, kUnit * j + 1, kUnit * k + 1}) < b.radius * b.radius)
            voxels.at(i, j, k) = 2;
  return voxels;
}

}  // namespace microstructure
