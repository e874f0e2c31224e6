#include "sculpt/smooth/volume_correction.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sculpt/base/fixed_point.hpp"
#include "sculpt/geom/hex_quality.hpp"

namespace sculpt {
namespace {

constexpr int kRounds = 4, kReturns = 10;
constexpr double kCloseEnough = 1e-5;  // relative error of volume
constexpr double kFarthest = 0.1;      // way of a node per round, in cells
constexpr double kLeastEdge = 0.1;     // in cells; shorter edges may not become shorter

// The fourth corner of the face of a hex with a corner and its k-th and next neighbours (kCornerNeighbours).
constexpr std::array<std::array<std::size_t, 3>, 8> kOpposite = [] {
  std::array<std::array<std::size_t, 3>, 8> opposite{};
  for (std::size_t c = 0; c < 8; ++c)
    for (std::size_t k = 0; k < 3; ++k)
      for (const auto& face : kFaces) {
        std::size_t sum = 0;
        int found = 0;
        for (const int v : face) {
          const auto corner = static_cast<std::size_t>(v);
          sum += corner;
          found += corner == c || v == kCornerNeighbours[c][k] || v == kCornerNeighbours[c][(k + 1) % 3];
        }
        if (found == 3)
          opposite[c][k] = sum - c - static_cast<std::size_t>(kCornerNeighbours[c][k]) -
                           static_cast<std::size_t>(kCornerNeighbours[c][(k + 1) % 3]);
      }
  return opposite;
}();

// Derivative of the volume of a trilinear hex by the position of a corner: the integral of its shape function
// over the three bilinear faces there, times their normals.
Vec3 volume_gradient(const HexCorners& p, std::size_t c) {
  Vec3 sum;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &a = p[static_cast<std::size_t>(kCornerNeighbours[c][(k + 1) % 3])],
               &b = p[static_cast<std::size_t>(kCornerNeighbours[c][k])], &o = p[kOpposite[c][k]];
    const Vec3 u0 = a - p[c], u1 = o - b, v0 = b - p[c], v1 = o - a;
    sum += (1.0 / 36) * (4 * cross(u0, v0) + 2 * cross(u0, v1) + 2 * cross(u1, v0) + cross(u1, v1));
  }
  return sum;
}

class Corrector {
 public:
  Corrector(HexMesh& mesh, std::span<const LocalId> interface, std::span<const double> wanted,
            double least_quality, double most)
      : mesh_(mesh),
        interface_(interface),
        wanted_(wanted.begin(), wanted.end()),
        least_quality_(least_quality),
        cell_(mesh.cell_size.x * mesh.cell_size.y * mesh.cell_size.z) {
    find_hexes();
    const std::vector<double> volume = volumes();
    place_of_.assign(wanted.size(), kNone);
    for (std::size_t m = 0; m < wanted.size(); ++m)
      if (wanted[m] >= 0 && std::fabs(wanted[m] - volume[m] * cell_) <= most * wanted[m])
        place_of_[m] = count_++;
      else if (wanted[m] >= 0)
        leave_alone(m);
  }

  VolumeCorrection run() {
    VolumeCorrection result;
    result.left_alone = left_alone_;
    const std::vector<Vec3> start = mesh_.position;
    for (;; ++result.rounds) {
      const std::vector<double> missing = missing_volumes();
      result.error = 0;
      for (std::size_t m = 0; m < wanted_.size(); ++m)
        if (wanted_[m] > 0)
          result.error = std::max(result.error, std::fabs(missing[at(place_of_[m])]) * cell_ / wanted_[m]);
      if (result.error < kCloseEnough || result.rounds == kRounds) break;
      move(missing);
    }
    for (std::size_t n = 0; n < start.size(); ++n) {
      const Vec3 way = in_cells(mesh_.position[n] - start[n]);
      result.farthest = std::max(result.farthest, norm(way) / mesh_.unit(static_cast<LocalId>(n)));
    }
    result.farthest = comm().max(result.farthest);
    return result;
  }

 private:
  struct Gradient {  // of the volume of one material, at one node, in cells of level 0, as all here
    LocalId place;
    Vec3 by;
  };

