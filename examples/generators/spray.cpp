#include "spray.hpp"

#include <algorithm>

#include "random.hpp"

namespace microstructure {
namespace {

constexpr std::int32_t kPore = 1, kSplat = 2, kOtherSplat = 3;
constexpr std::int64_t kStartDepth =
    30;  // below the box: the first splats lie on flat ground and are not typical
constexpr std::int64_t kShallow = 2, kDeep = 3;  // gaps below a splat that stay open, in voxels
constexpr std::int64_t kRunDown = 10;            // what a splat adds to its thickness in a deep hole, at most
constexpr std::int64_t kSeamPores = 14;          // voxels in 1000 at a seam of two splats that are pores
constexpr std::int64_t kSeamMixes = 60;          // voxels in 1000 there that take the id from across

class Deposit {
 public:
  Deposit(const Counts& n, std::uint64_t seed)
      : n_(n), random_(seed), voxels_({n[0], n[1], n[2] + kStartDepth}, kPore), height_({n[0], n[1], 1}) {}

  Voxels grow() {
    while (*std::min_element(height_.values.begin(), height_.values.end()) < voxels_.n[2]) add_splat();
    Voxels cut(n_);
    for (std::int64_t i = 0; i < n_[0]; ++i)
      for (std::int64_t j = 0; j < n_[1]; ++j)
        for (std::int64_t k = 0; k < n_[2]; ++k) cut.at(i, j, k) = voxels_.at(i, j, k + kStartDepth);
    return cut;
  }

 private:
  struct Column {
    std::int64_t i, j, thickness;
  };

  // A splat may be wider than the box.
  static std::int64_t wrapped(std::int64_t i, std::int64_t n) { return (i % n + n) % n; }

  void add_splat() {
    const std::int64_t radius_x = random_.between(7, 20), radius_y = random_.between(7, 20);
    const std::int64_t thickness = random_.between(3, 6), x = random_.below(n_[0]), y = random_.below(n_[1]);
    const std::int32_t id = random_.below(3) == 0 ? kOtherSplat : kSplat;
    columns_.clear();
    const std::int64_t rim = radius_x * radius_x * radius_y * radius_y;
    for (std::int64_t di = -radius_x; di <= radius_x; ++di)
      for (std::int64_t dj = -radius_y; dj <= radius_y; ++dj) {
        const std::int64_t inside = rim - di * di * radius_y * radius_y - dj * dj * radius_x * radius_x;
        if (inside <= 0) continue;
        columns_.push_back({wrapped(x + di, n_[0]), wrapped(y + dj, n_[1]), 1 + thickness * inside / rim});
      }
    const std::int64_t support = support_height();
    for (const Column& c : columns_) lay(c, id, support);
  }

  // The height that seven tenths of the ground below a splat do not exceed.
  std::int64_t support_height() {
    heights_.clear();
    for (const Column& c : columns_) heights_.push_back(height_.at(c.i, c.j, 0));
    const auto seventh = heights_.begin() + static_cast<std::ptrdiff_t>(heights_.size() * 7 / 10);
    std::nth_element(heights_.begin(), seventh, heights_.end());
    return *seventh;
  }

  // The splat is level on top. It covers hills with one voxel, leaves narrow gaps open, fills shallow ones
  // and runs down deep ones.
  void lay(const Column& c, std::int32_t id, std::int64_t support) {
    std::int64_t& height = height_.at(c.i, c.j, 0);
    const std::int64_t gap = support - height;
    const std::int64_t bottom = gap >= kShallow && gap <= kDeep ? support : height;
    const std::int64_t level = std::max(support + c.thickness, height + 1);
    const std::int64_t top = gap > kDeep ? std::min(level, height + c.thickness + kRunDown) : level;
    for (std::int64_t k = bottom; k < std::min(top, voxels_.n[2]); ++k) voxels_.at(c.i, c.j, k) = id;
    height = top;
  }

  Counts n_;
  Random random_;
  Voxels voxels_;
  Box<std::int64_t> height_;
  std::vector<Column> columns_;
  std::vector<std::int64_t> heights_;
};

// Noise of imaging and of oxides: voxels at seams turn into pores or into the material across.
void roughen_seams(Voxels& voxels, Random& random) {
  const Voxels before = voxels;
  constexpr std::int64_t kSteps[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  const auto inside = [&](std::int64_t i, std::size_t d) { return i >= 0 && i < voxels.n[d]; };
  for (std::int64_t i = 0; i < voxels.n[0]; ++i)
    for (std::int64_t j = 0; j < voxels.n[1]; ++j)
      for (std::int64_t k = 0; k < voxels.n[2]; ++k) {
        const auto& step = kSteps[random.below(6)];
        const std::int64_t a = i + step[0], b = j + step[1], c = k + step[2], dice = random.below(1000);
        if (!inside(a, 0) || !inside(b, 1) || !inside(c, 2)) continue;
        const std::int32_t own = before.at(i, j, k), other = before.at(a, b, c);
        if (own == other) continue;
        if (dice < kSeamPores)
          voxels.at(i, j, k) = kPore;
        else if (dice < kSeamPores + kSeamMixes)
          voxels.at(i, j, k) = other;
      }
}

}  // namespace

Voxels make_spray(const Counts& n, std::uint64_t seed) {
  Voxels voxels = Deposit(n, seed).grow();
  Random random(seed + 1);
  roughen_seams(voxels, random);
  return voxels;
}

}  // namespace microstructure
