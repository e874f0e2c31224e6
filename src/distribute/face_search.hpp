#pragma once
// Nodes of exterior faces that lie in or at other exterior faces.
#include <span>
#include <vector>

#include "distribute/faces.hpp"
#include "sculpt/base/vec3.hpp"
#include "sculpt/par/comm.hpp"

namespace sculpt {

struct LoneFace {
  FaceNodes nodes;  // outward
  GlobalId element;
  std::int32_t block;
  std::int32_t unused = 0;
  std::array<Vec3, 4> corner;
};

struct Touch {
  GlobalId node;
  Vec3 place;       // of the node, or of the other if its number is smaller
  GlobalId other;   // the node at the same place; -1: the node lies elsewhere in the face
  double distance;  // from it, in units of the shortest edge there, or from the face
  GlobalId element;
  std::int32_t block;
};

// Distance of a point from a triangle.
[[nodiscard]] double distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

// Collective. Nodes that come closer than `tolerance` to the corner of a face that has them not, in units of
// its shortest edge, or to its inside, in units of the geometric mean of its shortest and longest. faces:
// those of all ranks, each on one.
[[nodiscard]] std::vector<Touch> touching_nodes(const Comm& comm, std::span<const LoneFace> faces,
                                                double tolerance);

}  // namespace sculpt
