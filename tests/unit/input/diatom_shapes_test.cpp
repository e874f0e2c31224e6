// What the keywords of diatom files make: volumes of the shapes, where they stand, and what is deleted.
#include <cmath>
#include <numbers>

#include "input/diatom_shapes.hpp"
#include "input_fixture.hpp"

namespace sculpt {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::int64_t kCells = 20;
constexpr double kHalfWidth = 2;

std::string package(int material, const std::string& lines) {
  return "package 'p'\nmaterial " + std::to_string(material) + "\n" + lines + "endpackage\n";
}
std::string insert(const std::string& shape, const std::string& lines) {
  return "insert " + shape + "\n" + lines + "\nendinsert\n";
}
std::string remove(const std::string& shape, const std::string& lines) {
  return "delete " + shape + "\n" + lines + "\nenddelete\n";
}
std::string ball(const std::string& center, const std::string& radius) {
  return "center " + center + " radius " + radius + "\n";
}
std::string block(const std::string& p1, const std::string& p2) { return "p1 " + p1 + " p2 " + p2 + "\n"; }

MaterialData measure(const std::string& packages) {
  const TemporaryFile file("diatom\n" + packages + "enddiatom\n");
  return read_box(Comm::self(), diatom_deck(file.path(), kCells, kHalfWidth));
}
double volume(const MaterialData& data, std::int32_t material = 0) {
  const double width = 2 * kHalfWidth / kCells;
  double sum = 0;
  for (std::int64_t c = 0; c < data.fractions.cells(); ++c) sum += fraction_of(data.fractions, c, material);
  return sum * width * width * width;
}
double volume_of(const std::string& inserts) { return volume(measure(package(1, inserts))); }

// Every cell has the same fractions, nearly.
void expect_same(const MaterialData& a, const MaterialData& b) {
  for (std::int64_t c = 0; c < a.fractions.cells(); ++c)
    ASSERT_NEAR(fraction_of(a.fractions, c, 0), fraction_of(b.fractions, c, 0), 2e-3) << "cell " << c;
}
void expect_same_inserts(const std::string& a, const std::string& b) {
  expect_same(measure(package(1, a)), measure(package(1, b)));
}

struct Case {
  const char *shape, *lines;
  double volume;
};

class DiatomShape : public testing::TestWithParam<Case> {};

TEST_P(DiatomShape, HasItsVolumeHoweverItIsPlaced) {
  const auto& [shape, lines, expected] = GetParam();
  EXPECT_NEAR(volume_of(insert(shape, lines)) / expected, 1, 1e-3);
  const std::string placing = "\nscale 0.9\nrotate 33 1 2 3 0.1 0.2 0.3\ntranslate 0.05 -0.1 0.03\n";
  EXPECT_NEAR(volume_of(insert(shape, lines + placing)) / (0.729 * expected), 1, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(
    AllShapes, DiatomShape,
    testing::Values(
        Case{"sphere", "ce 0.1 0.2 0 r 0.8", 4 * kPi / 3 * 0.512},
        Case{"ellipsoid", "center 0.1 0 0 radius 1 0.7 0.5", 4 * kPi / 3 * 0.35},
        Case{"box", "p1 -1 -0.5 -0.3 p2 0.8 0.6 0.5", 1.8 * 1.1 * 0.8},
        Case{"parallelepiped", "p0 0 0 0 p1 1 0 0 p2 0.3 1 0 p3 0.1 0.2 0.9", 0.9},
        Case{"planes", "plane 0 0 0 -1 0 0 plane 0 0 0 0 -1 0 plane 0 0 0 0 0 -1 plane 0 0 1.2 1 1 1", 0.288},
        Case{"cylinder", "ce1 -0.5 0 0 ce2 0.6 0.3 0.2 radius 0.5 ri 0.2", kPi * 0.21 * std::sqrt(1.34)},
        Case{"cone", "ce1 0 0 -0.6 ce2 0 0 0.7 rad1 0.8 rad2 0.3", kPi * 1.3 / 3 * (0.64 + 0.24 + 0.09)},
        Case{"torus", "center 0.1 0 0 axis 0 0 2 major 0.8 minor 0.3", 2 * kPi* kPi * 0.8 * 0.09},
        Case{"tet", "p1 0 0 0 p2 1.2 0 0 p3 0 1 0 p4 0 0 0.9", 0.18},
        Case{"wedge", "p1 0 0 0 p2 1 0 0 p3 0 0.8 0 p4 0 0 0.9 p5 1 0 0.9 p6 0 0.8 0.9", 0.36},
        Case{"hex",
             "p1 -0.8 -0.8 -0.5 p2 0.8 -0.8 -0.5 p3 0.8 0.8 -0.5 p4 -0.8 0.8 -0.5\n"
             "p5 -0.5 -0.5 0.5 p6 0.5 -0.5 0.5 p7 0.5 0.5 0.5 p8 -0.5 0.5 0.5",
             1.72},
        Case{"revolution", "ce1 0 0 -1 ce2 0 0 1 p 0.3 0.2 p 0.8 0.2 p 0.8 1 p 0.3 1", kPi * 0.55 * 0.8},
        Case{"extrusion", "ce1 0 0 -0.5 ce2 0 0 0.5 u 1 0 0 p 0 0 p 1 0 p 1 0.4 p 0.4 0.4 p 0.4 1 p 0 1",
             0.64}),
    [](const auto& tested) { return std::string(tested.param.shape); });

TEST(DiatomKeywords, MayBeShortened) {
  expect_same_inserts(
      "INS Tor CENT=0,0,0 NORM 0 0 1\nMAJ 0.8 $ comment\nMIN 0.3 ROT=20,1,0,0 TRA 0.1 0 0 SCA 0.9\n"
      "* comment\nDEL Sph CE 1 0 0 RAD 0.5 ENDD\nENDI\n",
      insert("torus",
             "center = 0 0 0\naxis = 0 0 1\nr1 = 0.8\nr2 = 0.3\nrotate = 20 1 0 0\n"
             "translate = 0.1 0 0\nscale = 0.9\n" +
                 remove("sphere", "centre = 1 0 0\nr = 0.5")));
}

TEST(DiatomKeywords, AreInTheDocs) {
  std::ifstream page(SCULPT_SOURCE_DIR "/docs/shapes.md");
  const std::string text(std::istreambuf_iterator<char>(page), {});
  const auto expect_named = [&](std::string_view word) {
    EXPECT_TRUE(contains(text, "`" + std::string(word) + "`")) << word;
  };
  for (const ShapeKind& kind : shape_kinds()) {
    EXPECT_TRUE(contains(text, "\n| `" + std::string(kind.names[0]) + "`")) << kind.names[0];
    for (const ShapeParameter& parameter : kind.parameters) expect_named(parameter.names[0]);
  }
  for (const ShapeParameter& parameter : placing_parameters()) expect_named(parameter.names[0]);
}

TEST(DiatomPlacing, AppliesTheTransformationsInTheirOrder) {
  const std::string cube = block("0 0 0", "1 0.5 0.25");
  expect_same_inserts(insert("box", cube + "rotate 90 0 0 1 translate 0.5 0 0"),
                      insert("box", block("0 0 0", "0.5 1 0.25")));
  expect_same_inserts(insert("box", cube + "translate 0.5 0 0 rotate 90 0 0 1"),
                      insert("box", block("-0.5 0.5 0", "0 1.5 0.25")));
  expect_same_inserts(insert("box", cube + "translate 0.5 0 0 scale 0.5"),
                      insert("box", block("0.25 0 0", "0.75 0.25 0.125")));
  expect_same_inserts(insert("box", cube + "rotate 180 0 0 1 1 0 0"),
                      insert("box", block("1 -0.5 0", "2 0 0.25")));
}

TEST(DiatomPlacing, QuarterTurnsAreExact) {
  const MaterialData turned = measure(package(1, insert("sphere", ball("0 1 0", "0.5") + "rotate 90 1 0 0")));
  const MaterialData there = measure(package(1, insert("sphere", ball("0 0 1", "0.5"))));
  EXPECT_EQ(turned.fractions.value, there.fractions.value);
}

TEST(DiatomDelete, TakesPartsOutOfItsInsertAlone) {
  const std::string hole = remove("box", block("-0.2 -0.2 -2", "0.2 0.2 2"));
  const std::string plate = block("-1 -1 -0.25", "1 1 0.25");
  EXPECT_NEAR(volume_of(insert("box", plate + hole)), 2 - 0.08, 1e-3);
  // What comes after fills the hole.
  const MaterialData data =
      measure(package(1, insert("box", plate + hole)) + package(2, insert("box", plate)));
  EXPECT_NEAR(volume(data, 0), 2 - 0.08, 1e-3);
  EXPECT_NEAR(volume(data, 1), 0.08, 1e-3);
}

TEST(DiatomDelete, TakesPartsOutOfAllInsertsOfItsPackage) {
  const std::string hole = remove("box", block("-2 -0.2 -2", "2 0.2 2"));
  const std::string one = insert("box", block("-1.5 -0.5 0", "-0.5 0.5 1"));
  const std::string two = insert("box", block("0.5 -0.5 0", "1.5 0.5 1"));
  for (const std::string& lines : {hole + one + two, one + hole + two, one + two + hole})
    EXPECT_NEAR(volume_of(lines), 1.2, 1e-3);
  const MaterialData data = measure(package(1, one + hole) + package(2, two));
  EXPECT_NEAR(volume(data, 0), 0.6, 1e-3);
  EXPECT_NEAR(volume(data, 1), 1, 1e-3);
}

TEST(DiatomDelete, MovesWithItsInsert) {
  const std::string placing = "rotate 90 0 1 0 scale 0.5 translate 0 1 0\n";
  const std::string hole = remove("sphere", ball("0 0 0", "0.5") + "translate 1 0 0");
  expect_same_inserts(
      insert("box", block("-1 -0.5 -0.5", "1 0.5 0.5") + placing + hole),
      insert("box", block("-0.25 0.75 -0.5", "0.25 1.25 0.5") + remove("sphere", ball("0 1 -0.5", "0.25"))));
}

// A cube from 0 to 1 as facets.
std::string cube_stl() {
  std::string text = "solid cube\n";
  const auto facet = [&](std::array<int, 3> corners) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int c : corners)
      text += "vertex " + std::to_string(c & 1) + " " + std::to_string(c >> 1 & 1) + " " +
              std::to_string(c >> 2) + "\n";
    text += "endloop\nendfacet\n";
  };
  for (const std::array<int, 4>& f : std::initializer_list<std::array<int, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    facet({f[0], f[1], f[2]});
    facet({f[0], f[2], f[3]});
  }
  return text + "endsolid cube\n";
}

TEST(DiatomStl, IsPlacedAndCutLikeOtherShapes) {
  const TemporaryFile cube(cube_stl());
  const std::string more = "rotate 30 1 1 0 0.5 0.5 0.5\nscale 1.2\ntranslate -0.5 -0.4 -0.3\n" +
                           remove("sphere", ball("1 1 1", "0.4"));
  expect_same_inserts(insert("stl", "FILE = '" + cube.path() + "'\n" + more),
                      insert("box", block("0 0 0", "1 1 1") + more));
}

TEST(DiatomStl, MayBeDeletedAndGivenTwice) {
  const TemporaryFile cube(cube_stl());
  const std::string file = "file " + cube.path() + "\n";
  const std::string slab = block("-1 0 0", "1 1 0.5");
  EXPECT_NEAR(volume_of(insert("box", slab) + remove("stl", file)), 0.5, 1e-3);
  EXPECT_NEAR(volume_of(insert("box", slab + remove("stl", file + "scale 0.5"))), 1 - 0.125, 1e-3);
  EXPECT_NEAR(volume_of(insert("stl", file) + insert("stl", file + "translate -1.5 0 0")), 2, 1e-3);
}

TEST(DiatomStl, AFileWithoutFacetsFillsNothing) {
  const TemporaryFile empty("solid none\nendsolid none\n");
  const std::string file = "file '" + empty.path() + "'\n";
  EXPECT_NEAR(volume_of(insert("stl", file) + insert("sphere", ball("0 0 0", "1"))), 4 * kPi / 3, 2e-3);
  EXPECT_NEAR(volume_of(insert("sphere", ball("0 0 0", "1") + remove("stl", file))), 4 * kPi / 3, 2e-3);
  const std::string error = error_of([&] { (void)volume_of(insert("stl", file)); });
  EXPECT_TRUE(contains(error, "all of its STL files are empty")) << error;
}

TEST(DiatomStl, AllMissingFilesAreNamedOnce) {
  std::string lines;
  for (int f = 0; f < 24; ++f) lines += insert("stl", "file '/no/such/" + std::to_string(f) + ".stl'");
  const std::string error =
      error_of([&] { (void)volume_of(lines + insert("stl", "file '/no/such/0.stl'")); });
  EXPECT_TRUE(contains(error, "line 4: cannot open 24 of 24 STL files: '/no/such/0.stl', ")) << error;
  EXPECT_TRUE(contains(error, "'/no/such/19.stl' and 4 more")) << error;
  EXPECT_FALSE(contains(error, "20.stl")) << error;
}

TEST(DiatomWarning, TellsPackagesThatFillNothing) {
  const TemporaryFile file("diatom\n" + package(1, insert("sphere", ball("0 0 0", "1"))) +
                           package(2, insert("box", block("2.1 0 0", "3 1 1"))) + package(3, "") +
                           "enddiatom\n");
  testing::internal::CaptureStdout();
  (void)open_source(Comm::self(), diatom_deck(file.path(), kCells, kHalfWidth), Log(true));
  const std::string out = testing::internal::GetCapturedStdout();
  EXPECT_TRUE(contains(out, "WARNING: " + file.path() +
                                ", line 9: package 'p' fills nothing: it lies outside "
                                "the box of the grid\n"))
      << out;
  EXPECT_TRUE(contains(out, "line 16: package 'p' fills nothing: it has no solid\n")) << out;
  EXPECT_FALSE(contains(out, "line 2: ")) << out;
}

}  // namespace
}  // namespace sculpt
