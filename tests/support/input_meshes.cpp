#include "support/input_meshes.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "kinds.hpp"
#include "pipeline/unstructured_overlay.hpp"
#include "sculpt/brep/exterior.hpp"
#include "sculpt/distribute/unstructured.hpp"
#include "sculpt/filter/filter.hpp"
#include "sculpt/mesh/edge_walk.hpp"
#include "sculpt/mesh/edit.hpp"
#include "sculpt/vfrac/fractions.hpp"
#include "support/cases.hpp"

namespace sculpt::test {
namespace {

constexpr int kSamples = 4;  // per axis of a cell

Vec3 point_in(const HexCorners& p, double u, double v, double w) {
  Vec3 sum;
  for (std::size_t c = 0; c < 8; ++c) {
    const auto& o = kCornerOffset[c];
    sum += (o[0] == 1 ? u : 1 - u) * (o[1] == 1 ? v : 1 - v) * (o[2] == 1 ? w : 1 - w) * p[c];
  }
  return sum;
}

// Points inside the mesh: in elements picked by chance.
std::vector<Vec3> grain_centres(const InputMeshCase& input) {
  std::vector<Vec3> centres;
  for (std::uint64_t g = 0; g < static_cast<std::uint64_t>(input.grains); ++g) {
    const auto& corner = input.mesh.corner[scatter(input.seed, g) % input.mesh.corner.size()];
    HexCorners p;
    for (std::size_t c = 0; c < 8; ++c) p[c] = input.mesh.position[static_cast<std::size_t>(corner[c])];
    centres.push_back(point_in(p, scatter_unit(input.seed, 100 + g), scatter_unit(input.seed, 200 + g),
                               scatter_unit(input.seed, 300 + g)));
  }
  return centres;
}

std::size_t nearest(const std::vector<Vec3>& points, const Vec3& p) {
  return static_cast<std::size_t>(
      std::min_element(points.begin(), points.end(),
                       [&](const Vec3& a, const Vec3& b) { return dot(a - p, a - p) < dot(b - p, b - p); }) -
      points.begin());
}

// Part of each grain in a cell. With blocks the first grain is a ball and what is left the block's.
std::vector<double> parts(const InputMeshCase& input, const std::vector<Vec3>& centres,
                          const HexCorners& cell) {
  std::vector<double> part(centres.size(), 0);
  const int samples = input.pure ? 1 : kSamples;
  for (int i = 0; i < samples; ++i)
    for (int j = 0; j < samples; ++j)
      for (int k = 0; k < samples; ++k)
        part[nearest(centres, point_in(cell, (i + 0.5) / samples, (j + 0.5) / samples,
                                       (k + 0.5) / samples))] += 1.0 / (samples * samples * samples);
  return part;
}

Fractions fractions_of(const InputMeshCase& input, const HexMesh& cells,
                       const std::vector<std::int32_t>& block) {
  const std::vector<Vec3> centres = grain_centres(input);
  Fractions f;
  for (LocalId c = 0; c < cells.size(); ++c) {
    if (cells.layer[at(c)] != 0) continue;
    const std::vector<double> part = parts(input, centres, cells.corners(c));
    if (input.blocks) {
      if (part[0] > 0) f.add(0, part[0]);
      if (part[0] < 1) f.add(material_of_kept(input, block[at(c)]), 1 - part[0]);
    } else {
      for (std::size_t g = 0; g < part.size(); ++g)
        if (part[g] > 0) f.add(static_cast<std::int32_t>(g), part[g]);
    }
    f.end_cell();
  }
  return f;
}

double distance_to(const Facet& f, const Vec3& p) {
  return std::min(norm(nearest_on_triangle(p, f.corner[0], f.corner[1], f.corner[2]) - p),
                  norm(nearest_on_triangle(p, f.corner[0], f.corner[2], f.corner[3]) - p));
}

}  // namespace

WholeMesh generated(const std::string& kind, std::vector<std::string> options) {
  hexmesh::Options words(std::move(options));
  const hexmesh::Mesh from = hexmesh::make_mesh(hexmesh::kind_named(kind), words);
  WholeMesh mesh;
  mesh.name = kind;
  mesh.position = from.node;
  mesh.block = from.block;
  for (const Hex& hex : from.hex) {
    auto& corner = mesh.corner.emplace_back();
    std::copy(hex.begin(), hex.end(), corner.begin());
  }
  mesh.value.assign(2 * mesh.corner.size(), 0);
  return mesh;
}

InputCells input_cells(const Comm& comm, const WholeMesh& mesh, int layers, std::uint64_t seed) {
  UnstructuredMesh full = unstructured_mesh(comm, dealt(comm, mesh, seed), layers);
  set_units(full.cells);
  full.cells.material.assign(full.cells.hexes.size(), 0);
  return {std::move(full.cells), std::move(full.block)};
}

Overlay input_overlay(const Comm& comm, const InputMeshCase& input, int layers) {
  InputCells full = input_cells(comm, input.mesh, layers, input.dealt);
  Overlay o;
  o.cells = std::move(full.cells);
  HexMesh& cells = o.cells;
  std::vector<std::uint8_t> kept(cells.hexes.size()), others(cells.hexes.size());
  for (std::size_t c = 0; c < kept.size(); ++c) {
    kept[c] = std::find(input.keep.begin(), input.keep.end(), full.block[c]) != input.keep.end();
    others[c] = !kept[c];
  }
  ExteriorOptions options;
  options.feature_angle = input.feature_angle;
  options.slides = input.slides;
  find_exterior(comm, cells, face_neighbours(cells), kept, options);
  if (!input.keep.empty()) {
    o.kept = cells;
    for (std::size_t c = 0; c < kept.size(); ++c)
      o.kept->material[c] = material_of_kept(input, full.block[c]);
    o.kept->exterior = {};
    (void)remove_hexes(comm, *o.kept, others);
    compact(full.block, remove_hexes(comm, cells, kept));
  }
  o.fractions = with_ghosts(cells, fractions_of(input, cells, full.block));
  assign_materials(cells, o.fractions, face_neighbours(cells));
  if (input.blocks) {
    const std::int32_t blocks = *std::max_element(input.mesh.block.begin(), input.mesh.block.end()) + 1;
    o.is_block.assign(static_cast<std::size_t>(input.grains + blocks), 1);
    std::fill_n(o.is_block.begin(), input.grains, std::uint8_t{0});
  }
  return o;
}

StagesResult run_stages(const Comm& comm, const InputMeshCase& input, const StageOptions& options) {
  return run_stages(comm, input_overlay(comm, input, options.layers.ghost_layers()), input.pure, options);
}

std::string exterior_problem(const HexMesh& mesh, double distance, bool closed) {
  const Exterior& exterior = mesh.exterior;
  if (exterior.hold_of.size() != mesh.position.size()) return "not every node has its hold";
  std::map<std::int32_t, std::vector<LocalId>> facets_of;  // surfaces
  for (std::size_t f = 0; f < exterior.facets.size(); ++f)
    facets_of[exterior.facets[f].surface].push_back(static_cast<LocalId>(f));
  const FaceNeighbours neighbours = face_neighbours(mesh);
  std::size_t single = 0;
  for (LocalId h = 0; h < mesh.size(); ++h)
    for (int f = 0; f < 6; ++f) {
      const bool alone = neighbours[at(h)][static_cast<std::size_t>(f)] == kNone;
      const bool listed = exterior.facet_at(h, f) != kNone;
      single += alone && listed;
      if (listed && !alone) return fmt::format("face {} of hex {} lies inside", f, mesh.hex_id[at(h)]);
      if (alone && !listed && closed)
        return fmt::format("face {} of hex {} belongs to no facet", f, mesh.hex_id[at(h)]);
    }
  if (single != exterior.faces.size()) return "a face of the exterior is listed twice";
  for (const ExteriorFace& f : exterior.faces) {
    const Facet& own = exterior.facets[at(f.facet)];
    for (const LocalId n : face_nodes(mesh, {f.hex, f.face})) {
      const Vec3& p = mesh.position[at(n)];
      if (exterior.hold_of[at(n)] == kNone) return fmt::format("node {} is not held", mesh.node_id[at(n)]);
      double least = distance_to(own, p);
      for (const LocalId other : facets_of[own.surface]) {
        if (least <= distance) break;
        least = std::min(least, distance_to(exterior.facets[at(other)], p));
      }
      if (least > distance)
        return fmt::format("node {} is {} away from surface {}", mesh.node_id[at(n)], least, own.surface);
    }
  }
  return {};
}

}  // namespace sculpt::test