  void leave_alone(std::size_t material) {
    wanted_[material] = -1;
    ++left_alone_;
  }
  [[nodiscard]] const Comm& comm() const { return mesh_.node_exchange.comm(); }
  [[nodiscard]] Vec3 in_cells(const Vec3& v) const {
    return {v.x / mesh_.cell_size.x, v.y / mesh_.cell_size.y, v.z / mesh_.cell_size.z};
  }

  // Hexes with an interface node, and the volume of the others, which does not change.
  void find_hexes() {
    far_units_.assign(wanted_.size(), 0);
    slot_of_.assign(mesh_.position.size(), kNone);
    for (LocalId n = 0; n < mesh_.nodes(); ++n)
      if (interface_[at(n)] != kNone) {
        slot_of_[at(n)] = static_cast<LocalId>(nodes_.size());
        nodes_.push_back(n);
      }
    for (LocalId h = 0; h < mesh_.size(); ++h) {
      bool near = false;
      for (const LocalId n : mesh_.hexes[at(h)]) near = near || interface_[at(n)] != kNone;
      if (near)
        near_.push_back(h);
      else
        add_volume(h, far_units_);
    }
  }
  void add_volume(LocalId h, std::vector<std::int64_t>& units) const {
    const std::size_t m = at(mesh_.material[at(h)]);
    if (mesh_.layer[at(h)] == 0 && wanted_[m] >= 0)
      units[m] += to_units(hex_volume(mesh_.corners(h)) / cell_);
  }

  // In cells, of the materials with a wanted volume.
  [[nodiscard]] std::vector<double> volumes() const {
    std::vector<std::int64_t> units = far_units_;
    for (const LocalId h : near_) add_volume(h, units);
    comm().sum(units);
    std::vector<double> volume;
    for (const std::int64_t u : units) volume.push_back(from_units(u));
    return volume;
  }
  [[nodiscard]] std::vector<double> missing_volumes() const {
    const std::vector<double> volume = volumes();
    std::vector<double> missing(at(count_));
    for (std::size_t m = 0; m < wanted_.size(); ++m)
      if (place_of_[m] != kNone) missing[at(place_of_[m])] = wanted_[m] / cell_ - volume[m];
    return missing;
  }

  // Gradients at the nodes_, right at owned ones.
  std::vector<std::vector<Gradient>> gradients() {
    std::vector<std::vector<Gradient>> of(nodes_.size());
    for (const LocalId h : near_) {
      const LocalId place = place_of_[at(mesh_.material[at(h)])];
      if (place == kNone) continue;
      HexCorners p = mesh_.corners(h);
      const Vec3 origin = p[0];
      for (Vec3& corner : p) corner = in_cells(corner - origin);
      for (std::size_t c = 0; c < 8; ++c) {
        const LocalId slot = slot_of_[at(mesh_.hexes[at(h)][c])];
        if (slot == kNone) continue;
        const Vec3 by = volume_gradient(p, c);
        auto& list = of[at(slot)];
        const auto found =
            std::find_if(list.begin(), list.end(), [&](const Gradient& g) { return g.place == place; });
        if (found == list.end())
          list.push_back({place, by});
        else
          found->by += by;
      }
    }
    for (std::size_t i = 0; i < of.size(); ++i)
      for (Gradient& g : of[i]) g.by = freedom(mesh_, nodes_[i], mesh_.position[at(nodes_[i])]).along(g.by);
    return of;
  }

  static double largest_norm(const std::vector<Gradient>& list) {
    double most = 0;
    for (const Gradient& g : list) most = std::max(most, norm(g.by));
    return most;
  }

  void move(const std::vector<double>& missing) {
    const auto of = gradients();
    const std::vector<double> pressure = pressures(of, missing);
    std::vector<Vec3> before = mesh_.position;
    for (std::size_t i = 0; i < of.size(); ++i) {
      const LocalId n = nodes_[i];
      if (of[i].empty() || mesh_.node_owner[at(n)] != comm().rank()) continue;
      const double scale = largest_norm(of[i]);
      if (scale < 1e-6) continue;
      const double unit = mesh_.unit(n), farthest = kFarthest * unit;
      Vec3 way;
      for (const Gradient& g : of[i]) way += (unit * pressure[at(g.place)] / scale) * g.by;
      const double length = norm(way);
      if (length > farthest) way = (farthest / length) * way;
      Vec3& p = mesh_.position[at(n)];
      const Vec3 step = held(mesh_, n, p, scaled(way, mesh_.cell_size));
      for (std::size_t d = 0; d < 3; ++d)
        if (step[d] != 0) p[d] += step[d];
    }
    share_positions(mesh_);
    take_back_harm(before);
  }

