#pragma once
// The smooth surfaces of a faceted geometry, the sharp curves where two of them meet, and its corners: what a
// mesh that captures the geometry is tied to. Pure.
#include <cstdint>
#include <optional>
#include <span>

#include "sculpt/base/vec3.hpp"

namespace sculpt {

// Surfaces and corners have numbers, from 0, that are the same on all ranks. Answers depend on the geometry
// and the question only. Nothing is found beyond a reach of a few cells.
class GeometryFeatures {
 public:
  virtual ~GeometryFeatures() = default;

  struct SurfacePoint {
    std::int32_t surface;
    Vec3 point;
  };
  struct Corner {
    std::int32_t corner;
    Vec3 point;
  };

  // How many there are.
  [[nodiscard]] virtual std::int32_t surfaces() const = 0;
  // The point nearest to p on the boundary of the solids of material a or b (dense indices).
  [[nodiscard]] virtual std::optional<SurfacePoint> nearest(const Vec3& p, std::int32_t a,
                                                            std::int32_t b) const = 0;
  // The nearest point of one surface.
  [[nodiscard]] virtual std::optional<Vec3> on_surface(std::int32_t surface, const Vec3& p) const = 0;
  // The nearest point of the curves where two different surfaces meet.
  [[nodiscard]] virtual std::optional<Vec3> on_curve(std::int32_t a, std::int32_t b, const Vec3& p) const = 0;
  // The nearest corner of those at which all these surfaces meet; at least three, ascending.
  [[nodiscard]] virtual std::optional<Corner> at_corner(std::span<const std::int32_t> surfaces,
                                                        const Vec3& p) const = 0;
};

}  // namespace sculpt
