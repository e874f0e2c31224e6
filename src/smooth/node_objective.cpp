#include "smooth/node_objective.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {
namespace {

// Determinant of the edges at a corner, its normalised value, and the shortest of the three.
struct Corner {
  double determinant, jacobian, shortest;
};

Corner measure(const HexCorners& p, int corner) {
  const auto c = static_cast<std::size_t>(corner);
  Vec3 e[3];
  double length[3];
  for (std::size_t k = 0; k < 3; ++k) {
    e[k] = p[static_cast<std::size_t>(kCornerNeighbours[c][k])] - p[c];
    length[k] = norm(e[k]);
  }
  const double determinant = dot(e[0], cross(e[1], e[2])), lengths = length[0] * length[1] * length[2];
  return {determinant, lengths > 0 ? determinant / lengths : 0.0,
          std::min({length[0], length[1], length[2]})};
}

}  // namespace

void NodeObjective::gather(const HexMesh& mesh, std::span<const std::int32_t> items, LocalId node,
                           double scale, bool size_aware) {
  size_aware_ = size_aware;
  parts_.clear();
  mean_edge_ = 0;
  const Vec3 here = mesh.position[at(node)];
  for (const std::int32_t item : items) {
    Part part{mesh.corners(item / 8), item % 8};
    for (Vec3& p : part.corners) p = scale * (p - here);
    for (const int n : kCornerNeighbours[static_cast<std::size_t>(part.moving)])
      mean_edge_ += norm(part.corners[static_cast<std::size_t>(n)]);
    parts_.push_back(part);
  }
  mean_edge_ /= static_cast<double>(3 * items.size());
}

NodeObjective::Value NodeObjective::at_displacement(const Vec3& y) const {
  Value value{2, 0, 0};
  for (const Part& part : parts_) {
    HexCorners p = part.corners;
    const auto moving = static_cast<std::size_t>(part.moving);
    p[moving] = y;
    const auto& near = kCornerNeighbours[moving];
    double negative_volume = 0;
    for (const int c : {part.moving, near[0], near[1], near[2]}) {
      const Corner corner = measure(p, c);
      double jacobian = corner.jacobian;
      if (size_aware_) jacobian *= std::min(corner.shortest, 1 / corner.shortest);
      value.jacobian = std::min(value.jacobian, jacobian);
      if (corner.jacobian > 0) continue;
      ++value.negative;
      negative_volume += corner.determinant / 6;
    }
    value.negative_volume = std::min(value.negative_volume, negative_volume);
  }
  return value;
}

}  // namespace sculpt
