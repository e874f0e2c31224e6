#include <numbers>

#include "hex_fixture.hpp"
#include "input_fixture.hpp"

namespace sculpt {
namespace {

// Data on a grid without a file.
class Voxels final : public MaterialSource {
 public:
  Voxels(Grid grid, Fractions fractions) : grid_(std::move(grid)), fractions_(std::move(fractions)) {}
  [[nodiscard]] const Grid& grid() const override { return grid_; }
  [[nodiscard]] MaterialData read(const Comm&, std::span<const IndexBox> wanted) override {
    return {{}, part(wanted[0])};
  }
  [[nodiscard]] Fractions part(const IndexBox& box) const {
    Fractions f;
    for (std::int64_t c = 0; c < box.size(); ++c) {
      const auto cell = static_cast<std::size_t>(grid_.cell_id(box.cell(c)));
      for (auto e = fractions_.offset[cell]; e < fractions_.offset[cell + 1]; ++e)
        f.add(fractions_.material[static_cast<std::size_t>(e)],
              fractions_.value[static_cast<std::size_t>(e)]);
      f.end_cell();
    }
    return f;
  }
  [[nodiscard]] std::unique_ptr<HexField> hexes(std::int32_t outside) const {
    return hex_field(part(whole(grid_.cells)), whole(grid_.cells), outside);
  }
  [[nodiscard]] const Fractions& fractions() const { return fractions_; }
  [[nodiscard]] std::int32_t material_at(const Vec3& p, std::int32_t outside) const {
    Index3 cell;
    for (std::size_t d = 0; d < 3; ++d) {
      cell[d] =
          static_cast<std::int64_t>(std::floor((p[d] - grid_.planes[d].front()) / grid_.cell_size()[d]));
      if (cell[d] < 0 || cell[d] >= grid_.cells[d]) return outside;
    }
    return fractions_
        .material[static_cast<std::size_t>(fractions_.offset[static_cast<std::size_t>(grid_.cell_id(cell))])];
  }

