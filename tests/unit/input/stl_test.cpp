#include "input/stl.hpp"

#include <cmath>

#include "hex_fixture.hpp"
#include "input/shape_fractions.hpp"
#include "input_fixture.hpp"
#include "sculpt/geom/sphere.hpp"
#include "support/surfaces.hpp"

namespace sculpt {
namespace {

using test::Facets;
using test::operator+;
using Shapes = std::vector<InsertedShape>;

const Grid kSpace = uniform_grid({10, 10, 10}, {-1.5, -1.5, -1.5}, {0.3, 0.3, 0.3});

std::shared_ptr<Shapes> solid_of(const Facets& facets) {
  auto shapes = std::make_shared<Shapes>();
  shapes->push_back({std::make_unique<FacetedSolid>(test::mesh_of(facets)), 0});
  return shapes;
}
Facets potato(int slices) {
  return test::ball_facets(slices, [](const Vec3& w) {
    return 1 + 0.3 * std::sin(3 * w.x + 1) * std::cos(4 * w.y) + 0.2 * std::sin(5 * w.z + w.x);
  });
}

// The share of a box by many lines.
double fine_share(const Shape& solid, const Box& box) {
  constexpr std::size_t kLines = 200;
  std::unique_ptr<Shape> storage;
  const Shape& patch = solid.within(box, storage);
  std::vector<double> v;
  for (std::size_t l = 0; l < kLines; ++l)
    v.push_back(box.lo.z + (static_cast<double>(l) + 0.5) / kLines * (box.hi.z - box.lo.z));
  double sum = 0;
  for (std::size_t l = 0; l < kLines; ++l) {
    ChordRow row;
    row.begin(kLines);
    const double u = box.lo.y + (static_cast<double>(l) + 0.5) / kLines * (box.hi.y - box.lo.y);
    patch.chords(0, u, v, row);
    for (std::size_t layer = 0; layer < row.layers(); ++layer)
      for (std::size_t i = 0; i < kLines; ++i) sum += row.hi(layer)[i] - row.lo(layer)[i];
  }
  return sum / (kLines * kLines * (box.hi.x - box.lo.x));
}

double share_of(const Fractions& f) { return fraction_of(f, 0, 0); }

TEST(StlFractions, OfRandomBoxesAreRight) {
  Random random(3);
  for (const int slices : {8, 30, 120}) {
    const auto shapes = solid_of(potato(slices));
    const auto field = shape_field(shapes, kSpace, 1);
    double worst = 0;
    for (int n = 0; n < 40; ++n) {
      const Vec3 lo = random_point(random, -1, 0.8), hi = lo + random_point(random, 0.1, 0.3);
      Fractions found;
      field->measure({lo, hi}, found);
      worst = std::max(worst, std::fabs(share_of(found) - fine_share(*(*shapes)[0].shape, {lo, hi})));
    }
    EXPECT_LT(worst, 4e-4);
  }
}

TEST(StlFractions, OfBoxesAlongTheAxesAreExact) {
  const auto shapes = solid_of(test::box_facets({-1, -1, -1}, {1, 1, 1}));
  const auto field = shape_field(shapes, kSpace, 1);
  Random random(5);
  for (int n = 0; n < 40; ++n) {
    const Vec3 lo = random_point(random, 0.7, 1), hi = lo + random_point(random, 0.3, 0.4);
    Fractions found;
    field->measure({lo, hi}, found);
    double exact = 1;
    for (std::size_t d = 0; d < 3; ++d) exact *= (1 - lo[d]) / (hi[d] - lo[d]);
    EXPECT_NEAR(share_of(found), exact, 1e-12);
  }
}

TEST(StlFractions, OfHexesAreThoseOfTheBallThatIsMeant) {
  auto exact = std::make_shared<Shapes>();
  exact->push_back({std::make_unique<Sphere>(Vec3{0, 0, 0}, 1.0), 0});
  const auto ball = shape_hex_field(exact, kSpace, 1);
  const auto facets =
      shape_hex_field(solid_of(test::ball_facets(160, [](const Vec3&) { return 1.0; })), kSpace, 1);
  Random random(8);
  int mixed = 0;
  for (int n = 0; n < 40; ++n) {
    const HexCorners hex = random_hex(random, random_point(random, -0.9, 0.9), 0.3, 0.1);
    Fractions a, b;
    ball->measure(hex, a);
    facets->measure(hex, b);
    EXPECT_NEAR(share_of(a), share_of(b), 3e-3);
    mixed += share_of(b) > 0 && share_of(b) < 1;
  }
  EXPECT_GT(mixed, 10);
}

// Hexes of a solid that is not convex: corners inside do not make a hex full.
TEST(StlFractions, HexesMayHaveAllCornersInside) {
  const auto field =
      shape_hex_field(solid_of(test::box_facets({-1, -1, -1}, {1, 1, 1}) +
                               test::turned(test::box_facets({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}))),
                      kSpace, 1);
  HexCorners hex = box_hex({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  hex[6] = {0.5, 0.5, 0.6};
  Fractions found;
  field->measure(hex, found);
  EXPECT_NEAR(share_of(found), 1 - 0.008 / 1.025, 1e-3);
}

TEST(StlFractions, TheFirstShapeWins) {
  auto shapes = std::make_shared<Shapes>();
  shapes->push_back(
      {std::make_unique<FacetedSolid>(test::mesh_of(test::box_facets({0, 0, 0}, {1, 1, 0.5}))), 2});
  shapes->push_back({std::make_unique<Sphere>(Vec3{0, 0, 0}, 9.0), 1});
  const auto field = shape_field(shapes, kSpace, 0);
  Fractions found;
  field->measure({{0.2, 0.2, 0.2}, {0.8, 0.8, 1.2}}, found);
  EXPECT_NEAR(fraction_of(found, 0, 2), 0.3, 1e-12);
  EXPECT_NEAR(fraction_of(found, 0, 1), 0.7, 1e-12);
}

std::string error_of(const std::vector<StlFile>& files) {
  try {
    (void)open_solids(Comm::self(), Deck{}, files, Log());
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(OpenSolids, NamesAllFilesThatAreMissing) {
  std::vector<StlFile> files;
  for (int f = 0; f < 23; ++f) files.push_back({"missing_" + std::to_string(f) + ".stl", "d.diatom, line 7"});
  const std::string error = error_of(files);
  EXPECT_TRUE(error.starts_with("d.diatom, line 7: cannot open 23 of 23 STL files: 'missing_0.stl', "))
      << error;
  EXPECT_TRUE(error.ends_with("'missing_19.stl' and 3 more")) << error;
  EXPECT_EQ(error_of({files[2]}), "d.diatom, line 7: cannot open 'missing_2.stl': No such file or directory");
}

TEST(OpenSolids, FilesWithoutFacetsAreNoShapes) {
  const TemporaryFile nothing("solid a\nendsolid a\n"), zero(""),
      cube(test::binary_stl(test::box_facets({0, 0, 0}, {1, 1, 1})));
  const auto solids = open_solids(Comm::self(), Deck{},
                                  {{nothing.path(), "x"}, {cube.path(), "x"}, {zero.path(), "x"}}, Log());
  EXPECT_EQ(solids[0].solid, nullptr);
  EXPECT_EQ(solids[2].solid, nullptr);
  EXPECT_EQ(solids[1].solid->bounds().hi, (Vec3{1, 1, 1}));
}

}  // namespace
}  // namespace sculpt
