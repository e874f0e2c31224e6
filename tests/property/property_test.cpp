// Seeded random inputs through all stages: what must hold for any input. SCULPT_TEST_SEED changes the inputs.
#include <gtest/gtest.h>

#include <cstdlib>

#include "support/mesh_checks.hpp"
#include "support/stages.hpp"

namespace sculpt::test {
namespace {

std::uint64_t seed() {
  static const std::uint64_t value = [] {
    const char* given = std::getenv("SCULPT_TEST_SEED");
    const std::uint64_t s = given != nullptr ? std::strtoull(given, nullptr, 10) : 1;
    std::printf("SCULPT_TEST_SEED = %llu\n", static_cast<unsigned long long>(s));
    return s;
  }();
  return value;
}

std::int64_t random_between(std::uint64_t item, std::int64_t lo, std::int64_t hi) {
  return lo + static_cast<std::int64_t>(scatter(seed(), item) % static_cast<std::uint64_t>(hi - lo + 1));
}

// A kind, a grid, its size and number of materials, all by chance.
Case random_case(std::uint64_t n) {
  const Index3 cells{random_between(10 * n, 3, 10), random_between(10 * n + 1, 3, 10),
                     random_between(10 * n + 2, 1, 10)};
  const std::uint64_t own = scatter(seed(), 10 * n + 3);
  const auto materials = static_cast<std::int32_t>(random_between(10 * n + 4, 2, 9));
  Case input;
  switch (n % 4) {
    case 0:
      input = grains(cells, static_cast<int>(random_between(10 * n + 5, 2, 25)), materials, own);
      break;
    case 1:
      input = noise(cells, materials, own);
      break;
    case 2:
      input = two_phase_fractions(cells, own);
      break;
    default: {
      const Vec3 size{static_cast<double>(cells[0]), static_cast<double>(cells[1]),
                      static_cast<double>(cells[2])};
      input = ball(cells, 0.5 * size + Vec3{0.3, -0.2, 0.1}, 0.4 * largest(size));
    }
  }
  Vec3 h;
  for (std::size_t d = 0; d < 3; ++d) h[d] = 0.1 + 0.05 * scatter_unit(own, d);
  input.grid = uniform_grid(cells, {-0.37, 12.1, 0}, h);
  return input;
}

constexpr std::uint64_t kCases = 24;

void expect_sound(const Case& input, const StagesResult& result, int pillows, int of_the_box = 0) {
  const HexMesh& mesh = result.mesh;
  EXPECT_EQ(conformity_problem(mesh, pillows, of_the_box), "") << input.name;
  EXPECT_EQ(box_problem(mesh, input.grid), "") << input.name;
  EXPECT_GT(least_scaled_jacobian(mesh), 0) << input.name;
  // Corners are not all: a hex may fold inside.
  EXPECT_EQ(summarise(Comm::self(), mesh).not_positive_inside, 0) << input.name;
}

TEST(AnyInput, GivesASoundMeshThatFillsTheBox) {
  for (std::uint64_t n = 0; n < kCases; ++n) {
    const Case input = random_case(n);
    const StagesResult result = run_stages(Comm::self(), input);
    expect_sound(input, result, 1);
    EXPECT_EQ(boundary_problem(result.mesh), "") << input.name;
    EXPECT_EQ(result.mesh.size(), input.grid.cell_count() + 2 * result.quads) << input.name;
    EXPECT_EQ(interface_faces(result.mesh), result.quads) << input.name;
    EXPECT_NEAR(volume(result.mesh) / volume(input.grid), 1, 1e-12) << input.name;
  }
}

// Half cells of a grid of doubled cells are the cells of the grid, to the last bit after every stage.
TEST(AnyInput, IsTheSameAtAnyLevel) {
  for (std::uint64_t n = 0; n < kCases; n += 2) {
    const Case input = random_case(n + n / 4 % 2);
    const StagesResult at0 = run_stages(Comm::self(), at_level(input, 0)),
                       at2 = run_stages(Comm::self(), at_level(input, 2));
    for (std::size_t i = 0; i < at0.checksums.size(); ++i)
      EXPECT_EQ(at0.checksums[i].checksum, at2.checksums[i].checksum)
          << input.name << ", after " << at0.checksums[i].stage;
  }
}

TEST(AnyInput, GivesASoundMeshWithoutItsVoid) {
  for (std::uint64_t n = 0; n < kCases; n += 3) {
    const Case input = random_case(n);
    StageOptions options;
    options.void_material = 0;
    const StagesResult result = run_stages(Comm::self(), input, options);
    expect_sound(input, result, 1);
    for (const std::int32_t m : result.mesh.material) EXPECT_NE(m, 0);
  }
}

TEST(AnyInput, GivesASoundMeshWithSurfacePillows) {
  for (std::uint64_t n = 0; n < kCases; n += 4) {
    const Case input = random_case(n);
    StageOptions options;
    options.layers.surfaces = true;
    const StagesResult result = run_stages(Comm::self(), input, options);
    expect_sound(input, result, 2);
    EXPECT_EQ(boundary_problem(result.mesh), "") << input.name;
    EXPECT_NEAR(volume(result.mesh) / volume(input.grid), 1, 1e-12) << input.name;
  }
}

TEST(AnyInput, GivesASoundMeshWithLayersAlongTheBox) {
  for (std::uint64_t n = 1; n < kCases; n += 4) {
    const Case input = random_case(n);
    StageOptions options;
    options.layers.boundary_layers = 1 + static_cast<int>(n / 4 % 2);
    const StagesResult result = run_stages(Comm::self(), input, options);
    expect_sound(input, result, 1 + options.layers.boundary_layers, options.layers.boundary_layers);
    EXPECT_EQ(boundary_problem(result.mesh), "") << input.name;
    EXPECT_NEAR(volume(result.mesh) / volume(input.grid), 1, 1e-12) << input.name;
  }
}

TEST(AnyInput, GivesASoundMeshWithLayersAroundCurves) {
  int with_layers = 0;
  for (std::uint64_t n = 0; n < kCases; n += 3) {
    const Case input = random_case(n);
    StageOptions options;
    options.layers.curves = true;
    options.layers.curve_threshold = 0.5;
    options.layers.curve_layers = 1 + static_cast<int>(n % 2);
    const StagesResult result = run_stages(Comm::self(), input, options);
    with_layers += result.pillows == 2;
    expect_sound(input, result, result.pillows);
    EXPECT_EQ(boundary_problem(result.mesh), "") << input.name;
    EXPECT_NEAR(volume(result.mesh) / volume(input.grid), 1, 1e-12) << input.name;
  }
  EXPECT_GT(with_layers, 0);
}

// Other names in the same order change nothing but the names.
TEST(AnyInput, MaterialsMayHaveOtherNames) {
  for (std::uint64_t n = 0; n < kCases; n += 2) {
    const Case input = random_case(n);
    Case renamed = input;
    renamed.materials = 3 * input.materials + 2;
    renamed.fill = [&input](const Index3& c, Fractions& f) {
      const std::size_t first = f.material.size();
      input.fill(c, f);
      for (std::size_t e = first; e < f.material.size(); ++e) f.material[e] = 3 * f.material[e] + 1;
    };
    const HexMesh a = run_stages(Comm::self(), input).mesh, b = run_stages(Comm::self(), renamed).mesh;
    EXPECT_EQ(a.position, b.position) << input.name;
    EXPECT_EQ(a.hexes, b.hexes) << input.name;
    EXPECT_EQ(a.hex_id, b.hex_id) << input.name;
    ASSERT_EQ(a.material.size(), b.material.size());
    for (std::size_t h = 0; h < a.material.size(); ++h)
      ASSERT_EQ(3 * a.material[h] + 1, b.material[h]) << input.name;
  }
}

// A shift by powers of two keeps every bit of the differences that matter; the mesh goes along up to
// rounding.
TEST(AnyInput, TheMeshFollowsAShiftOfTheBox) {
  for (std::uint64_t n = 0; n < kCases; n += 6) {
    Case input = random_case(n), shifted = input;
    input.grid = uniform_grid(input.grid.cells, {0, 0, 0}, {0.5, 0.5, 0.5});
    shifted.grid = uniform_grid(input.grid.cells, {16, -8, 4}, {0.5, 0.5, 0.5});
    const HexMesh a = run_stages(Comm::self(), input).mesh, b = run_stages(Comm::self(), shifted).mesh;
    EXPECT_EQ(a.hexes, b.hexes) << input.name;
    EXPECT_EQ(a.material, b.material) << input.name;
  }
}

}  // namespace
}  // namespace sculpt::test
