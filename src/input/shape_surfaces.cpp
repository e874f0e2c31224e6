#include "input/shape_surfaces.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {
namespace {

constexpr std::int64_t kMostBins = 16;  // per axis
constexpr double kReach = 1.5;          // in cells

class ShapeSurfaces {
 public:
  ShapeSurfaces(std::shared_ptr<const std::vector<InsertedShape>> shapes, const Grid& grid)
      : shapes_(std::move(shapes)) {
    reach_ = kReach * largest(grid.cell_size());
    for (std::size_t d = 0; d < 3; ++d) {
      bins_[d] = std::min(kMostBins, grid.cells[d]);
      lo_[d] = grid.planes[d].front();
      width_[d] = (grid.planes[d].back() - lo_[d]) / static_cast<double>(bins_[d]);
    }
    near_.resize(static_cast<std::size_t>(bins_[0] * bins_[1] * bins_[2]));
    const Vec3 margin{reach_, reach_, reach_};
    for (std::size_t s = 0; s < shapes_->size(); ++s) {
      const Box box = (*shapes_)[s].shape->bounds();
      const Index3 from = bin_of(box.lo - margin), to = bin_of(box.hi + margin);
      for (std::int64_t k = from[2]; k <= to[2]; ++k)
        for (std::int64_t j = from[1]; j <= to[1]; ++j)
          for (std::int64_t i = from[0]; i <= to[0]; ++i) near_[number({i, j, k})].push_back(s);
    }
  }

  [[nodiscard]] std::optional<Vec3> nearest(const Vec3& p, std::int32_t a, std::int32_t b) const {
    std::optional<Vec3> best;
    double least = reach_;
    const std::vector<std::size_t>& candidates = near_[number(bin_of(p))];
    for (const std::size_t s : candidates) {
      const InsertedShape& shape = (*shapes_)[s];
      if (shape.material != a && shape.material != b) continue;
      const std::optional<Vec3> q = shape.shape->nearest_on_surface(p);
      if (!q || !(norm(*q - p) < least) || hidden(*q, s, candidates)) continue;
      least = norm(*q - p);
      best = q;
    }
    return best;
  }

 private:
  [[nodiscard]] Index3 bin_of(const Vec3& p) const {
    Index3 bin{};
    for (std::size_t d = 0; d < 3; ++d)
      bin[d] = static_cast<std::int64_t>(
          std::clamp(std::floor((p[d] - lo_[d]) / width_[d]), 0.0, static_cast<double>(bins_[d] - 1)));
    return bin;
  }
  [[nodiscard]] std::size_t number(const Index3& bin) const {
    return static_cast<std::size_t>(bin[0] + bins_[0] * (bin[1] + bins_[1] * bin[2]));
  }
  [[nodiscard]] bool hidden(const Vec3& q, std::size_t of, const std::vector<std::size_t>& candidates) const {
    return std::any_of(candidates.begin(), candidates.end(), [&](std::size_t s) {
      const InsertedShape& other = (*shapes_)[s];
      return s != of && (s < of || other.material == (*shapes_)[of].material) &&
             other.shape->contains({q, q});
    });
  }

  std::shared_ptr<const std::vector<InsertedShape>> shapes_;
  double reach_ = 0;
  Index3 bins_{};
  Vec3 lo_, width_;
  std::vector<std::vector<std::size_t>> near_;  // per bin: shapes whose surroundings overlap it, ascending
};

}  // namespace

ExactSurface surfaces_of(std::shared_ptr<const std::vector<InsertedShape>> shapes, const Grid& grid) {
  const auto surfaces = std::make_shared<const ShapeSurfaces>(std::move(shapes), grid);
  return [surfaces](const Vec3& p, std::int32_t a, std::int32_t b) { return surfaces->nearest(p, a, b); };
}

}  // namespace sculpt
