#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "input/data_field.hpp"
#include "input/shares.hpp"
#include "sculpt/base/error.hpp"
#include "sculpt/geom/trilinear.hpp"

namespace sculpt {
namespace {

// Lengths are in voxels.
constexpr double kEdge = 1e-9;        // what is closer to the edge of the grid lies in the grid
constexpr double kBox = 1e-7;         // how far the corners of a box may lie from where they should
constexpr double kAbsent = 1e-9;      // smaller shares of a hex are rounding
constexpr double kSmall = 0.5;        // volume of hexes that are interpolated
constexpr double kMargin = 1e-6;      // more than rounding
constexpr double kCentre = 1e-9;      // a point this close to the centre of a voxel is there
constexpr double kSoften = 1e-12;     // of squares of distances
constexpr double kLinesPerFace = 64;  // lines per voxel face

// Lattices of points (i/n, i m/n): successive Fibonacci numbers. Planes along the parameters of a hex, the
// sides of voxels that lie as it does, cut them in as many places as there are points; a square lattice has
// but the square root of that.
struct Lattice {
  int points, multiplier;
};
constexpr std::array<Lattice, 5> kLattices{{{144, 89}, {233, 144}, {377, 233}, {610, 377}, {987, 610}}};

class HexDataField final : public HexField {
 public:
  HexDataField(const Grid& grid, std::unique_ptr<VoxelField> voxels, std::int32_t materials,
               std::int32_t outside)
      : voxels_(std::move(voxels)), shares_(std::max(materials, outside + 1)), outside_(outside) {
    for (std::size_t d = 0; d < 3; ++d) {
      const std::vector<double>& planes = grid.planes[d];
      space_.lo[d] = planes.front();
      space_.hi[d] = planes.back();
      cells_[d] = static_cast<double>(grid.cells[d]);
      size_[d] = (planes.back() - planes.front()) / cells_[d];
      for (std::size_t i = 0; i + 1 < planes.size(); ++i)
        check(std::fabs((planes[i + 1] - planes[i]) / size_[d] - 1) < 1e-6,
              "the materials of hexes need equal voxels");
    }
  }

  void measure(const HexCorners& hex, Fractions& out) override {
    HexCorners p = hex;  // in voxels from the corner of the grid
    for (Vec3& corner : p)
      for (std::size_t d = 0; d < 3; ++d) corner[d] = (corner[d] - space_.lo[d]) / size_[d];
    const Box bounds = bounds_of(p);
    if (is_outside(bounds)) {
      put_outside(out);
    } else if (const auto sole = sole_around(bounds)) {
      out.add(*sole, 1.0);
      out.end_cell();
    } else if (is_small(p)) {
      interpolate(centre_of(p), out);
    } else if (is_box(p, bounds, {kBox, kBox, kBox})) {
      measure_box(bounds_of(hex), bounds, out);
    } else {
      measure_lines(p, out);
    }
  }

 private:
  void put_outside(Fractions& out) const {
    out.add(outside_, 1.0);
    out.end_cell();
  }
  [[nodiscard]] bool is_outside(const Box& bounds) const {
    for (std::size_t d = 0; d < 3; ++d)
      if (bounds.hi[d] <= kEdge || bounds.lo[d] >= cells_[d] - kEdge) return true;
    return false;
  }
  // The material of all voxels that hexes within the bounds can be given.
  [[nodiscard]] std::optional<std::int32_t> sole_around(const Box& bounds) const {
    IndexBox box;
    for (std::size_t d = 0; d < 3; ++d) {
      if (bounds.lo[d] < -kEdge || bounds.hi[d] > cells_[d] + kEdge) return std::nullopt;
      box.lo[d] = static_cast<std::int64_t>(std::clamp(std::floor(bounds.lo[d] - 0.5), 0.0, cells_[d] - 1));
      box.hi[d] =
          static_cast<std::int64_t>(std::clamp(std::floor(bounds.hi[d] + 0.5), 0.0, cells_[d] - 1)) + 1;
    }
    return voxels_->sole_material(box);
  }
  // Small in volume and in every direction.
  [[nodiscard]] static bool is_small(const HexCorners& p) {
    if (!(std::fabs(hex_volume(p)) < kSmall * (1 - kMargin))) return false;
    const std::array<Vec3, 3> edges = mean_edges(p);
    return std::all_of(edges.begin(), edges.end(), [](const Vec3& e) { return norm(e) < 1; });
  }

