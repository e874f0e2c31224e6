#include <benchmark/benchmark.h>

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "grains.hpp"
#include "input/data_field.hpp"
#include "input/number_stream.hpp"
#include "input/shape_fractions.hpp"
#include "sculpt/geom/solids.hpp"
#include "sculpt/geom/sphere.hpp"

namespace sculpt {
namespace {

// A file of voxels that goes away with its owner.
class SpnFile {
 public:
  explicit SpnFile(std::int64_t n) {
    const int descriptor = mkstemp(path_.data());
    if (descriptor < 0) throw std::runtime_error("cannot create " + path_);
    close(descriptor);
    microstructure::GrainOptions options;
    options.n = {n, n, n};
    options.grains = n;
    write_spn(path_, make_grains(options));
  }
  ~SpnFile() { unlink(path_.c_str()); }
  SpnFile(const SpnFile&) = delete;
  SpnFile& operator=(const SpnFile&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_ = P_tmpdir "/sculpt-kernels-XXXXXX";
};

void scan_spn(benchmark::State& state) {
  const SpnFile spn(state.range(0));
  const TextFile file(spn.path(), "input_spn");
  const Comm alone = Comm::self();
  std::int64_t numbers = 0;
  for (auto round : state) {
    NumberStream<IntegerText> stream(alone, file, 0, file.size());
    while (stream.next(alone)) benchmark::DoNotOptimize(stream.values().data());
    numbers += stream.total();
  }
  state.SetItemsProcessed(numbers);
  state.SetBytesProcessed(state.iterations() * file.size());
}
BENCHMARK(scan_spn)->Arg(50)->Arg(100)->Unit(benchmark::kMillisecond);

Box unit_cell(const Index3& c) {
  const Vec3 lo{static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])};
  return {lo, lo + Vec3{1, 1, 1}};
}

// Balls of this radius in a lattice that fills 40^3 unit cells; they do not touch.
const Grid kCells = uniform_grid({40, 40, 40}, {}, {1, 1, 1});
std::unique_ptr<MaterialField> field_of_balls(double radius) {
  auto shapes = std::make_shared<std::vector<InsertedShape>>();
  const double spacing = 2.3 * radius;
  const auto n = static_cast<int>(40 / spacing);
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        shapes->push_back(
            {std::make_unique<Sphere>(spacing * Vec3{i + 0.51, j + 0.52, k + 0.53}, radius), i % 2});
  return shape_field(std::move(shapes), kCells, 2);
}

// The cells that one material fills, or the others.
void measure_balls(benchmark::State& state, bool pure) {
  const auto field = field_of_balls(0.1 * static_cast<double>(state.range(0)));
  std::vector<Box> boxes;
  const IndexBox all = whole(kCells.cells);
  for (std::int64_t p = 0; p < all.size(); ++p) {
    const Box cell = unit_cell(all.cell(p));
    if (field->sole_material(cell).has_value() == pure) boxes.push_back(cell);
  }
  for (auto round : state) {
    Fractions fractions;
    for (const Box& box : boxes) field->measure(box, fractions);
    benchmark::DoNotOptimize(fractions.value.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(boxes.size()));
}
void measure_mixed_cells(benchmark::State& state) { measure_balls(state, false); }
void measure_pure_cells(benchmark::State& state) { measure_balls(state, true); }
BENCHMARK(measure_mixed_cells)->Arg(6)->Arg(15)->Arg(40)->Unit(benchmark::kMillisecond);  // tenths of a cell
BENCHMARK(measure_pure_cells)->Arg(15)->Arg(40)->Unit(benchmark::kMillisecond);

// Unit cells that the edges of a box meet whose faces are not normal to the axes.
void measure_edge_cells(benchmark::State& state) {
  const Frame turned{{20, 20, 20}, {{{0.48, 0.64, 0.6}, {-0.8, 0.6, 0}, {-0.36, -0.48, 0.8}}}};
  auto shapes = std::make_shared<std::vector<InsertedShape>>();
  shapes->push_back({moved(box({-9, -8, -7}, {9, 8, 7}), turned), 0});
  const auto field = shape_field(shapes, kCells, 1);
  std::vector<Box> boxes;
  const IndexBox all = whole(kCells.cells);
  for (std::int64_t p = 0; p < all.size(); ++p) {
    const Box cell = unit_cell(all.cell(p));
    if (!field->sole_material(cell) && (*shapes)[0].shape->has_edges(cell)) boxes.push_back(cell);
  }
  for (auto round : state) {
    Fractions fractions;
    for (const Box& box : boxes) field->measure(box, fractions);
    benchmark::DoNotOptimize(fractions.value.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(boxes.size()));
}
BENCHMARK(measure_edge_cells)->Unit(benchmark::kMillisecond);

// Balls, whose radius is given in tenths of a cell, and the bins to find them by: the smaller the more.
void index_balls(benchmark::State& state) {
  for (auto round : state)
    benchmark::DoNotOptimize(field_of_balls(0.1 * static_cast<double>(state.range(0))).get());
}
BENCHMARK(index_balls)->Arg(4)->Arg(8)->Arg(40)->Unit(benchmark::kMillisecond);

constexpr std::int64_t kVoxels = 128;
std::unique_ptr<MaterialField> field_of_voxels() {
  Fractions fractions;
  const IndexBox all = whole({kVoxels, kVoxels, kVoxels});
  for (std::int64_t p = 0; p < all.size(); ++p) {
    const Index3 c = all.cell(p);
    fractions.add(static_cast<std::int32_t>(c[0] / 20 + c[1] / 24 + c[2] / 28), 1);
    fractions.end_cell();
  }
  return data_field(uniform_grid(all.hi, {}, {1, 1, 1}), all, std::move(fractions));
}
// Cubes of so many voxels per edge.
std::vector<Box> voxel_cubes(std::int64_t edge) {
  std::vector<Box> cubes;
  const std::int64_t n = kVoxels / edge;
  const IndexBox all = whole({n, n, n});
  for (std::int64_t p = 0; p < all.size(); ++p) {
    const auto size = static_cast<double>(edge);
    const Box cell = unit_cell(all.cell(p));
    cubes.push_back({size * cell.lo, size * cell.hi});
  }
  return cubes;
}

void average_voxels(benchmark::State& state) {
  const auto field = field_of_voxels();
  const std::vector<Box> cubes = voxel_cubes(state.range(0));
  for (auto round : state) {
    Fractions fractions;
    for (const Box& cube : cubes) field->measure(cube, fractions);
    benchmark::DoNotOptimize(fractions.value.data());
  }
  state.SetItemsProcessed(state.iterations() * kVoxels * kVoxels * kVoxels);
}
BENCHMARK(average_voxels)->Arg(2)->Arg(8)->Arg(16)->Unit(benchmark::kMillisecond);

void sole_voxels(benchmark::State& state) {
  const auto field = field_of_voxels();
  const std::vector<Box> cubes = voxel_cubes(state.range(0));
  for (auto round : state)
    for (const Box& cube : cubes) benchmark::DoNotOptimize(field->sole_material(cube));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(cubes.size()));
}
BENCHMARK(sole_voxels)->Arg(1)->Arg(8)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sculpt
