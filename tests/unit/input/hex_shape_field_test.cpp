#include <numbers>

#include "hex_fixture.hpp"
#include "input/shape_fractions.hpp"
#include "input_fixture.hpp"
#include "sculpt/geom/sphere.hpp"

namespace sculpt {
namespace {

using Shapes = std::vector<InsertedShape>;

const Grid kSpace = uniform_grid({10, 10, 10}, {}, {1, 1, 1});

std::shared_ptr<Shapes> one_ball(const Vec3& centre, double radius) {
  auto shapes = std::make_shared<Shapes>();
  shapes->push_back({std::make_unique<Sphere>(centre, radius), 0});
  return shapes;
}
std::shared_ptr<Shapes> balls(Random& random, int count, double least, double most) {
  auto shapes = std::make_shared<Shapes>();
  for (int s = 0; s < count; ++s)
    shapes->push_back(
        {std::make_unique<Sphere>(random_point(random, 0, 10), uniform(random, least, most)), s % 3});
  return shapes;
}
std::int32_t material_at(const Shapes& shapes, const Vec3& p, std::int32_t outside) {
  for (const InsertedShape& s : shapes)
    if (s.shape->contains({p, p})) return s.material;
  return outside;
}
double ball(double radius) { return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius; }

TEST(HexShapeField, BoxesGetTheSameBits) {
  Random random(1);
  const auto shapes = balls(random, 60, 0.5, 2.5);
  const auto field = shape_field(shapes, kSpace, 3);
  const auto hexes = shape_hex_field(shapes, kSpace, 3);
  for (int n = 0; n < 300; ++n) {
    const Vec3 lo = random_point(random, 0, 9), hi = lo + random_point(random, 0.3, 1.5);
    Fractions expected, found;
    field->measure({lo, hi}, expected);
    field->measure({lo, hi}, expected);
    field->measure({lo, hi}, expected);
    hexes->measure(box_hex(lo, hi), found);
    hexes->measure(renumbered(box_hex(lo, hi)), found);
    hexes->measure(with_cycled_axes(box_hex(lo, hi)), found);
    EXPECT_EQ(found.offset, expected.offset);
    EXPECT_EQ(found.material, expected.material);
    EXPECT_EQ(found.value, expected.value);
  }
}

TEST(HexShapeField, MeasuresOneBallOfAnySizeInWarpedHexes) {
  for (const double radius : {0.3, 0.6, 1.0, 2.0, 4.0, 30.0}) {
    Random random(2);
    double worst = 0;
    constexpr int kHexes = 10;
    for (int n = 0; n < kHexes; ++n) {
      const Vec3 at = random_point(random, 4, 6);
      const Vec3 centre = at + uniform(random, 0.8, 1.0) * radius * unit(random_point(random, -1, 1));
      const auto shapes = one_ball(centre, radius);
      const HexCorners hex = random_hex(random, at, 1, 0.15);
      Fractions f;
      shape_hex_field(shapes, kSpace, 1)->measure(hex, f);
      const double expected =
          shares_by_points(hex, 2, 48, [&](const Vec3& p) { return material_at(*shapes, p, 1); })[0];
      const double error = fraction_of(f, 0, 0) - expected;
      worst = std::max(worst, std::fabs(error));
    }
    EXPECT_LT(worst, 1e-3) << "radius " << radius;
  }
}

TEST(HexShapeField, TheFirstOfOverlappingShapesWins) {
  Random random(3);
  double worst = 0;
  const auto shapes = balls(random, 200, 0.5, 2);
  const auto field = shape_hex_field(shapes, kSpace, 3);
  for (int n = 0; n < 15; ++n) {
    const HexCorners hex = random_hex(random, random_point(random, 0, 10), 0.8, 0.15);
    MaterialData data;
    field->measure(hex, data.fractions);
    expect_valid(data);
    const std::vector<double> expected =
        shares_by_points(hex, 4, 32, [&](const Vec3& p) { return material_at(*shapes, p, 3); });
    for (std::int32_t m = 0; m < 4; ++m)
      worst = std::max(worst,
                       std::fabs(fraction_of(data.fractions, 0, m) - expected[static_cast<std::size_t>(m)]));
  }
  EXPECT_LT(worst, 3e-3);
}

// Hexes around a ball, in sheared and in bent lattices: all together hold the ball.
TEST(HexShapeField, HexesTogetherHoldTheBall) {
  const std::vector<std::function<Vec3(const Vec3&)>> maps = {
      [](const Vec3& p) {
        return Vec3{10 * p.x + 3 * p.y - 1.5, 10 * p.y + 2 * p.z - 1, 10 * p.z};
      },
      [](const Vec3& p) {
        const double a = 0.5 * std::numbers::pi * (p.x - 0.5), r = 6 + 10 * p.y;
        return Vec3{5 + r * std::sin(a), r * std::cos(a) - 5, 10 * p.z + std::sin(3 * p.x)};
      }};
  for (const auto& map : maps) {
    const auto field = shape_hex_field(one_ball({5.1, 4.9, 5.2}, 2.7), kSpace, 1);
    double volume = 0;
    for (const HexCorners& hex : mapped_lattice(20, map)) {
      Fractions f;
      field->measure(hex, f);
      volume += fraction_of(f, 0, 0) * hex_volume(hex);
    }
    EXPECT_NEAR(volume / ball(2.7), 1, 2e-5);
  }
}

// Shells of hexes between a cube and a ball, whose outer faces lie near the sphere.
TEST(HexShapeField, ShellsOfHexesOnTheSphere) {
  const auto field = shape_hex_field(one_ball({5, 5, 5}, 3), kSpace, 1);
  constexpr int kN = 8;
  double inside = 0, shell = 0;
  const auto on = [](int axis, double sign, double u, double v, double r) {
    Vec3 p;
    p[static_cast<std::size_t>(axis)] = sign;
    p[static_cast<std::size_t>((axis + 1) % 3)] = sign * std::tan(0.25 * std::numbers::pi * u);
    p[static_cast<std::size_t>((axis + 2) % 3)] = std::tan(0.25 * std::numbers::pi * v);
    return Vec3{5, 5, 5} + r * unit(p);
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0})
      for (int i = 0; i < kN; ++i)
        for (int j = 0; j < kN; ++j)
          for (const double r : {2.6, 3.0}) {
            HexCorners p;
            for (std::size_t c = 0; c < 8; ++c)
              p[c] = on(axis, sign, 2.0 * (i + kCornerOffset[c][0]) / kN - 1,
                        2.0 * (j + kCornerOffset[c][1]) / kN - 1, r + 0.4 * kCornerOffset[c][2]);
            ASSERT_GT(hex_volume(p), 0);
            MaterialData data;
            field->measure(p, data.fractions);
            expect_valid(data);
            inside += fraction_of(data.fractions, 0, 0) * hex_volume(p);
            if (r < 3) shell += hex_volume(p);
            if (r < 3) EXPECT_EQ(fraction_of(data.fractions, 0, 0), 1);  // the corners lie on the sphere
            if (r >= 3) EXPECT_LT(fraction_of(data.fractions, 0, 0), 0.06);
          }
  // The shell from the inner polyhedron to the sphere; that of 2.6 is (2.6/3)^3 of that of 3.
  const double inner = shell / (1 - std::pow(2.6 / 3, 3)) * std::pow(2.6 / 3, 3);
  EXPECT_NEAR((inside + inner) / ball(3), 1, 1e-4);
}

TEST(HexShapeField, DiatomSourceNeedsNoGridOnAMesh) {
  const TemporaryFile file(
      "diatom\npackage 'a'\nmaterial 4\ninsert sphere\n center = 5 5 5\n radius = 2\nendinsert\nendpackage\n"
      "enddiatom\n");
  Deck deck;
  deck.diatom_file = file.path();
  deck.input_mesh = "m.g";
  const auto source = open_source(Comm::self(), deck, Log(), Box{{0, 0, 0}, {10, 10, 5}});
  const std::vector<IndexBox> nothing(1);
  const MaterialData data = source->read(Comm::self(), nothing);
  EXPECT_EQ(data.table.block_id, (std::vector<std::int64_t>{4, 5}));
  EXPECT_EQ(data.fractions.cells(), 0);
  const auto field = source->hex_field({}, {}, 0);
  Fractions f;
  field->measure(box_hex({4, 4, 4}, {5, 5, 5}), f);
  field->measure(box_hex({0, 0, 0}, {1, 1, 1}), f);
  EXPECT_EQ(fraction_of(f, 0, 0), 1);
  EXPECT_EQ(fraction_of(f, 1, 1), 1);
}

}  // namespace
}  // namespace sculpt