  // By the inverse square of the distance to the centres of the voxels around the point. At the side of the
  // grid only those inside count; where the point lies level with a centre, those beside it do not count.
  void interpolate(const Vec3& at, Fractions& out) {
    Index3 first{}, last{};
    for (std::size_t d = 0; d < 3; ++d) {
      if (at[d] < -kEdge || at[d] > cells_[d] + kEdge) return put_outside(out);
      const double below = std::floor(at[d] - 0.5), off = at[d] - 0.5 - below;
      const double lo = off > 1 - kCentre ? below + 1 : below, hi = off < kCentre ? below : below + 1;
      first[d] = static_cast<std::int64_t>(std::clamp(lo, 0.0, cells_[d] - 1));
      last[d] = static_cast<std::int64_t>(std::clamp(hi, 0.0, cells_[d] - 1));
    }
    double whole = 0;
    for (const bool counting : {true, false})
      for (std::int64_t k = first[2]; k <= last[2]; ++k)
        for (std::int64_t j = first[1]; j <= last[1]; ++j)
          for (std::int64_t i = first[0]; i <= last[0]; ++i) {
            const double weight = 1 / (square_distance(at, {i, j, k}) + kSoften);
            if (counting)
              whole += weight;
            else
              voxels_->add({i, j, k}, first == last ? 1 : weight / whole, shares_);
          }
    shares_.move_to(out, kAbsent);
  }
  [[nodiscard]] static double square_distance(const Vec3& at, const Index3& voxel) {
    Vec3 off;
    for (std::size_t d = 0; d < 3; ++d) off[d] = at[d] - (static_cast<double>(voxel[d]) + 0.5);
    return dot(off, off);
  }

  // `box`: in the units of the grid; `in_voxels`: the same box.
  void measure_box(Box box, const Box& in_voxels, Fractions& out) {
    double share = 1;  // of the box: in the grid
    for (std::size_t d = 0; d < 3; ++d) {
      const double lo = std::max(in_voxels.lo[d], 0.0), hi = std::min(in_voxels.hi[d], cells_[d]);
      share *= (hi - lo) / (in_voxels.hi[d] - in_voxels.lo[d]);
      box.lo[d] = std::max(box.lo[d], space_.lo[d]);
      box.hi[d] = std::min(box.hi[d], space_.hi[d]);
    }
    if (share >= 1 - kAbsent) return voxels_->measure(box, out);
    Fractions inside;
    voxels_->measure(box, inside);
    for (std::size_t e = 0; e < inside.material.size(); ++e)
      shares_.add(inside.material[e], inside.value[e] * share);
    shares_.add(outside_, 1 - share);
    shares_.move_to(out, kAbsent);
  }

  // Exact along lines in the longest direction of the hex.
  void measure_lines(const HexCorners& p, Fractions& out) {
    const std::array<Vec3, 3> edges = mean_edges(p);
    std::size_t axis = 0;
    for (std::size_t d = 1; d < 3; ++d)
      if (norm(edges[d]) > norm(edges[axis]) * (1 + kMargin)) axis = d;
    double wanted = kLinesPerFace;
    for (std::size_t d = 0; d < 3; ++d)
      if (d != axis) wanted *= std::max(1.0, norm(edges[d]));
    auto lattice = kLattices.begin();
    while (lattice->points < wanted && lattice + 1 != kLattices.end()) ++lattice;

    const HexLines lines(p, axis);
    const double per_volume = 1 / (hex_volume(p) * lattice->points);
    for (int i = 0; i < lattice->points; ++i) {
      const int j = static_cast<int>(std::int64_t{i} * lattice->multiplier % lattice->points);
      follow(lines.at((i + 0.5) / lattice->points, (j + 0.5) / lattice->points), per_volume);
    }
    shares_.move_to(out, kAbsent);
  }