  // Solves the symmetric system of the first-order changes by Gauss-Seidel; the same on every rank.
  std::vector<double> pressures(const std::vector<std::vector<Gradient>>& of,
                                const std::vector<double>& missing) {
    const std::size_t n = at(count_);
    std::vector<std::int64_t> units(n * n, 0);
    for (std::size_t i = 0; i < of.size(); ++i) {
      if (of[i].empty() || mesh_.node_owner[at(nodes_[i])] != comm().rank()) continue;
      const double scale = largest_norm(of[i]);
      if (scale < 1e-6) continue;
      for (const Gradient& a : of[i])
        for (const Gradient& b : of[i])
          units[at(a.place) * n + at(b.place)] += to_units(mesh_.unit(nodes_[i]) * dot(a.by, b.by) / scale);
    }
    comm().sum(units);
    std::vector<double> pressure(n, 0);
    for (int i = 0; i < 50; ++i)
      for (std::size_t a = 0; a < n; ++a) {
        double rest = missing[a];
        for (std::size_t b = 0; b < n; ++b)
          if (b != a) rest -= from_units(units[a * n + b]) * pressure[b];
        const double diagonal = from_units(units[a * n + a]);
        pressure[a] = diagonal > 1e-6 ? rest / diagonal : 0;
      }
    return pressure;
  }

  // Nodes of hexes that became too poor go back, until there are no such hexes.
  void take_back_harm(const std::vector<Vec3>& before) {
    const std::vector<HexQuality> was = measure(before);
    std::vector<std::uint8_t> back(mesh_.position.size(), 0);
    for (int i = 0; i < kReturns; ++i) {
      const std::vector<HexQuality> is = measure(mesh_.position);
      std::fill(back.begin(), back.end(), std::uint8_t{0});
      std::int64_t harmed = 0;
      for (std::size_t k = 0; k < near_.size(); ++k) {
        const double quality = is[k / 8].scaled_jacobian[k % 8], edge = is[k / 8].shortest_edge[k % 8];
        const double least = std::min(was[k / 8].scaled_jacobian[k % 8], least_quality_);
        const double least_edge = std::min(was[k / 8].shortest_edge[k % 8],
                                           kLeastEdge * std::cbrt(cell_) * mesh_.hex_unit(near_[k]));
        if (quality >= least && edge >= least_edge) continue;
        harmed += mesh_.layer[at(near_[k])] == 0;
        for (const LocalId n : mesh_.hexes[at(near_[k])]) back[at(n)] = 1;
      }
      if (comm().sum(harmed) == 0) return;
      for (std::size_t n = 0; n < back.size(); ++n)
        if (back[n]) mesh_.position[n] = before[n];
      share_positions(mesh_);
    }
    mesh_.position = before;
  }
  std::vector<HexQuality> measure(const std::vector<Vec3>& position) const {
    std::vector<HexQuality> quality;
    for (std::size_t k = 0; k < near_.size(); k += 8)
      quality.push_back(
          quality_of(mesh_.hexes, position, {near_.data() + k, std::min<std::size_t>(8, near_.size() - k)}));
    return quality;
  }

  HexMesh& mesh_;
  std::span<const LocalId> interface_;
  std::vector<double> wanted_;
  double least_quality_, cell_;
  std::vector<LocalId> place_of_;  // per material: its place among those with a wanted volume
  LocalId count_ = 0;
  int left_alone_ = 0;
  std::vector<LocalId> near_;             // hexes with an interface node
  std::vector<std::int64_t> far_units_;   // volume of the other ones of this rank, per material
  std::vector<LocalId> nodes_, slot_of_;  // interface nodes; per mesh node: its place among them
};

}  // namespace

VolumeCorrection correct_volumes(HexMesh& mesh, std::span<const LocalId> interface,
                                 std::span<const double> wanted, double least_quality, double most) {
  return Corrector(mesh, interface, wanted, least_quality, most).run();
}

}  // namespace sculpt
