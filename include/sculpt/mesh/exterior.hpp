#pragma once
// The boundary of a domain that is no box, as the input mesh has it (the report, section 2.12.5.1): facets,
// the surfaces they form, and what its nodes may do without leaving it. Empty in box meshes, where the sides
// of the box tell all that.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sculpt/base/types.hpp"
#include "sculpt/base/vec3.hpp"

namespace sculpt {

// A face of the input mesh on its boundary: two triangles.
struct Facet {
  std::array<Vec3, 4> corner;  // outward by the right-hand rule, from the one with the smallest node id on:
                               // triangles 0 1 2 and 0 2 3
  std::array<GlobalId, 4> node{};  // ids of the corners in the overlay mesh
  GlobalId cell = 0;               // the face that it is there, of the cell that is not kept
  std::int32_t face = 0;
  std::int32_t surface = 0;  // the same on all ranks
  std::uint8_t kept = 0;     // 1: beyond it lie cells that stay as they are (input_mesh_blocks)
  std::uint8_t whole = 0;    // 1: must stay one face of a hex
};

// Where a node of the boundary may go.
struct Hold {
  enum class Kind : std::uint8_t { kPoint, kLine, kSurface };
  Kind kind = Kind::kPoint;
  std::array<Vec3, 3> line{};        // kLine: two segments, 0-1 and 1-2; one may have no length
  std::int32_t first = 0, last = 0;  // kSurface: its facets, in Exterior::patch
};

// A face of a hex on the boundary.
struct ExteriorFace {
  LocalId hex;
  std::int32_t face;  // kFaces index
  LocalId facet;      // that it is a part of
};

struct Exterior {
  static constexpr LocalId kKept = 0;    // the hold of nodes of hexes that stay as they are
  static constexpr LocalId kVertex = 1;  // that of nodes which no move would leave on the boundary

  std::vector<Facet> facets;
  std::vector<ExteriorFace> faces;   // ascending in (hex, face)
  std::vector<LocalId> hold_of;      // per node: index into holds, kNone: moves freely
  std::vector<Hold> holds;           // the first two as above
  std::vector<LocalId> patch;        // facets of the holds
  std::vector<std::uint8_t> curved;  // per surface: 1 = it does not lie in one plane; the same on all ranks
  // The smaller node of the first edge at which more than two faces meet, of those that this rank sees; -1:
  // none.
  GlobalId pinched = -1;
  bool slides = false;  // nodes may slide across the edges between facets of one surface

  [[nodiscard]] bool empty() const { return hold_of.empty(); }
  [[nodiscard]] LocalId facet_at(LocalId hex, int face) const;  // kNone: no face on the boundary
  // Adds a hold on these facets; its index.
  LocalId add_surface(std::span<const LocalId> on);
  LocalId add_line(const std::array<Vec3, 3>& line);
  // The point of a line or surface nearest to p.
  [[nodiscard]] Vec3 nearest(LocalId hold, const Vec3& p) const;
  // Unit vector along a line at p, or across a surface there.
  [[nodiscard]] Vec3 direction(LocalId hold, const Vec3& p) const;
};

// The point of a triangle that is nearest to p (Ericson, Real-Time Collision Detection, 5.1.5). Coordinates
// that the three corners have in common are kept to the last bit.
[[nodiscard]] Vec3 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);
[[nodiscard]] Vec3 nearest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b);
// Unit normal of a facet as a whole.
[[nodiscard]] Vec3 facet_normal(const Facet& facet);
// Whether two facets lie in one plane, as good as that: what slides from one to the other changes no volume.
[[nodiscard]] bool coplanar(const Facet& a, const Facet& b);
// Whether the four corners of a facet lie in one plane.
[[nodiscard]] bool is_flat(const Facet& facet);
// The edge that two facets have in common, by the positions of its ends; false when there is none.
[[nodiscard]] bool common_edge(const Facet& a, const Facet& b, std::array<Vec3, 2>& ends);

}  // namespace sculpt
