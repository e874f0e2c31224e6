#include "sculpt/quality/fidelity.hpp"

#include <algorithm>
#include <cmath>

#include "sculpt/base/fixed_point.hpp"

namespace sculpt {

Displacement displacement(const Comm& comm, const HexMesh& mesh, const InterfaceTrack& track) {
  std::array<std::int64_t, 3> sums{};  // nodes; distances in fixed point
  double from_contour = 0, from_target = 0;
  auto node = mesh.node_id.begin();
  for (std::size_t i = 0; i < track.node.size(); ++i) {
    node = std::lower_bound(node, mesh.node_id.end(), track.node[i]);
    if (node == mesh.node_id.end() || *node != track.node[i]) continue;
    const auto n = static_cast<LocalId>(node - mesh.node_id.begin());
    const Vec3 &p = mesh.position[at(n)], in_cells = mesh.per_cell(n);
    const double c = norm(scaled(p - track.contoured[i], in_cells)),
                 t = norm(scaled(p - track.smoothed[i], in_cells));
    ++sums[0];
    sums[1] += to_units(c);
    sums[2] += to_units(t);
    from_contour = std::max(from_contour, c);
    from_target = std::max(from_target, t);
  }
  comm.sum(sums);
  Displacement d;
  d.nodes = sums[0];
  d.largest_from_contour = comm.max(from_contour);
  d.largest_from_target = comm.max(from_target);
  if (d.nodes == 0) return d;
  d.mean_from_contour = from_units(sums[1]) / static_cast<double>(d.nodes);
  d.mean_from_target = from_units(sums[2]) / static_cast<double>(d.nodes);
  return d;
}

std::vector<double> input_volumes(const Comm& comm, const HexMesh& cells, const Fractions& fractions,
                                  std::size_t materials) {
  std::vector<std::int64_t> units(materials, 0);
  for (std::size_t c = 0; c < cells.hexes.size(); ++c) {
    if (cells.layer[c] != 0) continue;
    const double volume = cells.volume_in_cells(static_cast<LocalId>(c));
    for (auto e = static_cast<std::size_t>(fractions.offset[c]);
         e < static_cast<std::size_t>(fractions.offset[c + 1]); ++e)
      units[at(fractions.material[e])] += to_units(volume * fractions.value[e]);
  }
  comm.sum(units);
  std::vector<double> volume;
  for (const std::int64_t u : units) volume.push_back(from_units(u));
  return volume;
}

double volume_moved(const QualitySummary& summary, std::span<const double> input,
                    std::optional<std::int32_t> unmeshed) {
  double domain = 0, meshed = 0, moved = 0, left_out = 0;
  for (std::size_t m = 0; m < input.size(); ++m) {
    const double in_mesh = m < summary.materials.size() ? summary.materials[m].volume : 0;
    domain += input[m];
    meshed += in_mesh;
    if (unmeshed && *unmeshed == static_cast<std::int32_t>(m))
      left_out = input[m];
    else
      moved += std::fabs(in_mesh - input[m]);
  }
  moved += std::fabs(domain - meshed - left_out);
  return domain > 0 ? 50 * moved / domain : 0;
}

}  // namespace sculpt
