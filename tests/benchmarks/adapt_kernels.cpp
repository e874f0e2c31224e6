#include <benchmark/benchmark.h>

#include <bit>
#include <cmath>

#include "adapt/block_template.hpp"
#include "sculpt/adapt/leaf_mesh.hpp"

namespace sculpt {
namespace {

// Cells of the finest level near a sphere, not closed yet.
Forest shell(std::int64_t cells, int levels) {
  Forest forest({cells, cells, cells}, levels, {false, false, false});
  const IndexBox box = whole(forest.cells(levels - 1));
  const double n = static_cast<double>(forest.cells(levels - 1)[0]);
  for (std::int64_t c = 0; c < box.size(); ++c) {
    const Index3 i = box.cell(c);
    Vec3 x;
    for (std::size_t d = 0; d < 3; ++d) x[d] = static_cast<double>(i[d]) + 0.5 - 0.5 * n;
    if (std::fabs(norm(x) - 0.36 * n) < 1) forest.refine_cell(levels - 1, i);
  }
  return forest;
}

// Patterns of one to three refined faces, and of edges alone: what is met most.
void block_templates(benchmark::State& state) {
  constexpr BlockPattern kPatterns[] = {0x1, 0x5, 0x15, 0x40, 0x3, 0x4040, 0x801};
  for (auto round : state)
    for (const BlockPattern p : kPatterns) benchmark::DoNotOptimize(block_template(p, 0).get());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(std::size(kPatterns)));
}
BENCHMARK(block_templates)->Unit(benchmark::kMillisecond);

// Items: refined blocks after closing.
void close_forest(benchmark::State& state) {
  const Forest open = shell(state.range(0), static_cast<int>(state.range(1)));
  std::int64_t blocks = 0;
  for (auto round : state) {
    Forest forest = open;
    forest.close();
    state.PauseTiming();
    for (const std::uint64_t word : forest.words()) blocks += std::popcount(word);
    state.ResumeTiming();
  }
  state.SetItemsProcessed(blocks);
}
BENCHMARK(close_forest)->Args({32, 1})->Args({32, 2})->Args({16, 3})->Unit(benchmark::kMillisecond);

// Items: hexes.
void refined_mesh(benchmark::State& state) {
  Forest forest = shell(state.range(0), static_cast<int>(state.range(1)));
  forest.close();
  const Index3 n = forest.blocks(0);
  const Grid grid = uniform_grid(forest.cells(0), {}, {1, 1, 1});
  const BlockParts all{
      n, {whole(n)}, std::vector<std::int32_t>(static_cast<std::size_t>(whole(n).size()), 0)};
  std::int64_t hexes = 0;
  for (auto round : state) {
    const LeafMesh mesh = leaf_mesh(Comm::self(), grid, forest, all, 2);
    hexes += mesh.cells.size();
    benchmark::DoNotOptimize(mesh.cells.hexes.data());
  }
  state.SetItemsProcessed(hexes);
}
BENCHMARK(refined_mesh)->Args({32, 1})->Args({32, 2})->Args({16, 3})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sculpt
