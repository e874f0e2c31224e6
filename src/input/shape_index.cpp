#include "input/shape_index.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {
namespace {

constexpr std::int64_t kBinsPerShape = 8, kMostBinsPerShape = 32;
constexpr std::int64_t kEntriesPerShape = 100;  // in all bins together

bool overlap(const Box& a, const Box& b) {
  return a.lo.x < b.hi.x && b.lo.x < a.hi.x && a.lo.y < b.hi.y && b.lo.y < a.hi.y && a.lo.z < b.hi.z &&
         b.lo.z < a.hi.z;
}

// The part of space that holds shapes; its corners are the wrong way round when there is none.
Box occupied(const Box& space, const std::vector<Box>& bounds) {
  Box used{space.hi, space.lo};
  for (const Box& b : bounds)
    for (std::size_t d = 0; d < 3; ++d) {
      used.lo[d] = std::clamp(b.lo[d], space.lo[d], used.lo[d]);
      used.hi[d] = std::clamp(b.hi[d], used.hi[d], space.hi[d]);
    }
  return used;
}

}  // namespace

Box space_of(const Grid& grid) {
  Box space;
  for (std::size_t d = 0; d < 3; ++d) {
    space.lo[d] = grid.planes[d].front();
    space.hi[d] = grid.planes[d].back();
  }
  return space;
}

ShapeIndex::ShapeIndex(std::span<const InsertedShape> shapes, const Box& space, double reach) {
  const Vec3 margin{reach, reach, reach};
  bounds_.reserve(shapes.size());
  for (const InsertedShape& inserted : shapes) {
    const Box b = inserted.shape->bounds();
    bounds_.push_back({b.lo - margin, b.hi + margin});
  }
  const Box used = occupied(space, bounds_);
  const Vec3 size = used.hi - used.lo;
  const auto shape_count = static_cast<std::int64_t>(shapes.size());
  const double ideal = std::cbrt(size.x * size.y * size.z / static_cast<double>(kBinsPerShape * shape_count));
  // Coarser when shapes are large or overlap a lot, so that memory stays in proportion to their number.
  constexpr double kCoarser = 1.25, kMostBinsPerAxis = 1024;
  for (double width = std::fmax(ideal, largest(size) / kMostBinsPerAxis);; width *= kCoarser) {
    divide(used, width);
    std::int64_t entries = 0;
    for (const Box& b : bounds_) entries += bins_of(b).size();
    const bool affordable = entries <= kEntriesPerShape * shape_count &&
                            static_cast<std::int64_t>(bins()) <= kMostBinsPerShape * shape_count;
    if (affordable || bins() == 1) break;
  }
  fill();
}

void ShapeIndex::divide(const Box& space, double width) {
  lo_ = space.lo;
  for (std::size_t d = 0; d < 3; ++d) {
    const double size = space.hi[d] - space.lo[d];
    const bool divisible = width > 0 && size > 0;
    count_[d] = divisible ? static_cast<std::int64_t>(std::ceil(size / width)) : 1;
    per_length_[d] = size > 0 ? static_cast<double>(count_[d]) / size : 0;
  }
}

void ShapeIndex::fill() {
  const auto for_each_bin = [&](std::size_t s, const auto& visit) {
    const IndexBox box = bins_of(bounds_[s]);
    for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k)
      for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j)
        for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) visit(number({i, j, k}));
  };
  offset_.assign(bins() + 1, 0);
  for (std::size_t s = 0; s < bounds_.size(); ++s) for_each_bin(s, [&](std::size_t b) { ++offset_[b + 1]; });
  for (std::size_t b = 1; b < offset_.size(); ++b) offset_[b] += offset_[b - 1];
  shape_.resize(static_cast<std::size_t>(offset_.back()));
  std::vector<std::int64_t> next(offset_.begin(), offset_.end() - 1);
  for (std::size_t s = 0; s < bounds_.size(); ++s)
    for_each_bin(s, [&](std::size_t b) {
      shape_[static_cast<std::size_t>(next[b]++)] = static_cast<std::int32_t>(s);
    });
}

Index3 ShapeIndex::bin_of(const Vec3& p) const {
  Index3 bin{};
  for (std::size_t d = 0; d < 3; ++d) {
    const double at = (p[d] - lo_[d]) * per_length_[d];
    bin[d] = static_cast<std::int64_t>(std::clamp(at, 0.0, static_cast<double>(count_[d] - 1)));
  }
  return bin;
}

IndexBox ShapeIndex::bins_of(const Box& box) const {
  IndexBox bins{bin_of(box.lo), bin_of(box.hi)};
  for (std::size_t d = 0; d < 3; ++d) ++bins.hi[d];
  return bins;
}

void ShapeIndex::find(const Box& box, std::vector<std::int32_t>& found) const {
  found.clear();
  const IndexBox bins = bins_of(box);
  for (std::int64_t k = bins.lo[2]; k < bins.hi[2]; ++k)
    for (std::int64_t j = bins.lo[1]; j < bins.hi[1]; ++j)
      for (std::int64_t i = bins.lo[0]; i < bins.hi[0]; ++i)
        for (const std::int32_t s : bin(number({i, j, k})))
          if (overlap(bounds_[static_cast<std::size_t>(s)], box)) found.push_back(s);
  if (bins.size() == 1) return;
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
}

}  // namespace sculpt
