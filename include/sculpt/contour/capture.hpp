#pragma once
// Ties the interface to the sharp curves and corners of a faceted geometry (option capture): every quad gets
// the surface of the geometry that it is nearest to; edges between quads of different surfaces become curves
// of the mesh, nodes where three surfaces meet its vertices; they go to the curves and corners of the
// geometry.
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "sculpt/brep/interfaces.hpp"
#include "sculpt/geom/features.hpp"
#include "sculpt/mesh/hex_mesh.hpp"

namespace sculpt {

// What an interface node is tied to.
struct Tie {
  enum class Kind : std::uint8_t { kFree, kSurface, kCurve, kCorner };
  Kind kind = Kind::kFree;
  std::int32_t a = kNone, b = kNone;  // the surface; those on both sides of the curve
  Vec3 corner{};
};

struct Capture {
  std::shared_ptr<const GeometryFeatures> geometry;  // null: nothing is captured
  std::vector<Tie> tie;                              // per interface node; right at owned ones
  std::int64_t curve_nodes = 0, corner_nodes = 0;    // on all ranks

  // The point that an interface node at p is tied to.
  [[nodiscard]] std::optional<Vec3> onto(std::size_t interface_node, const Vec3& p) const;
};

// Collective. Divides the surfaces of the interface (Interfaces::part, kNone: far from the geometry). only:
// the one surface that is captured, kNone: all. Interface nodes stand where the contour has them.
[[nodiscard]] Capture capture_geometry(const HexMesh& mesh, Interfaces& faces,
                                       std::shared_ptr<const GeometryFeatures> geometry, std::int32_t only);

}  // namespace sculpt
