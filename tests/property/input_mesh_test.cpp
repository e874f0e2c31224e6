// Seeded random materials on hex meshes that are no boxes: what must hold for any. SCULPT_TEST_SEED changes
// them.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "sculpt/mesh/edit.hpp"
#include "support/input_meshes.hpp"
#include "support/mesh_checks.hpp"

namespace sculpt::test {
namespace {

constexpr std::uint64_t kCases = 20;

std::uint64_t seed() {
  const char* given = std::getenv("SCULPT_TEST_SEED");
  return given != nullptr ? std::strtoull(given, nullptr, 10) : 1;
}

// A small mesh of one of the kinds, its numbers shuffled, with grains by chance.
InputMeshCase random_case(std::uint64_t n) {
  const std::uint64_t own = scatter(seed(), n);
  const auto pick = [&](std::uint64_t item, std::uint64_t lo, std::uint64_t hi) {
    return std::to_string(lo + scatter(own, item) % (hi - lo + 1));
  };
  const std::string order = pick(0, 1, 1000);
  InputMeshCase input;
  switch (n % 5) {
    case 0:
      input.mesh =
          generated("cylinder", {"--n", pick(1, 3, 5), "--layers", pick(2, 4, 9), "--permute", order});
      break;
    case 1:
      input.mesh = generated("sphere-in-cube",
                             {"--n", pick(1, 3, 4), "--inside", "2", "--outside", "2", "--permute", order});
      break;
    case 2:
      input.mesh = generated("bar", {"--nx", pick(1, 10, 14), "--ny", pick(2, 5, 8), "--nz", pick(3, 3, 6),
                                     "--length", "12", "--height", "5", "--width", "4", "--permute", order});
      break;
    case 3:
      input.mesh = generated("nested", {"--n", "2", "--permute", order});
      break;
    default:
      input.mesh = generated("nested", {"--n", "2", "--permute", order});
      for (std::int32_t b = 0; b < 4; ++b)
        if ((1 + scatter(own, 4) % 14) >> b & 1) input.keep.push_back(b);
  }
  input.grains = static_cast<int>(2 + scatter(own, 5) % 5);
  input.seed = own;
  input.pure = scatter(own, 6) % 3 == 0;
  input.name = fmt::format("case {}: {}, {} grains{}{}", n, input.mesh.name, input.grains,
                           input.pure ? ", pure" : "", input.keep.empty() ? "" : ", blocks kept");
  return input;
}

double volume_of(const Overlay& o) { return volume(o.cells); }

struct Expected {
  int pillows = 1, of_the_box = 0;
  bool closed = true;  // nothing is left out
  double volume = 1e-12, least = 0.2;
};

void expect_sound(const InputMeshCase& input, const StagesResult& result, const Expected& want) {
  const HexMesh& mesh = result.mesh;
  EXPECT_EQ(conformity_problem(mesh, want.pillows, want.of_the_box), "") << input.name;
  EXPECT_EQ(exterior_problem(mesh, 1e-9, want.closed), "") << input.name;
  const QualitySummary quality = summarise(Comm::self(), mesh);
  EXPECT_EQ(quality.not_positive_inside, 0) << input.name;
  EXPECT_GE(quality.least, want.least) << input.name;
  if (want.closed) {
    const double domain = volume_of(input_overlay(Comm::self(), input));
    EXPECT_NEAR(volume(mesh) / domain, 1, want.volume) << input.name;
  }
  if (std::getenv("SCULPT_TEST_TELL"))
    std::printf("%s: %d hexes, least %.3f, volume %.1e\n", input.name.c_str(), mesh.size(), quality.least,
                volume(mesh) / volume_of(input_overlay(Comm::self(), input)) - 1);
}

TEST(AnyInputMesh, GivesASoundMeshThatKeepsTheDomain) {
  for (std::uint64_t n = 0; n < kCases; ++n) {
    const InputMeshCase input = random_case(n);
    expect_sound(input, run_stages(Comm::self(), input), {});
  }
}

// Nodes that slide cut the edges between facets: by little where these are many.
TEST(AnyInputMesh, GivesASoundMeshWhereNodesSlideAcrossFacets) {
  for (std::uint64_t n = 0; n < kCases; ++n) {
    InputMeshCase input = random_case(n);
    input.slides = true;
    expect_sound(input, run_stages(Comm::self(), input), {.volume = 0.03});
  }
  for (std::uint64_t n = 0; n < 3; ++n) {
    InputMeshCase input;
    input.name = input.mesh.name = "fine cylinder";
    input.mesh = generated("cylinder", {"--n", "12", "--layers", "8"});
    input.seed = scatter(seed(), 1000 + n);
    input.slides = true;
    expect_sound(input, run_stages(Comm::self(), input), {.volume = 2e-3});
  }
}

TEST(AnyInputMesh, GivesASoundMeshWithoutAMaterial) {
  for (std::uint64_t n = 0; n < kCases; ++n) {
    const InputMeshCase input = random_case(n);
    StageOptions options;
    options.void_material = 0;
    const StagesResult result = run_stages(Comm::self(), input, options);
    expect_sound(input, result, {.closed = false});
    for (const std::int32_t m : result.mesh.material) EXPECT_NE(m, 0);
  }
}

TEST(AnyInputMesh, GivesASoundMeshWithSurfacePillows) {
  for (std::uint64_t n = 0; n < kCases; ++n) {
    const InputMeshCase input = random_case(n);
    StageOptions options;
    options.layers.surfaces = true;
    expect_sound(input, run_stages(Comm::self(), input, options), {.pillows = 2, .least = 0.1});
  }
}

TEST(AnyInputMesh, GivesASoundMeshWithLayersAroundCurves) {
  int with_layers = 0;
  for (std::uint64_t n = 0; n < kCases; ++n) {
    const InputMeshCase input = random_case(n);
    StageOptions options;
    options.layers.curves = true;
    options.layers.curve_threshold = 0.5;
    options.layers.curve_layers = 1 + static_cast<int>(n / 5 % 2);
    const StagesResult result = run_stages(Comm::self(), input, options);
    with_layers += result.pillows == 2;
    expect_sound(input, result, {.pillows = result.pillows});
  }
  EXPECT_GT(with_layers, 0);
}

TEST(AnyInputMesh, GivesASoundMeshWithLayersAlongTheBoundary) {
  for (std::uint64_t n = 0; n < kCases; ++n) {
    const InputMeshCase input = random_case(n);
    StageOptions options;
    // Kept blocks with one layer only: where the boundary bends inwards more do not always become valid.
    options.layers.boundary_layers = input.keep.empty() ? 1 + static_cast<int>(n / 5 % 2) : 1;
    expect_sound(input, run_stages(Comm::self(), input, options),
                 {.pillows = 1 + options.layers.boundary_layers,
                  .of_the_box = options.layers.boundary_layers,
                  .least = 0.1});
  }
}

// Interfaces between the blocks of the mesh stay where they are.
TEST(AnyInputMesh, GivesASoundMeshOfItsBlocksAndAGrain) {
  for (std::uint64_t n = 1; n < kCases; ++n) {
    InputMeshCase input = random_case(n);
    if (input.mesh.name != "sphere-in-cube" && input.mesh.name != "nested") continue;
    input.blocks = true;
    input.keep.clear();
    expect_sound(input, run_stages(Comm::self(), input), {});
  }
}

// With the hexes that stay the mesh is whole again.
TEST(AnyInputMesh, KeepsBlocksToTheLastBit) {
  for (std::uint64_t n = 4; n < 2 * kCases; n += 5) {
    const InputMeshCase input = random_case(n);
    const Overlay before = input_overlay(Comm::self(), input);
    const StagesResult result = run_stages(Comm::self(), input);
    const HexMesh &joined = *result.joined, &kept = *before.kept;
    EXPECT_EQ(conformity_problem(joined), "") << input.name;
    std::int64_t found = 0;
    for (LocalId h = 0; h < joined.size(); ++h) {
      if (joined.material[at(h)] < input.grains) continue;
      const auto old = std::lower_bound(kept.hex_id.begin(), kept.hex_id.end(), joined.hex_id[at(h)] / 8);
      ASSERT_TRUE(old != kept.hex_id.end() && 8 * *old == joined.hex_id[at(h)]) << input.name;
      const auto k = static_cast<LocalId>(old - kept.hex_id.begin());
      EXPECT_EQ(joined.corners(h), kept.corners(k)) << input.name;
      EXPECT_EQ(joined.material[at(h)], kept.material[at(k)]) << input.name;
      ++found;
    }
    EXPECT_EQ(found, kept.size()) << input.name;
    EXPECT_EQ(joined.size(), kept.size() + result.mesh.size()) << input.name;
  }
}

}  // namespace
}  // namespace sculpt::test
