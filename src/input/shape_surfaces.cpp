#include "input/shape_surfaces.hpp"

#include <algorithm>
#include <span>

#include "input/shape_index.hpp"

namespace sculpt {
namespace {

constexpr double kReach = 1.5;  // in cells

class ShapeSurfaces {
 public:
  ShapeSurfaces(std::shared_ptr<const std::vector<InsertedShape>> shapes, const Grid& grid)
      : shapes_(std::move(shapes)),
        reach_(kReach * largest(grid.cell_size())),
        index_(*shapes_, space_of(grid), reach_) {}

  struct Place {
    std::int32_t shape;
    Vec3 point;
  };

  [[nodiscard]] std::optional<Place> nearest(const Vec3& p, std::int32_t a, std::int32_t b) const {
    std::optional<Place> best;
    double least = reach_;
    const std::span<const std::int32_t> candidates = index_.around(p);
    for (const std::int32_t s : candidates) {
      const InsertedShape& shape = at(s);
      if ((shape.material != a && shape.material != b) || !index_.is_near(s, p)) continue;
      const std::optional<Vec3> q = shape.shape->nearest_on_surface(p);
      if (!q || !(norm(*q - p) < least) || hidden(*q, s, candidates)) continue;
      least = norm(*q - p);
      best = Place{s, *q};
    }
    return best;
  }

 private:
  [[nodiscard]] const InsertedShape& at(std::int32_t s) const {
    return (*shapes_)[static_cast<std::size_t>(s)];
  }
  // Every shape that holds q is among the candidates, as q lies within reach of the point they were found
  // for.
  [[nodiscard]] bool hidden(const Vec3& q, std::int32_t of, std::span<const std::int32_t> candidates) const {
    return std::any_of(candidates.begin(), candidates.end(), [&](std::int32_t s) {
      return s != of && (s < of || at(s).material == at(of).material) && index_.is_near(s, q) &&
             at(s).shape->contains({q, q});
    });
  }

  std::shared_ptr<const std::vector<InsertedShape>> shapes_;
  double reach_;
  ShapeIndex index_;
};

}  // namespace

ExactSurface surfaces_of(std::shared_ptr<const std::vector<InsertedShape>> shapes, const Grid& grid) {
  const auto surfaces = std::make_shared<const ShapeSurfaces>(std::move(shapes), grid);
  return [surfaces](const Vec3& p, std::int32_t a, std::int32_t b) -> std::optional<Vec3> {
    const auto found = surfaces->nearest(p, a, b);
    return found ? std::optional(found->point) : std::nullopt;
  };
}

std::function<std::optional<std::int32_t>(const Vec3&, std::int32_t, std::int32_t)> nearest_shape_of(
    std::shared_ptr<const std::vector<InsertedShape>> shapes, const Grid& grid) {
  const auto surfaces = std::make_shared<const ShapeSurfaces>(std::move(shapes), grid);
  return [surfaces](const Vec3& p, std::int32_t a, std::int32_t b) -> std::optional<std::int32_t> {
    const auto found = surfaces->nearest(p, a, b);
    return found ? std::optional(found->shape) : std::nullopt;
  };
}

}  // namespace sculpt
