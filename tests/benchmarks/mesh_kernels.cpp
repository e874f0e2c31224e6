#include <benchmark/benchmark.h>

#include <algorithm>

#include "contour/gradient.hpp"
#include "filter/ring.hpp"
#include "grain_case.hpp"
#include "sculpt/brep/brep.hpp"
#include "sculpt/mesh/colour.hpp"
#include "smooth/star.hpp"

namespace sculpt {
namespace {

constexpr int kPower = 4;
constexpr double kEps = 0.1;

const GrainCase& grains() {
  static const GrainCase grain_case(40);
  return grain_case;
}

const HexMesh& pillowed_grains() {
  static const HexMesh mesh = grains().pillowed().mesh;
  return mesh;
}

// Stars of nodes all over the pillowed grains; few enough to stay in cache.
std::vector<Star> some_stars() {
  const HexMesh& mesh = pillowed_grains();
  const NodeHexes around(mesh);
  std::vector<Star> stars(64);
  const LocalId stride = mesh.nodes() / static_cast<LocalId>(stars.size());
  for (std::size_t s = 0; s < stars.size(); ++s) {
    const LocalId node = static_cast<LocalId>(s) * stride;
    stars[s].gather(mesh.hexes, mesh.position, around[node], node, {1, 1, 1}, Star::Target::kPresent);
  }
  return stars;
}

template <class Work>
void for_each_star(benchmark::State& state, Work&& work) {
  const std::vector<Star> stars = some_stars();
  for (auto round : state)
    for (const Star& star : stars) benchmark::DoNotOptimize(work(star));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(stars.size()));
}

void star_gather(benchmark::State& state) {
  const HexMesh& mesh = pillowed_grains();
  const NodeHexes around(mesh);
  Star star;
  for (auto round : state)
    for (LocalId n = 0; n < mesh.nodes(); ++n) {
      star.gather(mesh.hexes, mesh.position, around[n], n, {1, 1, 1}, Star::Target::kPresent);
      benchmark::DoNotOptimize(star.shortest_edge());
    }
  state.SetItemsProcessed(state.iterations() * mesh.nodes());
}
BENCHMARK(star_gather)->Unit(benchmark::kMillisecond);

void star_derivatives(benchmark::State& state) {
  for_each_star(state, [](const Star& star) { return star.derivatives(kPower, kEps).energy; });
}
BENCHMARK(star_derivatives);

void star_value(benchmark::State& state) {
  for_each_star(state, [](const Star& star) { return star.value({0.01, 0.02, 0.03}, kPower, kEps).energy; });
}
BENCHMARK(star_value);

void star_shape(benchmark::State& state) {
  for_each_star(state, [](const Star& star) { return star.shape({0.01, 0.02, 0.03}).scaled_jacobian; });
}
BENCHMARK(star_shape);

void scaled_jacobians(benchmark::State& state) {
  const HexMesh& mesh = pillowed_grains();
  for (auto round : state) {
    double least = 1;
    for (LocalId h = 0; h < mesh.size(); ++h) least = std::min(least, scaled_jacobian(mesh.corners(h)));
    benchmark::DoNotOptimize(least);
  }
  state.SetItemsProcessed(state.iterations() * mesh.size());
}
BENCHMARK(scaled_jacobians)->Unit(benchmark::kMillisecond);

void gradient_stencil(benchmark::State& state) {
  const GrainCase& g = grains();
  HexMesh cells = g.cells;
  if (state.range(0) == 0) cells.lattice = {0, 0, 0};
  std::vector<LocalId> at_interfaces;
  for (LocalId c = 0; c < g.cells.size(); ++c) {
    const auto own = static_cast<std::size_t>(c);
    if (std::any_of(g.neighbours[own].begin(), g.neighbours[own].end(), [&](LocalId n) {
          return n != kNone && g.cells.material[static_cast<std::size_t>(n)] != g.cells.material[own];
        }))
      at_interfaces.push_back(c);
  }
  GradientStencil stencil(cells, g.fractions, g.around);
  for (auto round : state)
    for (const LocalId c : at_interfaces) benchmark::DoNotOptimize(stencil.at(c).data());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(at_interfaces.size()));
}
BENCHMARK(gradient_stencil)->ArgName("lattice")->Arg(1)->Arg(0)->Unit(benchmark::kMillisecond);

