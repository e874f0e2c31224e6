#include "noise.hpp"

#include <algorithm>
#include <cstdlib>

namespace microstructure {
namespace {

constexpr int kPasses = 3;

// Sliding sum along one line of voxels, `stride` apart.
void blur_line(std::int64_t* first, std::size_t stride, std::int64_t n, std::int64_t radius,
               std::vector<std::int64_t>& line) {
  line.resize(static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < line.size(); ++i) line[i] = first[i * stride];
  const auto wrapped = [&](std::int64_t i) { return line[static_cast<std::size_t>(((i % n) + n) % n)]; };
  std::int64_t sum = 0;
  for (std::int64_t i = -radius; i <= radius; ++i) sum += wrapped(i);
  for (std::int64_t i = 0; i < n; ++i) {
    first[static_cast<std::size_t>(i) * stride] = sum;
    sum += wrapped(i + radius + 1) - wrapped(i - radius);
  }
}

void blur(Box<std::int64_t>& field, std::int64_t radius) {
  const auto [nx, ny, nz] = field.n;
  const auto sx = static_cast<std::size_t>(ny * nz), sy = static_cast<std::size_t>(nz);
  std::vector<std::int64_t> line;
  for (std::int64_t i = 0; i < nx; ++i)
    for (std::int64_t j = 0; j < ny; ++j) blur_line(&field.at(i, j, 0), 1, nz, radius, line);
  for (std::int64_t i = 0; i < nx; ++i)
    for (std::int64_t k = 0; k < nz; ++k) blur_line(&field.at(i, 0, k), sy, ny, radius, line);
  for (std::int64_t j = 0; j < ny; ++j)
    for (std::int64_t k = 0; k < nz; ++k) blur_line(&field.at(0, j, k), sx, nx, radius, line);
}

}  // namespace

Box<std::int64_t> smooth_noise(const Counts& n, std::int64_t radius, Random& random) {
  Box<std::int64_t> field(n);
  for (std::int64_t& v : field.values) v = random.between(-1000, 1000);
  for (int pass = 0; pass < kPasses; ++pass) blur(field, radius);
  return field;
}

Box<std::int64_t> smooth_noise(const Counts& n, std::int64_t radius, std::int64_t amplitude, Random& random) {
  Box<std::int64_t> field = smooth_noise(n, radius, random);
  std::int64_t most = 1;
  for (const std::int64_t v : field.values) most = std::max(most, std::abs(v));
  const std::int64_t unit = most / 10000 + 1;  // keeps the product below in range
  for (std::int64_t& v : field.values) v = v / unit * amplitude / (most / unit + 1);
  return field;
}

}  // namespace microstructure
