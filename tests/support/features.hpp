#pragma once
// Features of simple solids in closed form.
#include <array>
#include <memory>

#include "sculpt/geom/features.hpp"
#include "support/cases.hpp"

namespace sculpt::test {

// A box in any position, around a centre. Surface 2 d is its side across axis d on the low side, 2 d + 1 that
// on the high side.
class BoxFeatures final : public GeometryFeatures {
 public:
  // axes: unit vectors at right angles
  BoxFeatures(const Vec3& centre, const std::array<Vec3, 3>& axes, const Vec3& half)
      : centre_(centre), axes_(axes), half_(half) {}

  [[nodiscard]] bool inside(const Vec3& p) const;
  // Distance of p from the edges.
  [[nodiscard]] double from_edges(const Vec3& p) const;
  [[nodiscard]] std::int32_t surfaces() const override { return 6; }
  [[nodiscard]] std::optional<SurfacePoint> nearest(const Vec3& p, std::int32_t a,
                                                    std::int32_t b) const override;
  [[nodiscard]] std::optional<Vec3> on_surface(std::int32_t surface, const Vec3& p) const override;
  [[nodiscard]] std::optional<Vec3> on_curve(std::int32_t a, std::int32_t b, const Vec3& p) const override;
  [[nodiscard]] std::optional<Corner> at_corner(std::span<const std::int32_t> surfaces,
                                                const Vec3& p) const override;

 private:
  [[nodiscard]] Vec3 local(const Vec3& p) const;
  [[nodiscard]] Vec3 world(const Vec3& q) const;
  [[nodiscard]] Vec3 clamped(const Vec3& q) const;
  [[nodiscard]] double side(std::int32_t surface) const;

  Vec3 centre_;
  std::array<Vec3, 3> axes_;
  Vec3 half_;
};

// One that is turned so that none of its edges is parallel to an axis.
[[nodiscard]] std::shared_ptr<const BoxFeatures> turned_box(const Vec3& centre, const Vec3& half);
// The same as a material 1 in material 0, by 8^3 points per cell.
[[nodiscard]] Case box_case(const Index3& cells, const BoxFeatures& box);

}  // namespace sculpt::test