  // Gives the voxels on a line and the outside their volumes along it.
  void follow(const HexLines::Line& line, double per_volume) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    const auto give = [&](double volume, auto&& take) {
      if (volume > 0) take(volume * per_volume);
    };
    const auto give_outside = [&](double volume) {
      give(volume, [&](double share) { shares_.add(outside_, share); });
    };
    double begin = 0, end = 1;  // of the line in the grid
    for (std::size_t d = 0; d < 3; ++d) {
      const double a = line.from[d], s = line.step[d], lo = -kEdge - a, hi = cells_[d] + kEdge - a;
      if (s == 0) {
        if (lo > 0 || hi < 0) end = 0;
      } else {
        begin = std::max(begin, std::min(lo / s, hi / s));
        end = std::min(end, std::max(lo / s, hi / s));
      }
    }
    const double whole = line.volume(1);
    if (!(begin < end)) return give_outside(whole);
    give_outside(line.volume(begin));
    give_outside(whole - line.volume(end));

    Index3 voxel{};
    Vec3 next;  // where the line leaves the voxel through the sides of each axis
    const auto find_next = [&](std::size_t d) {
      const double s = line.step[d], at = static_cast<double>(voxel[d]);
      const bool last = s > 0 ? at + 1 >= cells_[d] : at <= 0;
      next[d] = s == 0 || last ? kNever : (at + (s > 0 ? 1 : 0) - line.from[d]) / s;
    };
    for (std::size_t d = 0; d < 3; ++d) {
      const double at = std::floor(line.from[d] + begin * line.step[d]);
      voxel[d] = static_cast<std::int64_t>(std::clamp(at, 0.0, cells_[d] - 1));
      find_next(d);
    }
    double done = line.volume(begin);
    while (true) {
      const std::size_t d = next.x <= next.y ? (next.x <= next.z ? 0 : 2) : (next.y <= next.z ? 1 : 2);
      const double until = line.volume(std::min(next[d], end));
      give(until - done, [&](double share) { voxels_->add(voxel, share, shares_); });
      done = std::max(done, until);
      if (!(next[d] < end)) return;
      voxel[d] += line.step[d] > 0 ? 1 : -1;
      find_next(d);
    }
  }

  std::unique_ptr<VoxelField> voxels_;
  Shares shares_;
  std::int32_t outside_;
  Box space_;
  Vec3 cells_, size_;  // number of voxels along the axes, edges of a voxel
};

}  // namespace

IndexBox voxels_for(const Grid& grid, const Box& hexes) {
  const Vec3 size = grid.cell_size();
  IndexBox box;
  for (std::size_t d = 0; d < 3; ++d) {
    const double cells = static_cast<double>(grid.cells[d]), origin = grid.planes[d].front();
    const double lo = (hexes.lo[d] - origin) / size[d], hi = (hexes.hi[d] - origin) / size[d];
    const double first = std::floor(lo - 0.5 - kMargin), last = std::floor(hi + 0.5 + kMargin);
    if (!(lo <= hi) || hi < -kMargin || lo > cells + kMargin) return {};
    box.lo[d] = static_cast<std::int64_t>(std::clamp(first, 0.0, cells - 1));
    box.hi[d] = static_cast<std::int64_t>(std::clamp(last, 0.0, cells - 1)) + 1;
  }
  return box;
}

std::unique_ptr<HexField> MaterialSource::hex_field(Fractions fractions, const IndexBox& wanted,
                                                    std::int32_t outside) const {
  const auto largest = std::max_element(fractions.material.begin(), fractions.material.end());
  const std::int32_t materials = largest == fractions.material.end() ? 0 : *largest + 1;
  return std::make_unique<HexDataField>(grid(), data_field(grid(), wanted, std::move(fractions)), materials,
                                        outside);
}

}  // namespace sculpt
