#include <algorithm>
#include <cmath>

#include "contour/gradient.hpp"
#include "sculpt/contour/contour.hpp"
#include "sculpt/geom/plane_cut.hpp"
#include "sculpt/vfrac/fractions.hpp"

namespace sculpt {
namespace {

constexpr double kLeastDominance = 1e-3;  // of the assigned material, so that a root exists
constexpr double kNearest = 0.05;         // of a crossing to a cell centre, as part of the distance
constexpr double kPure = 1e-9;            // a cell with less of a material has none of it

// Gradients of the cells beside interfaces, CSR per cell.
struct GradientTable {
  std::vector<std::int64_t> first;  // per local cell, -1 = not computed
  std::vector<std::int32_t> count;
  std::vector<GradientStencil::Entry> entries;

  [[nodiscard]] Vec3 of(LocalId cell, std::int32_t material) const {
    const auto start = static_cast<std::size_t>(first[at(cell)]);
    for (std::size_t e = start; e < start + static_cast<std::size_t>(count[at(cell)]); ++e)
      if (entries[e].material == material) return entries[e].gradient;
    return {};
  }
};

GradientTable gradients(const HexMesh& mesh, const Interfaces& faces, const Fractions& fractions,
                        const NodeHexes& around) {
  GradientTable table;
  table.first.assign(mesh.hexes.size(), -1);
  table.count.assign(mesh.hexes.size(), 0);
  GradientStencil stencil(mesh, fractions, around);
  for (const InterfaceQuad& q : faces.quads) {
    if (mesh.layer[at(q.cell[0])] > 1 || mesh.layer[at(q.cell[1])] > 1) continue;
    for (const LocalId c : q.cell) {
      if (table.first[at(c)] >= 0) continue;
      const auto& entries = stencil.at(c);
      table.first[at(c)] = static_cast<std::int64_t>(table.entries.size());
      table.count[at(c)] = static_cast<std::int32_t>(entries.size());
      table.entries.insert(table.entries.end(), entries.begin(), entries.end());
    }
  }
  return table;
}

// A cell beside an interface: share of material a in what it holds of a and b, the direction from a to b, and
// how far the step to the other cell goes in that direction, in units of the cell; the volume of the cell.
struct Side {
  double share;
  Vec3 normal;
  double step, volume;
  [[nodiscard]] bool mixed() const { return share > kPure && share < 1 - kPure; }
};

// The cubic between two cells that meet at the part `face` of the step between their centres: what cells of
// one size do at their half the larger and the smaller one do at their face.
double root_across(double face, double g0, double g1, double m0, double m1) {
  const double s = hermite_root(g0, g1, 2 * face * m0, 2 * (1 - face) * m1);
  return s < 0.5 ? 2 * face * s : face + (2 * s - 1) * (1 - face);
}

// Where the interface crosses the step between two cell centres, in [0,1]. Cells that are cut by the
// interface know where by their volume: the plane of their gradient that cuts off their share. Between pure
// cells only the gradients tell anything.
double crossing_position(const Side& s0, const Side& s1, double face, double g0, double g1, double m0,
                         double m1) {
  constexpr double kGrazing = 0.1;
  if (s0.mixed() && s1.mixed()) {
    const double ahead = plane_offset(s0.share, s0.normal),
                 behind = -plane_offset(s1.share, s1.normal) * std::cbrt(s1.volume / s0.volume);
    if (ahead + behind > kPure && ahead >= 0 && behind >= 0) return ahead / (ahead + behind);
  } else if (s0.mixed() && s0.step > kGrazing) {
    return plane_offset(s0.share, s0.normal) / s0.step;
  } else if (s1.mixed() && s1.step > kGrazing) {
    return 1 + plane_offset(s1.share, s1.normal) / s1.step;
  }
  return root_across(face, g0, g1, m0, m1);
}

// Edges of the parallelepiped that a cell is but for its bending.
std::array<Vec3, 3> mean_edges(const HexMesh& mesh, LocalId cell) {
  std::array<Vec3, 3> edges;
  const HexCorners p = mesh.corners(cell);
  for (std::size_t c = 0; c < 8; ++c)
    for (std::size_t d = 0; d < 3; ++d) edges[d] += (kCornerOffset[c][d] != 0 ? 0.25 : -0.25) * p[c];
  return edges;
}

// slope: of a - b in the cell; step: to the centre of the cell beyond the interface, or from it.
Side side_of(const HexMesh& mesh, const Fractions& f, LocalId cell, std::int32_t a, std::int32_t b,
             const Vec3& slope, const Vec3& step) {
  const double va = fraction_of(f, cell, a), vb = fraction_of(f, cell, b);
  Side side{va + vb > 0 ? va / (va + vb) : 0.5, {}, 0, 1};
  if (mesh.lattice[0] != 0) {
    side.normal = unit(-scaled(slope, mesh.cell_size));
    side.step = dot(side.normal, scaled(step, mesh.per_cell(mesh.hexes[at(cell)][0])));
    return side;
  }
  const std::array<Vec3, 3> e = mean_edges(mesh, cell);
  const Vec3 fall{-dot(slope, e[0]), -dot(slope, e[1]), -dot(slope, e[2])};
  side.normal = unit(fall);
  side.step = norm(fall) > 0 ? -dot(slope, step) / norm(fall) : 0;
  side.volume = std::fabs(dot(e[0], cross(e[1], e[2])));
  return side;
}

// Where the step between the centres of its cells passes the quad, in [0,1].
double face_position(const HexMesh& mesh, const InterfaceQuad& q, const Vec3& from, const Vec3& step) {
  if (mesh.lattice[0] != 0) return 0.5;
  Vec3 middle;
  for (const LocalId n : q.node) middle += 0.25 * mesh.position[at(n)];
  return std::clamp(dot(middle - from, step) / dot(step, step), 0.2, 0.8);
}

Vec3 centre(const HexMesh& mesh, LocalId cell) {
  Vec3 sum;
  for (const LocalId n : mesh.hexes[at(cell)]) sum += mesh.position[at(n)];
  return 0.125 * sum;
}

}  // namespace

double hermite_root(double g0, double g1, double m0, double m1) {
  if (g0 == g1) return 0.5;
  const double drop = g1 - g0;
  m0 = std::min(0.0, std::max(m0, 3 * drop));
  m1 = std::min(0.0, std::max(m1, 3 * drop));
  double low = 0, high = 1, t = g0 / (g0 - g1);
  for (int i = 0; i < 20; ++i) {
    const double t2 = t * t, t3 = t2 * t;
    const double g =
        (2 * t3 - 3 * t2 + 1) * g0 + (t3 - 2 * t2 + t) * m0 + (3 * t2 - 2 * t3) * g1 + (t3 - t2) * m1;
    if (std::fabs(g) < 1e-12) break;
    (g > 0 ? low : high) = t;
    const double slope = (6 * t2 - 6 * t) * (g0 - g1) + (3 * t2 - 4 * t + 1) * m0 + (3 * t2 - 2 * t) * m1;
    const double newton = slope < 0 ? t - g / slope : -1;
    t = newton > low && newton < high ? newton : 0.5 * (low + high);
  }
  return t;
}

std::vector<Crossing> edge_crossings(const HexMesh& mesh, const Interfaces& faces, const Fractions& fractions,
                                     const NodeHexes& around) {
  const GradientTable table = gradients(mesh, faces, fractions, around);
  std::vector<Crossing> crossings(faces.quads.size());
  for (std::size_t i = 0; i < faces.quads.size(); ++i) {
    const auto& [c0, c1] = faces.quads[i].cell;
    if (table.first[at(c0)] < 0 || table.first[at(c1)] < 0) continue;
    if (mesh.layer[at(c0)] > 1 || mesh.layer[at(c1)] > 1) continue;
    const std::int32_t a = mesh.material[at(c0)], b = mesh.material[at(c1)];
    const double g0 =
        std::max(fraction_of(fractions, c0, a) - fraction_of(fractions, c0, b), kLeastDominance);
    const double g1 =
        std::min(fraction_of(fractions, c1, a) - fraction_of(fractions, c1, b), -kLeastDominance);
    const Vec3 slope0 = table.of(c0, a) - table.of(c0, b), slope1 = table.of(c1, a) - table.of(c1, b);
    const Vec3 from = centre(mesh, c0), step = centre(mesh, c1) - from;
    const Side s0 = side_of(mesh, fractions, c0, a, b, slope0, step),
               s1 = side_of(mesh, fractions, c1, a, b, slope1, step);
    const double t = std::clamp(crossing_position(s0, s1, face_position(mesh, faces.quads[i], from, step), g0,
                                                  g1, dot(slope0, step), dot(slope1, step)),
                                kNearest, 1 - kNearest);
    Vec3 normal = (t - 1) * slope0 - t * slope1;  // downhill in a - b: from a to b
    if (norm(normal) * norm(step) < 1e-6) normal = step;
    normal = unit(normal);
    crossings[i] = {from + t * step, a < b ? normal : -normal};
  }
  return crossings;
}

}  // namespace sculpt