void manifold_rings(benchmark::State& state) {
  const GrainCase& g = grains();
  HexMesh cells = g.cells;
  if (state.range(0) == 0) cells.lattice = {0, 0, 0};
  std::array<std::int32_t, Ring::kMost> material{};
  for (auto round : state) {
    int bad = 0;
    for (LocalId n = 0; n < g.cells.nodes(); ++n) {
      const auto items = g.around[n];
      for (std::size_t i = 0; i < items.size(); ++i)
        material[i] = g.cells.material[static_cast<std::size_t>(items[i] / 8)];
      bad += !ring_of(cells, g.neighbours, g.around, n).manifold({material.data(), items.size()});
    }
    benchmark::DoNotOptimize(bad);
  }
  state.SetItemsProcessed(state.iterations() * g.cells.nodes());
}
BENCHMARK(manifold_rings)->ArgName("lattice")->Arg(1)->Arg(0)->Unit(benchmark::kMillisecond);

// A lattice that does not know that it is one.
HexMesh general_cells(int n) {
  HexMesh mesh = GrainCase(n).cells;
  mesh.lattice = {0, 0, 0};
  return mesh;
}

void face_neighbours_of_general_cells(benchmark::State& state) {
  const HexMesh mesh = general_cells(static_cast<int>(state.range(0)));
  for (auto round : state) benchmark::DoNotOptimize(face_neighbours(mesh).data());
  state.SetItemsProcessed(state.iterations() * mesh.size());
}
BENCHMARK(face_neighbours_of_general_cells)->Arg(40)->Arg(100)->Unit(benchmark::kMillisecond);

void node_hexes(benchmark::State& state) {
  const HexMesh mesh = general_cells(static_cast<int>(state.range(0)));
  for (auto round : state) {
    const NodeHexes around(mesh);
    benchmark::DoNotOptimize(around[0].data());
  }
  state.SetItemsProcessed(state.iterations() * mesh.size());
}
BENCHMARK(node_hexes)->Arg(100)->Unit(benchmark::kMillisecond);

// No node has a preset colour, every fourth, none lacks one.
void colour_nodes_of_general_cells(benchmark::State& state) {
  HexMesh mesh = general_cells(100);
  std::vector<std::uint8_t> preset = mesh.colour;
  for (std::size_t n = 0; n < preset.size(); ++n)
    if (static_cast<std::int64_t>(n % 4) >= state.range(0)) preset[n] = kNoColour;
  for (auto round : state) colour_nodes(mesh, preset);
  state.SetItemsProcessed(state.iterations() * mesh.nodes());
}
BENCHMARK(colour_nodes_of_general_cells)
    ->ArgName("preset_quarters")
    ->Arg(0)
    ->Arg(3)
    ->Arg(4)
    ->Unit(benchmark::kMillisecond);

void volumes_of_general_cells(benchmark::State& state) {
  const HexMesh mesh = general_cells(static_cast<int>(state.range(0)));
  const FaceNeighbours neighbours = face_neighbours(mesh);
  for (auto round : state) benchmark::DoNotOptimize(build_brep(Comm::self(), mesh, neighbours, {}).volumes);
  state.SetItemsProcessed(state.iterations() * mesh.size());
}
BENCHMARK(volumes_of_general_cells)->Arg(100)->Unit(benchmark::kMillisecond);

void pillow_grains(benchmark::State& state) {
  const GrainCase grain_case(static_cast<int>(state.range(0)));
  std::int64_t hexes = 0;
  for (auto round : state) {
    const Pillowed result = grain_case.pillowed();
    hexes += result.mesh.size();
    benchmark::DoNotOptimize(result.mesh.hexes.data());
  }
  state.SetItemsProcessed(hexes);
}
BENCHMARK(pillow_grains)->Arg(20)->Arg(40)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sculpt