 private:
  Grid grid_;
  Fractions fractions_;
};

Fractions pure(const std::vector<std::int32_t>& material) {
  Fractions f;
  for (const std::int32_t m : material) {
    f.add(m, 1);
    f.end_cell();
  }
  return f;
}
Voxels pure_voxels(const Index3& cells, const std::vector<std::int32_t>& material) {
  return {uniform_grid(cells, {}, {1, 1, 1}), pure(material)};
}
// Materials 0 to 2 by voxel.
Voxels noise(Random& random, const Index3& cells) {
  std::vector<std::int32_t> material(static_cast<std::size_t>(cells[0] * cells[1] * cells[2]));
  for (std::int32_t& m : material) m = static_cast<std::int32_t>(random() % 3);
  return pure_voxels(cells, material);
}
// Grains: the nearest of a few seeds.
Voxels grains(Random& random, const Index3& cells) {
  std::vector<Vec3> seeds;
  for (int s = 0; s < 8; ++s) seeds.push_back(random_point(random, 0, static_cast<double>(cells[0])));
  std::vector<std::int32_t> material;
  for (std::int64_t c = 0; c < whole(cells).size(); ++c) {
    const Index3 i = whole(cells).cell(c);
    const Vec3 p{static_cast<double>(i[0]), static_cast<double>(i[1]), static_cast<double>(i[2])};
    std::size_t best = 0;
    for (std::size_t s = 1; s < seeds.size(); ++s)
      if (norm(seeds[s] - p) < norm(seeds[best] - p)) best = s;
    material.push_back(static_cast<std::int32_t>(best % 3));
  }
  return pure_voxels(cells, material);
}
// A hex of edge e with its centre at p.
HexCorners cube(const Vec3& p, double e) {
  const Vec3 half{0.5 * e, 0.5 * e, 0.5 * e};
  return box_hex(p - half, p + half);
}
Fractions measured(HexField& field, const HexCorners& hex) {
  MaterialData data;
  field.measure(hex, data.fractions);
  expect_valid(data);
  return data.fractions;
}

TEST(HexDataField, AHexThatIsAVoxelGetsItsFractions) {
  Random random(1);
  Fractions mixed;
  for (int c = 0; c < 27; ++c) {
    const double a = uniform(random, 0.1, 0.5), b = uniform(random, 0.1, 0.4);
    if (c % 3 != 0) mixed.add(0, a);
    if (c % 3 == 1) mixed.add(1, b);
    mixed.add(2, c % 3 == 0 ? 1 : c % 3 == 1 ? 1 - a - b : 1 - a);
    mixed.end_cell();
  }
  for (const Vec3& size : {Vec3{1, 1, 1}, Vec3{0.1, 0.3, 0.7}}) {
    const Voxels source(uniform_grid({3, 3, 3}, {0.1, -0.2, 0}, size), mixed);
    const Grid& grid = source.grid();
    const auto field = source.hexes(3);
    Fractions found, turned, cycled;
    for (std::int64_t c = 0; c < 27; ++c) {
      const Index3 i = whole(grid.cells).cell(c);
      const HexCorners hex = box_hex(grid.corner(i), grid.corner({i[0] + 1, i[1] + 1, i[2] + 1}));
      field->measure(hex, found);
      field->measure(renumbered(hex), turned);
      field->measure(with_cycled_axes(hex), cycled);
    }
    for (const Fractions& f : {found, turned, cycled}) {
      EXPECT_EQ(f.offset, mixed.offset);
      EXPECT_EQ(f.material, mixed.material);
      EXPECT_EQ(f.value, mixed.value);
    }
  }
}

TEST(HexDataField, BoxesGetWhatTheFieldSaysOfThem) {
  Random random(2);
  const Voxels source = noise(random, {6, 5, 4});
  const auto boxes = source.field(source.part(whole({6, 5, 4})), whole({6, 5, 4}));
  const auto hexes = source.hexes(3);
  for (int n = 0; n < 200; ++n) {
    const Vec3 lo = random_point(random, 0, 2), hi = lo + random_point(random, 0.9, 2);
    Fractions expected;
    boxes->measure({lo, hi}, expected);
    const Fractions found = measured(*hexes, box_hex(lo, hi));
    EXPECT_EQ(found.material, expected.material);
    EXPECT_EQ(found.value, expected.value);
  }
}

// Two voxels side by side; the weights are those of the inverse squares of the distances.
TEST(HexDataField, InterpolatesSmallHexes) {
  const auto field = pure_voxels({2, 1, 1}, {0, 1}).hexes(2);
  // Distances of 0.25 and 0.75 from the centres; nothing is beyond the sides in y and z.
  EXPECT_NEAR(fraction_of(measured(*field, cube({0.75, 0.5, 0.5}, 0.1)), 0, 0), 0.9, 1e-9);
  // Halfway.
  EXPECT_NEAR(fraction_of(measured(*field, cube({1, 0.3, 0.6}, 0.1)), 0, 0), 0.5, 1e-12);
  // At the centre of a voxel.
  EXPECT_EQ(fraction_of(measured(*field, cube({0.5, 0.5, 0.5}, 0.1)), 0, 0), 1);
  EXPECT_EQ(fraction_of(measured(*field, cube({1.5 + 1e-10, 0.5, 0.5}, 0.1)), 0, 1), 1);
  // Close to the outer sides: nothing of the outside.
  EXPECT_EQ(fraction_of(measured(*field, cube({0.1, 0.5, 0.5}, 0.1)), 0, 0), 1);
  EXPECT_EQ(fraction_of(measured(*field, cube({0.05, 0.05, 0.95}, 0.1)), 0, 0), 1);
  // 0.4 off in x and 0.2 in y: 1/0.2 against 1/0.4.
  EXPECT_NEAR(fraction_of(measured(*field, cube({0.9, 0.3, 0.5}, 0.1)), 0, 0), 5 / (5 + 2.5), 1e-9);
  // Beyond the grid.
  EXPECT_EQ(fraction_of(measured(*field, cube({-0.1, 0.5, 0.5}, 0.1)), 0, 2), 1);
  EXPECT_EQ(fraction_of(measured(*field, cube({0.5, 0.5, 7}, 0.1)), 0, 2), 1);
  // Across the side, its centre inside or outside.
  EXPECT_EQ(fraction_of(measured(*field, cube({0.01, 0.5, 0.5}, 0.1)), 0, 0), 1);
  EXPECT_EQ(fraction_of(measured(*field, cube({-0.01, 0.5, 0.5}, 0.1)), 0, 2), 1);
}

TEST(HexDataField, InterpolatesAmongEightVoxels) {
  const auto field = pure_voxels({2, 2, 2}, {0, 1, 2, 3, 4, 5, 6, 7}).hexes(8);
  const Fractions middle = measured(*field, cube({1, 1, 1}, 0.2));
  ASSERT_EQ(middle.material.size(), 8U);
  for (const double value : middle.value) EXPECT_NEAR(value, 0.125, 1e-14);
  const Vec3 at{0.8, 1.1, 0.7};
  const Fractions f = measured(*field, cube(at, 0.2));
  double sum = 0;
  std::vector<double> weight;
  for (std::size_t c = 0; c < 8; ++c) {
    const Vec3 off = at - Vec3{c & 1 ? 1.5 : 0.5, c & 2 ? 1.5 : 0.5, c & 4 ? 1.5 : 0.5};
    weight.push_back(1 / dot(off, off));
    sum += weight.back();
  }
  for (std::int32_t m = 0; m < 8; ++m)
    EXPECT_NEAR(fraction_of(f, 0, m), weight[static_cast<std::size_t>(m)] / sum, 1e-9);
}

TEST(HexDataField, BeyondTheGridIsTheOutside) {
  const auto field = pure_voxels({2, 2, 2}, {0, 0, 0, 0, 0, 0, 0, 0}).hexes(5);
  EXPECT_NEAR(fraction_of(measured(*field, cube({2, 1, 1}, 1)), 0, 5), 0.5, 1e-12);
  EXPECT_NEAR(fraction_of(measured(*field, cube({1, 1, 1}, 4)), 0, 0), 0.125, 1e-12);
  EXPECT_EQ(fraction_of(measured(*field, cube({2.5, 1, 1}, 1)), 0, 5), 1);  // shares a side with the grid
  HexCorners sheared = cube({2, 1, 1}, 1);
  for (const std::size_t c : {4, 5, 6, 7}) sheared[c].y += 0.3;
  EXPECT_NEAR(fraction_of(measured(*field, sheared), 0, 0), 0.5, 2e-3);
  sheared[0].x -= 1e-11;
  for (Vec3& p : sheared) p.x += 0.5;
  EXPECT_EQ(fraction_of(measured(*field, sheared), 0, 5), 1);
  for (Vec3& p : sheared) p.x -= 1 + 1e-12;
  EXPECT_EQ(fraction_of(measured(*field, sheared), 0, 0), 1);
}

// Against very many points; noise is the worst that data can be.
TEST(HexDataField, MeasuresOverlapsOfWarpedHexes) {
  for (const double edge : {0.85, 1.0, 1.6, 3.0, 6.0}) {
    Random random(3);
    const Voxels noisy = noise(random, {12, 12, 12}), smooth = grains(random, {12, 12, 12});
    double worst = 0, squares = 0, worst_smooth = 0;
    constexpr int kHexes = 12;
    for (int n = 0; n < kHexes; ++n) {
      const HexCorners hex = random_hex(random, random_point(random, 0.4, 11.6), edge, 0.12);
      if (hex_volume(hex) < 0.5) continue;  // interpolated
      for (const Voxels* source : {&noisy, &smooth}) {
        const auto field = source->hexes(3);
        const Fractions f = measured(*field, hex);
        const std::vector<double> expected =
            shares_by_points(hex, 4, 48, [&](const Vec3& p) { return source->material_at(p, 3); });
        for (std::int32_t m = 0; m < 4; ++m) {
          const double error = fraction_of(f, 0, m) - expected[static_cast<std::size_t>(m)];
          if (source == &noisy) squares += error * error / 4;
          double& most = source == &noisy ? worst : worst_smooth;
          most = std::max(most, std::fabs(error));
        }
      }
    }
    EXPECT_LT(worst, 8e-3) << "edge " << edge;
    EXPECT_LT(std::sqrt(squares / kHexes), 4e-3) << "edge " << edge;
    EXPECT_LT(worst_smooth, 5e-3) << "edge " << edge;
  }
}

// Hexes that fill the grid together hold what its voxels hold.
TEST(HexDataField, HexesTogetherHoldTheVoxels) {
  Random random(4);
  const Voxels source = noise(random, {8, 8, 8});
  std::vector<double> expected(3, 0.0);
  for (const std::int32_t m : source.fractions().material) expected[static_cast<std::size_t>(m)] += 1;
  const auto field = source.hexes(3);
  const auto bent = [](const Vec3& p) {
    const auto bump = [](double t) { return std::sin(2 * std::numbers::pi * t); };
    const double b = 0.06 * std::sin(std::numbers::pi * p.x) * std::sin(std::numbers::pi * p.y) *
                     std::sin(std::numbers::pi * p.z);
    return 8 * Vec3{p.x + b * bump(p.y + p.z), p.y + b * bump(p.z + 2 * p.x), p.z + b * bump(p.x)};
  };
  for (const int n : {3, 5, 8, 9}) {
    std::vector<double> volume(4, 0.0);
    double all = 0;
    for (const HexCorners& hex : mapped_lattice(n, bent)) {
      ASSERT_TRUE(is_positive_inside(hex));
      const Fractions f = measured(*field, hex);
      for (std::int32_t m = 0; m < 4; ++m)
        volume[static_cast<std::size_t>(m)] += fraction_of(f, 0, m) * hex_volume(hex);
      all += hex_volume(hex);
    }
    EXPECT_NEAR(all, 512, 1e-9);
    EXPECT_EQ(volume[3], 0);
    for (std::size_t m = 0; m < 3; ++m) EXPECT_NEAR(volume[m] / expected[m], 1, 3e-3) << n;
  }
}

// What is said of a hex is the same when only the voxels that it needs are known.
TEST(HexDataField, NeedsNoMoreThanItAsksFor) {
  Random random(5);
  const Voxels source = noise(random, {9, 8, 7});
  const auto all = source.hexes(3);
  for (int n = 0; n < 400; ++n) {
    const HexCorners hex =
        n % 4 == 0 ? cube(random_point(random, -1, 10), uniform(random, 0.2, 3))
                   : random_hex(random, random_point(random, -1, 10), uniform(random, 0.2, 3), 0.1);
    const IndexBox box = voxels_for(source.grid(), bounds_of(hex));
    const auto some = source.hex_field(source.part(box), box, 3);
    const Fractions expected = measured(*all, hex), found = measured(*some, hex);
    EXPECT_EQ(found.material, expected.material);
    EXPECT_EQ(found.value, expected.value);
  }
  EXPECT_TRUE(voxels_for(source.grid(), {{-3, 0, 0}, {-1, 1, 1}}).empty());
  EXPECT_TRUE(voxels_for(source.grid(), {{0, 0, 8}, {1, 1, 1e300}}).empty());
  EXPECT_EQ(voxels_for(source.grid(), {{-1e300, 1.2, 6.4}, {1.2, 1.6, 6.8}}),
            (IndexBox{{0, 0, 5}, {2, 3, 7}}));
}

// Which hexes are cut on which of the planes of the voxels does not change what one of a kind gets.
TEST(HexDataField, VoxelsOfOneKindInsideAreOfThatKind) {
  const auto field = pure_voxels({9, 9, 9}, std::vector<std::int32_t>(729, 1)).hexes(0);
  Random random(6);
  for (int n = 0; n < 50; ++n) {
    const Fractions f =
        measured(*field, random_hex(random, random_point(random, 3, 6), uniform(random, 0.2, 3), 0.1));
    ASSERT_EQ(f.material, (std::vector<std::int32_t>{1}));
    EXPECT_EQ(f.value[0], 1);
  }
}

TEST(HexDataField, AThinHexIsNotInterpolated) {
  std::vector<std::int32_t> material(64, 0);
  for (std::size_t c = 0; c < 64; ++c) material[c] = c % 4 < 2 ? 0 : 1;
  const auto field = pure_voxels({4, 4, 4}, material).hexes(2);
  HexCorners thin = box_hex({0.5, 0.5, 1.4}, {3, 3, 1.42});
  EXPECT_NEAR(fraction_of(measured(*field, thin), 0, 0), 0.6, 1e-12);
  thin[6].z += 0.01;
  EXPECT_NEAR(fraction_of(measured(*field, thin), 0, 0), 0.6, 5e-2);
}

}  // namespace
}  // namespace sculpt
