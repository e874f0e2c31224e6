#include <benchmark/benchmark.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "input/shape_fractions.hpp"
#include "pebble.hpp"
#include "sculpt/facets/faceted_solid.hpp"

namespace sculpt {
namespace {

// The STL file of a pebble of 16 * 4^level facets.
std::string pebble(std::int64_t level) {
  const auto path = std::filesystem::temp_directory_path() / ("sculpt-kernels-" + std::to_string(::getpid()));
  microstructure::write_pebble(path.string(), {level, 1});
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  std::filesystem::remove(path);
  return text;
}

void read_stl(benchmark::State& state) {
  const std::string text = pebble(state.range(0));
  std::int64_t facets = 0;
  for (auto round : state) {
    FacetMesh mesh = parse_stl(text, "pebble.stl");
    benchmark::DoNotOptimize(repair(mesh));
    facets += static_cast<std::int64_t>(mesh.triangles.size());
  }
  state.SetItemsProcessed(facets);
}
BENCHMARK(read_stl)->Arg(5)->Arg(7)->Unit(benchmark::kMillisecond);

void index_facets(benchmark::State& state) {
  FacetMesh mesh = parse_stl(pebble(state.range(0)), "pebble.stl");
  (void)repair(mesh);
  for (auto round : state) benchmark::DoNotOptimize(FacetedSolid(mesh).bounds());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.triangles.size()));
}
BENCHMARK(index_facets)->Arg(5)->Arg(7)->Unit(benchmark::kMillisecond);

// All 50^3 cells around a pebble.
void measure_facets(benchmark::State& state) {
  FacetMesh mesh = parse_stl(pebble(state.range(0)), "pebble.stl");
  (void)repair(mesh);
  auto shapes = std::make_shared<std::vector<InsertedShape>>();
  shapes->push_back({std::make_unique<FacetedSolid>(mesh), 0});
  const Grid grid = box_grid({50, 50, 50}, {-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5});
  const auto field = shape_field(std::move(shapes), grid, 1);
  for (auto round : state)
    benchmark::DoNotOptimize(measure_cells(grid, whole(grid.cells), *field).value.data());
  state.SetItemsProcessed(state.iterations() * grid.cell_count());
}
BENCHMARK(measure_facets)->Arg(3)->Arg(5)->Arg(7)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sculpt
