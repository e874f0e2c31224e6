#include "sculpt/geom/trilinear.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {
namespace {

// The corner whose parameter a is 0 or 1 on axis `axis`, likewise u and v on the two axes after it.
std::size_t corner(std::size_t axis, int a, int u, int v) {
  std::array<int, 3> bit{};
  bit[axis] = a;
  bit[(axis + 1) % 3] = u;
  bit[(axis + 2) % 3] = v;
  const auto found = std::find(kCornerOffset.begin(), kCornerOffset.end(), bit);
  return static_cast<std::size_t>(found - kCornerOffset.begin());
}

}  // namespace

HexLines::HexLines(const HexCorners& p, std::size_t axis) {
  std::array<std::array<Vec3, 4>, 2> face;
  for (int a = 0; a < 2; ++a) {
    const Vec3 &p00 = p[corner(axis, a, 0, 0)], &p10 = p[corner(axis, a, 1, 0)],
               &p01 = p[corner(axis, a, 0, 1)], &p11 = p[corner(axis, a, 1, 1)];
    face[static_cast<std::size_t>(a)] = {p00, p10 - p00, p01 - p00, (p11 - p10) - (p01 - p00)};
  }
  from_ = face[0];
  for (std::size_t n = 0; n < 4; ++n) step_[n] = face[1][n] - face[0][n];
}

HexLines::Line HexLines::at(double u, double v) const {
  const auto value = [&](const std::array<Vec3, 4>& c) {
    return c[0] + u * c[1] + v * c[2] + (u * v) * c[3];
  };
  Line line;
  line.from = value(from_);
  line.step = value(step_);
  const Vec3 along_u = from_[1] + v * from_[3], more_u = step_[1] + v * step_[3];
  const Vec3 along_v = from_[2] + u * from_[3], more_v = step_[2] + u * step_[3];
  line.a = dot(line.step, cross(along_u, along_v));
  line.b = dot(line.step, cross(along_u, more_v) + cross(more_u, along_v));
  line.c = dot(line.step, cross(more_u, more_v));
  return line;
}

std::array<Vec3, 3> mean_edges(const HexCorners& p) {
  std::array<Vec3, 3> edge{};
  for (std::size_t c = 0; c < 8; ++c)
    for (std::size_t d = 0; d < 3; ++d) edge[d] += (kCornerOffset[c][d] != 0 ? 0.25 : -0.25) * p[c];
  return edge;
}

Vec3 centre_of(const HexCorners& p) {
  Vec3 sum;
  for (const Vec3& corner : p) sum += corner;
  return 0.125 * sum;
}

Box bounds_of(const HexCorners& p) {
  Box box{p[0], p[0]};
  for (const Vec3& corner : p)
    for (std::size_t d = 0; d < 3; ++d) {
      box.lo[d] = std::min(box.lo[d], corner[d]);
      box.hi[d] = std::max(box.hi[d], corner[d]);
    }
  return box;
}

bool is_box(const HexCorners& p, const Box& bounds, const Vec3& tolerance) {
  std::array<unsigned, 8> code{};  // bit d: at the upper end of axis d
  for (std::size_t d = 0; d < 3; ++d) {
    if (!(bounds.hi[d] - bounds.lo[d] > 2 * tolerance[d])) return false;
    for (std::size_t c = 0; c < 8; ++c) {
      const bool low = p[c][d] - bounds.lo[d] <= tolerance[d], high = bounds.hi[d] - p[c][d] <= tolerance[d];
      if (!low && !high) return false;
      if (high) code[c] |= 1U << d;
    }
  }
  // Each edge along one axis, the three at a corner along different ones.
  for (std::size_t c = 0; c < 8; ++c) {
    unsigned axes = 0;
    for (const int n : kCornerNeighbours[c]) {
      const unsigned change = code[c] ^ code[static_cast<std::size_t>(n)];
      if (change != 1 && change != 2 && change != 4) return false;
      axes |= change;
    }
    if (axes != 7) return false;
  }
  return true;
}

}  // namespace sculpt
