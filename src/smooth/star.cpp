#include "smooth/star.hpp"

#include <algorithm>
#include <limits>

namespace sculpt {
namespace {

constexpr double kLengthRatio = 1.0 / 6;                 // shortest target length of a corner, of its longest
constexpr double kLengthFloor = 0.2;                     // shortest target length, in cells
constexpr double kThirdRoot27 = 0.19245008972987525484;  // 3^(-3/2): s = 1 for an orthogonal corner
constexpr double kTiny = 1e-300;

// Edge neighbours n0, n1, n2 of each corner and the diagonal nodes of its faces (n0,n1), (n1,n2), (n2,n0).
constexpr std::array<std::array<int, 6>, 8> kStarNodes = [] {
  std::array<std::array<int, 6>, 8> nodes{};
  for (std::size_t c = 0; c < 8; ++c)
    for (std::size_t k = 0; k < 3; ++k) {
      nodes[c][k] = kCornerNeighbours[c][k];
      const auto& a = kCornerNeighbours[static_cast<std::size_t>(kCornerNeighbours[c][k])];
      const auto& b = kCornerNeighbours[static_cast<std::size_t>(kCornerNeighbours[c][(k + 1) % 3])];
      for (const int x : a)
        for (const int y : b)
          if (x == y && x != static_cast<int>(c)) nodes[c][3 + k] = x;
    }
  return nodes;
}();

// Inverse target lengths of the three edges of a corner, and their product, by one division.
SCULPT_INLINE Lanes inverse_targets(const Lanes (&length)[3], bool unit, Lanes (&inverse)[3]) {
  if (unit) {
    for (Lanes& i : inverse) i = splat(1);
    return splat(1);
  }
  const Lanes least_length =
      largest(splat(kLengthRatio) * largest(largest(length[0], length[1]), length[2]), splat(kLengthFloor));
  const Lanes a = largest(length[0], least_length), b = largest(length[1], least_length),
              c = largest(length[2], least_length);
  const Lanes ab = a * b, product = 1.0 / (ab * c);
  inverse[0] = product * (b * c);
  inverse[1] = product * (a * c);
  inverse[2] = product * ab;
  return product;
}

// Tetrahedron with its apex at the moving node.
SCULPT_INLINE void apex_tet(const Vec3Lanes (&e)[3], const Lanes (&length)[3], bool unit, TetLanes& t) {
  Lanes inverse[3];
  const Lanes product = inverse_targets(length, unit, inverse);
  const Vec3Lanes c01 = cross(e[0], e[1]), c12 = cross(e[1], e[2]), c20 = cross(e[2], e[0]);
  t.gx = -product * (c12.x + c20.x + c01.x);
  t.gy = -product * (c12.y + c20.y + c01.y);
  t.gz = -product * (c12.z + c20.z + c01.z);
  t.d0 = product * dot(e[0], c12);
  t.w = t.sx = t.sy = t.sz = t.s2 = splat(0);
  for (int k = 0; k < 3; ++k) {
    const Lanes w = inverse[k] * inverse[k];
    t.w += w;
    t.sx += w * e[k].x;
    t.sy += w * e[k].y;
    t.sz += w * e[k].z;
    t.s2 += w * (length[k] * length[k]);
  }
  t.fixed = product;
}

// Tetrahedron with its apex at a neighbour; edge 0 runs to the moving node, e[1] and e[2] to the two diagonal
// nodes.
SCULPT_INLINE void leaf_tet(const Vec3Lanes (&e)[3], const Lanes& length0, bool unit, TetLanes& t) {
  const Lanes length[3] = {length0, root(dot(e[1], e[1])), root(dot(e[2], e[2]))};
  Lanes inverse[3];
  const Lanes product = inverse_targets(length, unit, inverse);
  const Vec3Lanes c12 = cross(e[1], e[2]);
  t.gx = product * c12.x;
  t.gy = product * c12.y;
  t.gz = product * c12.z;
  t.d0 = product * dot(e[0], c12);
  t.w = inverse[0] * inverse[0];
  t.sx = -t.w * e[0].x;
  t.sy = -t.w * e[0].y;
  t.sz = -t.w * e[0].z;
  const Lanes rest1 = inverse[1] * length[1], rest2 = inverse[2] * length[2];
  t.s2 = t.w * (length0 * length0) + rest1 * rest1 + rest2 * rest2;
  t.fixed = product * (length[1] * length[2]);
}

// Positions of one star node in eight hexes, relative to the moving node and scaled.
SCULPT_INLINE Vec3Lanes positions(const Vec3* const (&p)[8], const Vec3& here, const Vec3& scale) {
  const Lanes x{p[0]->x, p[1]->x, p[2]->x, p[3]->x, p[4]->x, p[5]->x, p[6]->x, p[7]->x};
  const Lanes y{p[0]->y, p[1]->y, p[2]->y, p[3]->y, p[4]->y, p[5]->y, p[6]->y, p[7]->y};
  const Lanes z{p[0]->z, p[1]->z, p[2]->z, p[3]->z, p[4]->z, p[5]->z, p[6]->z, p[7]->z};
  return {(x - here.x) * scale.x, (y - here.y) * scale.y, (z - here.z) * scale.z};
}

// Fills a batch from up to eight hexes and returns the shortest edge at the moving node.
SCULPT_KERNEL double build_batch(StarBatch& batch, const Hex* hexes, const Vec3* position,
                                 const std::int32_t* items, std::size_t count, const Vec3& here,
                                 const Vec3& scale, bool unit) {
  Vec3Lanes node[6];
  for (std::size_t k = 0; k < 6; ++k) {
    const Vec3* p[8];
    for (std::size_t l = 0; l < 8; ++l) {
      const std::int32_t item = items[l < count ? l : 0];  // the padding repeats the first hex
      p[l] = position +
             hexes[item / 8][static_cast<std::size_t>(kStarNodes[static_cast<std::size_t>(item % 8)][k])];
    }
    node[k] = positions(p, here, scale);
  }
  for (std::size_t l = 0; l < 8; ++l) batch.used[l] = l < count ? 1.0 : 0.0;
  const Vec3Lanes near[3] = {node[0], node[1], node[2]};
  Lanes length[3];
  for (int k = 0; k < 3; ++k) {
    batch.neighbour[k][0] = near[k].x;
    batch.neighbour[k][1] = near[k].y;
    batch.neighbour[k][2] = near[k].z;
    length[k] = root(dot(near[k], near[k]));
  }
  apex_tet(near, length, unit, batch.tet[0]);
  const Vec3Lanes zero{splat(0), splat(0), splat(0)};
  for (int k = 0; k < 3; ++k) {
    const Vec3Lanes e[3] = {zero - near[k], node[3 + (k + 2) % 3] - near[k], node[3 + k] - near[k]};
    leaf_tet(e, length[k], unit, batch.tet[k + 1]);
  }
  return least(smallest(smallest(length[0], length[1]), length[2]));
}

// (D + sqrt(eps^2 + D^2)) / 2 without cancellation for D < 0.
SCULPT_INLINE Lanes positive_part(const Lanes& d, const Lanes& r, double eps2) {
  return (d > 0 ? 0.5 * (d + r) : (0.5 * eps2) / (r - d + kTiny)) + kTiny;
}

SCULPT_INLINE Lanes to_power(Lanes s, int r) {
  for (; r > 1; r /= 2) s = s * s;
  return s;
}

SCULPT_KERNEL void add_derivatives(const StarBatch& b, int r, double eps, Lanes* total) {
  const double eps2 = eps * eps, power = r;
  const Lanes one = splat(1), zero = splat(0);
  for (const TetLanes& t : b.tet) {
    const Lanes n = t.s2, big = root(eps2 + t.d0 * t.d0), chi = positive_part(t.d0, big, eps2);
    const Lanes inverse_big = 1.0 / (big + kTiny), inverse_chi = 1.0 / chi, inverse_n = 1.0 / n;
    const Lanes sr = to_power(kThirdRoot27 * n * root(n) * inverse_chi, r) * b.used;
    const Lanes c1 = (0.5 + 0.5 * t.d0 * inverse_big) * inverse_chi;
    const Lanes c2 = 0.5 * eps2 * inverse_big * inverse_big * inverse_big * inverse_chi;
    const Vec3Lanes gn{-2.0 * t.sx, -2.0 * t.sy, -2.0 * t.sz};
    const Lanes share = 1.5 * inverse_n;
    const Vec3Lanes l{share * gn.x - c1 * t.gx, share * gn.y - c1 * t.gy, share * gn.z - c1 * t.gz};
    const Lanes a = sr * power, diagonal = a * 3.0 * t.w * inverse_n, hn = -a * share * inverse_n,
                hd = -a * (c2 - c1 * c1), hl = a * power;
    total[0] += sr;
    total[1] += a * l.x;
    total[2] += a * l.y;
    total[3] += a * l.z;
    total[4] += hl * l.x * l.x + hn * gn.x * gn.x + hd * t.gx * t.gx + diagonal;
    total[5] += hl * l.x * l.y + hn * gn.x * gn.y + hd * t.gx * t.gy;
    total[6] += hl * l.x * l.z + hn * gn.x * gn.z + hd * t.gx * t.gz;
    total[7] += hl * l.y * l.y + hn * gn.y * gn.y + hd * t.gy * t.gy + diagonal;
    total[8] += hl * l.y * l.z + hn * gn.y * gn.z + hd * t.gy * t.gz;
    total[9] += hl * l.z * l.z + hn * gn.z * gn.z + hd * t.gz * t.gz + diagonal;
    total[10] += (t.d0 <= 0 ? one : zero) * b.used;
  }
}

SCULPT_KERNEL void add_values(const StarBatch& b, const double* y, int r, double eps, Lanes* total) {
  const double eps2 = eps * eps, yy = y[0] * y[0] + y[1] * y[1] + y[2] * y[2];
  const Lanes one = splat(1), zero = splat(0);
  for (const TetLanes& t : b.tet) {
    const Lanes d = t.gx * y[0] + t.gy * y[1] + t.gz * y[2] + t.d0;
    const Lanes n = largest(t.w * yy - 2.0 * (t.sx * y[0] + t.sy * y[1] + t.sz * y[2]) + t.s2, zero);
    const Lanes chi = positive_part(d, root(eps2 + d * d), eps2);
    total[0] += to_power(kThirdRoot27 * n * root(n) / chi, r) * b.used;
    total[1] += (d <= 0 ? one : zero) * b.used;
  }
}

SCULPT_KERNEL void lower_shape(const StarBatch& b, const double* y, Lanes* lowest) {
  Lanes length[3];
  for (int k = 0; k < 3; ++k) {
    const Vec3Lanes e{b.neighbour[k][0] - y[0], b.neighbour[k][1] - y[1], b.neighbour[k][2] - y[2]};
    length[k] = root(dot(e, e));
    lowest[1] = smallest(lowest[1], length[k]);
  }
  for (int k = 0; k < 4; ++k) {
    const TetLanes& t = b.tet[k];
    const Lanes d = t.gx * y[0] + t.gy * y[1] + t.gz * y[2] + t.d0;
    const Lanes moving = k == 0 ? length[0] * length[1] * length[2] : length[k - 1];
    lowest[0] = smallest(lowest[0], d / (t.fixed * moving + kTiny));
  }
}

}  // namespace

void Star::gather(const std::vector<Hex>& hexes, const std::vector<Vec3>& position,
                  std::span<const std::int32_t> items, LocalId node, const Vec3& scale, Target target) {
  used_ = (items.size() + 7) / 8;
  tets_ = static_cast<int>(4 * items.size());
  if (batches_.size() < used_) batches_.resize(used_);
  const Vec3 here = position[static_cast<std::size_t>(node)];
  shortest_edge_ = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < used_; ++b)
    shortest_edge_ =
        std::min(shortest_edge_, build_batch(batches_[b], hexes.data(), position.data(), items.data() + 8 * b,
                                             std::min<std::size_t>(8, items.size() - 8 * b), here, scale,
                                             target == Target::kUnit));
}

Derivatives Star::derivatives(int r, double eps) const {
  Lanes total[11];
  for (Lanes& t : total) t = splat(0);
  for (std::size_t b = 0; b < used_; ++b) add_derivatives(batches_[b], r, eps, total);
  Derivatives d;
  d.energy = sum(total[0]);
  d.gradient = {sum(total[1]), sum(total[2]), sum(total[3])};
  for (int h = 0; h < 6; ++h) d.hessian[h] = sum(total[4 + h]);
  d.not_positive = static_cast<int>(sum(total[10]));
  return d;
}

Star::Value Star::value(const Vec3& y, int r, double eps) const {
  Lanes total[2] = {splat(0), splat(0)};
  for (std::size_t b = 0; b < used_; ++b) add_values(batches_[b], &y.x, r, eps, total);
  return {sum(total[0]), static_cast<int>(sum(total[1]))};
}

Star::Shape Star::shape(const Vec3& y) const {
  Lanes lowest[2] = {splat(2), splat(std::numeric_limits<double>::infinity())};
  for (std::size_t b = 0; b < used_; ++b) lower_shape(batches_[b], &y.x, lowest);
  return {least(lowest[0]), least(lowest[1])};
}

}  // namespace sculpt
