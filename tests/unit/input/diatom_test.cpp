#include <array>
#include <numbers>

#include "input_fixture.hpp"

namespace sculpt {
namespace {

std::string sphere(const std::string& center, const std::string& radius) {
  return "insert sphere\n center = " + center + "\n radius = " + radius + "\nendinsert\n";
}
std::string package(int material, const std::string& inserts) {
  return "package 'p'\nmaterial " + std::to_string(material) + "\n" + inserts + "endpackage\n";
}
std::string diatom(const std::string& packages) { return "diatom\n" + packages + "enddiatom\n"; }
std::string concentric(const std::string& inner, const std::string& outer) {
  return diatom(package(1, sphere("0 0 0", inner)) + package(2, sphere("0 0 0", outer)));
}

MaterialData measure(const std::string& text, std::int64_t cells, double half_width,
                     std::optional<IndexBox> box = std::nullopt) {
  const TemporaryFile file(text);
  return read_box(Comm::self(), diatom_deck(file.path(), cells, half_width), box);
}

std::string diatom_error(const std::string& text) {
  return error_of([&] { (void)measure(text, 2, 1); });
}

// Volume of a material in cells.
double volume(const Fractions& fractions, std::int32_t material) {
  double sum = 0;
  for (std::size_t e = 0; e < fractions.value.size(); ++e)
    if (fractions.material[e] == material) sum += fractions.value[e];
  return sum;
}

double ball(double radius) { return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius; }

TEST(Diatom, MeasuresTheVolumeOfABall) {
  // 26^3 cells around a ball of radius 0.4995; the box is that of the reference case, not quite symmetric.
  const TemporaryFile file(diatom(package(1, sphere("0 0 0", "0.4995"))));
  Deck deck = diatom_deck(file.path(), 26, 0.6241);
  deck.xmin = -0.624136;
  deck.zmax = 0.624033;
  const MaterialData data = read_box(Comm::self(), deck);
  expect_valid(data);
  const double cell = (0.624136 + 0.6241) * 2 * 0.6241 * (0.6241 + 0.624033) / (26.0 * 26 * 26);
  EXPECT_NEAR(volume(data.fractions, 0) * cell / ball(0.4995), 1, 1e-4);
}

TEST(Diatom, TwoConcentricBallsShareTheirCells) {
  const MaterialData data = measure(concentric("5", "10"), 16, 16);
  expect_valid(data);
  EXPECT_EQ(data.table.block_id, (std::vector<std::int64_t>{1, 2, 3}));
  EXPECT_EQ(data.table.void_material, 2);
  EXPECT_NEAR(volume(data.fractions, 0) * 8 / ball(5), 1, 1e-4);
  EXPECT_NEAR(volume(data.fractions, 1) * 8 / (ball(10) - ball(5)), 1, 1e-4);
}

// The reference case of real Sculpt: 152 + 1048 hexes, of which 96 and 552 are buffer hexes, leave 56 + 496
// cells.
TEST(Diatom, TwoConcentricBallsFillTheCellsOfTheReference) {
  const MaterialData data = measure(concentric("5", "10"), 16, 16);
  std::array<int, 3> cells{};
  for (std::size_t e = 0; e < data.fractions.value.size(); ++e)
    if (data.fractions.value[e] > 0.5) ++cells[static_cast<std::size_t>(data.fractions.material[e])];
  EXPECT_EQ(cells, (std::array<int, 3>{56, 496, 3544}));
}

// A face plane of the ball's octants lies on cell boundaries: eight cells with the same fraction, known
// exactly.
TEST(Diatom, OctantsOfABallAreEqualAndExact) {
  const MaterialData data = measure(diatom(package(1, sphere("0 0 0", "1"))), 2, 1);
  ASSERT_EQ(data.fractions.cells(), 8);
  for (std::int64_t c = 0; c < 8; ++c) {
    EXPECT_NEAR(fraction_of(data.fractions, c, 0), std::numbers::pi / 6, 2e-4);
    EXPECT_NEAR(fraction_of(data.fractions, c, 0), fraction_of(data.fractions, 0, 0), 1e-12);
  }
}

TEST(Diatom, CellsInsideAndOutsideArePure) {
  // Cells of size 2: the middle one reaches sqrt(3) from the centre, the next ones begin at 1, the last at 3.
  const MaterialData data = measure(diatom(package(4, sphere("0 0 0", "2"))), 5, 5);
  EXPECT_EQ(fraction_of(data.fractions, 62, 0), 1.0);
  EXPECT_LT(fraction_of(data.fractions, 63, 0), 1.0);
  EXPECT_GT(fraction_of(data.fractions, 63, 0), 0.0);
  EXPECT_EQ(fraction_of(data.fractions, 64, 1), 1.0);
}

TEST(Diatom, TheFirstInsertedWins) {
  // Equal balls: the first takes all. A ball inside an earlier one gets nothing, around it the remainder.
  const MaterialData equal =
      measure(diatom(package(7, sphere("0 0 0", "1")) + package(3, sphere("0 0 0", "1"))), 4, 1.2);
  EXPECT_EQ(equal.table.block_id, (std::vector<std::int64_t>{3, 7, 8}));
  EXPECT_NEAR(volume(equal.fractions, 0), 0, 1e-12);
  EXPECT_GT(volume(equal.fractions, 1), 1);
  const MaterialData hidden =
      measure(diatom(package(2, sphere("0 0 0", "10")) + package(1, sphere("0 0 0", "5"))), 16, 16);
  EXPECT_EQ(volume(hidden.fractions, 0), 0);
  EXPECT_NEAR(volume(hidden.fractions, 1) * 8 / ball(10), 1, 1e-4);
}

TEST(Diatom, PackagesMayShareAMaterial) {
  const std::string inserts = sphere("-2 0 0", "1.5") + sphere("2 0 0", "1.5");
  const MaterialData data = measure(diatom(package(1, inserts) + package(1, sphere("0 2.5 0", "1"))), 20, 4);
  EXPECT_EQ(data.table.block_id, (std::vector<std::int64_t>{1, 2}));
  // The small ball is apart from the large ones: the centres are sqrt(10.25) = 3.2 from each other.
  EXPECT_NEAR(volume(data.fractions, 0) * 0.064 / (2 * ball(1.5) + ball(1)), 1, 1e-4);
}

// Shapes are surfaces, packages are parts; those of one name are one part.
TEST(Diatom, TellsItsSurfaces) {
  const TemporaryFile file(diatom("package grain\nmaterial 4\n" + sphere("-2 0 0", "1") +
                                  sphere("2 0 0", "1") + "endpackage\npackage\nmaterial 2\n" +
                                  sphere("0 2 0", "1") + "endpackage\n package 'grain'\nmaterial 4\n" +
                                  sphere("0 -2 0", "1") + "endpackage\n"));
  const Deck deck = diatom_deck(file.path(), 16, 4);
  const GeometrySurfaces s = open_source(Comm::self(), deck, Log(false))->geometry_surfaces();
  EXPECT_EQ(s.surface_name, (std::vector<std::string>{"grain 1", "grain 2", "package_2 1", "grain 3"}));
  EXPECT_EQ(s.part_name, (std::vector<std::string>{"grain", "package_2"}));
  EXPECT_EQ(s.part_of_surface, (std::vector<std::int32_t>{0, 0, 1, 0}));
  const std::int32_t two = 0, four = 1, outside = 2;
  EXPECT_EQ(s.nearest({2.9, 0, 0}, four, outside), 1);
  EXPECT_EQ(s.nearest({0, -1.1, 0}, outside, four), 3);
  EXPECT_EQ(s.nearest({0, 1.2, 0}, two, -1), 2);
  EXPECT_EQ(s.nearest({0, 1.2, 0}, four, outside), std::nullopt) << "another material";
  EXPECT_EQ(s.nearest({0, 0, 3.5}, two, four), std::nullopt) << "far away";
}

TEST(Diatom, CellsDoNotDependOnTheBox) {
  const std::string text = diatom(package(1, sphere("0.3 0.1 0", "0.7") + sphere("-0.4 0 0.2", "0.6")) +
                                  package(2, sphere("0 0.5 -0.2", "0.8")));
  const MaterialData all = measure(text, 9, 1.1);
  const IndexBox box{{2, 3, 1}, {7, 4, 9}};
  const MaterialData part = measure(text, 9, 1.1, box);
  ASSERT_EQ(part.fractions.cells(), box.size());
  for (std::int64_t c = 0; c < box.size(); ++c)
    for (std::int32_t m = 0; m < 3; ++m)
      EXPECT_EQ(fraction_of(part.fractions, c, m),
                fraction_of(all.fractions, whole({9, 9, 9}).position(box.cell(c)), m));
}

TEST(Diatom, TheVoidTakesVoidMat) {
  const TemporaryFile file(concentric("0.5", "0.8"));
  Deck deck = diatom_deck(file.path(), 4, 1);
  deck.void_mat = 2;
  deck.given_options.add("void_mat", "test");
  MaterialTable table = read_box(Comm::self(), deck).table;
  EXPECT_EQ(table.block_id, (std::vector<std::int64_t>{1, 2, 3})) << "a void that is not meshed stays apart";
  EXPECT_EQ(table.void_material, 2);
  deck.mesh_void = true;
  const MaterialData joined = read_box(Comm::self(), deck);
  EXPECT_EQ(joined.table.block_id, (std::vector<std::int64_t>{1, 2}));
  EXPECT_FALSE(joined.table.void_material);
  EXPECT_EQ(fraction_of(joined.fractions, 0, 1), 1.0);
  deck.void_mat = 77;
  table = read_box(Comm::self(), deck).table;
  EXPECT_EQ(table.block_id, (std::vector<std::int64_t>{1, 2, 77}));
  EXPECT_EQ(table.void_material, 2);
}

TEST(Diatom, UnderstandsCthSpellings) {
  const MaterialData data = measure(
      "* a CTH comment\n$ and one of Sculpt's\nDIATOMS\n PACK \"ball\" $ here too\n  mat 5\n  velocity = 1. "
      "0., 0\n"
      "  temperature 0.0257\n  INS SPHERE\r\n   cent 0., 0. 0\n   rad 1.\n  ENDI\n endp\nENDDIA\n",
      2, 1);
  EXPECT_EQ(data.table.block_id, (std::vector<std::int64_t>{5, 6}));
  EXPECT_NEAR(volume(data.fractions, 0), ball(1), 1e-3);
}

TEST(Diatom, TakesSeveralBlocksAndBareNames) {
  const MaterialData data = measure("diatoms\npackage ball material 3\n" + sphere("-1 0 0", "0.5") +
                                        "endp\nendd\nDIATOM\npackage\nmaterial 9\n" + sphere("1 0 0", "0.5") +
                                        "endpackage\nenddia\n",
                                    4, 2);
  EXPECT_EQ(data.table.block_id, (std::vector<std::int64_t>{3, 9, 10}));
}

// What is wrong with an insert; the line after 'insert <shape>' is line 5.
std::string insert_error(const std::string& shape, const std::string& body) {
  return diatom_error("diatom\npackage 'a'\nmaterial 1\ninsert " + shape + "\n" + body +
                      "endinsert\nendpackage\nenddiatom\n");
}
void expect_error(const std::string& error, const std::string& part) {
  EXPECT_TRUE(contains(error, part)) << "expected: " << part << "\nin: " << error;
}

TEST(Diatom, NamesTheLineOfAMistakeInASphere) {
  EXPECT_EQ(insert_error("sphere", "center 0 0 0\nradius 1\n"), "");
  const auto expect = [](const std::string& body, const std::string& part) {
    expect_error(insert_error("sphere", body), part);
  };
  expect("center 0 0 0\nradius 0\n", "line 6: found radius 0, expected a value > 0");
  expect("center 0 0 0\nradius -2\n", "line 6: found radius -2, expected a value > 0");
  expect("center 0 0\nradius 1\n", "line 5: found 2 numbers after 'center' and then 'radius', expected 3");
  expect("center 0 0 0 0\nradius 1\n",
         "line 5: found 4 numbers after 'center' and then 'radius', expected 3");
  expect("center 0 0 zero\nradius 1\n", "line 5: found 2 numbers after 'center' and then 'zero', expected 3");
  expect("center 0 0 '0'\nradius 1\n", "line 5: found 2 numbers after 'center' and then '0', expected 3");
  expect("center 0 nan 0\nradius 1\n", "line 5: found nan after 'center', expected finite numbers");
  expect("center 0 0 0\nradius inf\n", "line 6: found inf after 'radius', expected finite numbers");
  expect("center 0 0 0\nradius 1e60\n", "line 4: found 1e+60, expected coordinates and lengths up to");
  expect("radius 1\n", "line 4: the sphere has no 'center', expected 'center' and 3 numbers (x y z)");
  expect("center 0 0 0\n", "line 4: the sphere has no 'radius', expected 'radius' and 1 number");
  expect("center 0 0 0\nradius 1\nr 2\n", "line 7: 'radius' is given twice, first in line 6");
  expect("radus 3\n",
         "line 5: found 'radus', expected 'center', 'radius', 'rotate', 'translate', 'scale', 'delete' or "
         "'endinsert'; did you mean 'radius'?");
}

TEST(Diatom, NamesTheLineOfAMistakeInAShape) {
  const std::string ends = "ce1 0 0 0\nce2 0 0 1\n";
  expect_error(insert_error("banana", ""),
               "line 4: found shape 'banana', expected 'sphere', 'ellipsoid', 'box', 'parallelepiped', "
               "'planes', 'cylinder', 'cone', 'torus', 'tet', 'wedge', 'hex', 'revolution', 'extrusion' or "
               "'stl'");
  expect_error(insert_error("cilinder", ""), "; did you mean 'cylinder'?");
  expect_error(insert_error("circle", "center 0 0\nradius 1\n"),
               "line 4: insert 'circle' is two-dimensional, expected a solid: 'sphere'");
  expect_error(insert_error("cone", ends + "rad 1\n"),
               "line 7: found 'rad', which may mean several keywords, expected 'rad1' or 'rad2'");
  expect_error(insert_error("cone", ends + "rad1 -1\nrad2 1\n"),
               "line 7: found rad1 -1, expected a value >= 0");
  expect_error(insert_error("ellipsoid", "center 0 0 0\nradii 1 2\n"),
               "line 6: found 2 numbers after 'radii' and then 'endinsert', expected 3 numbers (the radii");
  expect_error(insert_error("torus", "center 0 0 0\naxis 0 0 0\n"),
               "line 6: found direction 0 0 0 after 'axis', expected one with a length");
  expect_error(insert_error("planes", "plane 0 0 0 0 0 0\n"), "line 5: found direction 0 0 0 after 'plane'");
  expect_error(insert_error("revolution", ends), "line 4: the revolution has no 'p'");
  expect_error(insert_error("revolution", ends + "p = 1 2 3\n"), "line 7: found 3 numbers after 'p'");
  expect_error(insert_error("stl", "file\n"),
               "line 5: found the end of the line after 'file', expected the name");
  expect_error(insert_error("stl", "file ''\n"),
               "line 5: found '' after 'file', expected the name of an STL");
  expect_error(insert_error("sphere", "rotate 90 0 0 1 0\n"),
               "line 5: found 5 numbers after 'rotate' and then 'endinsert', expected 4 or 7");
  expect_error(insert_error("sphere", "rotate 90 0 0 0\n"), "line 5: found direction 0 0 0 after 'rotate'");
  expect_error(insert_error("sphere", "scale 0\n"), "line 5: found scale 0, expected a value > 0");
  expect_error(
      insert_error("sphere", "delete box\np1 0 0 0\nendinsert\n"),
      "line 7: found 'endinsert', expected 'p1', 'p2', 'rotate', 'translate', 'scale' or 'enddelete'");
  expect_error(insert_error("sphere", "scale 1e30\nscale 1e30\n"), "line 6: found scale 1e+60 in all");
  expect_error(insert_error("sphere", "translate 1 0 0\ntranslate 0 -2e60 0\n"),
               "line 6: found a move by 2e+60 in all");
  expect_error(insert_error("sphere", "delete box\np1 0 0 0\nenddelete\n"), "line 5: the box has no 'p2'");
}

TEST(Diatom, SolidsWithoutVolumeAreNamed) {
  const std::string zero = "0 0 0\n";
  expect_error(insert_error("box", "p1 " + zero + "p2 1 0 1\n"), "line 4: a side of a box is 0");
  expect_error(insert_error("cylinder", "ce1 " + zero + "ce2 " + zero + "radius 1\n"),
               "line 4: a cylinder: both ends of its axis are (0 0 0)");
  expect_error(insert_error("tet", "p1 0 0 0\np2 1 0 0\np3 0 1 0\np4 1 1 0\n"),
               "line 4: the corners of a polyhedron lie in one plane");
  expect_error(insert_error("planes", "plane 0 0 0 0 0 1\n"),
               "line 4: 1 planes leave a way to infinity open");
  expect_error(insert_error("sphere",
                            "center 0 0 0 radius 1\ndelete cone\nce1 0 0 0 ce2 1 0 0\nr1 0 r2 0\n"
                            "enddelete\n"),
               "line 6: a cone has the radii 0 and 0");
}

TEST(Diatom, NamesTheLineOfAMistakeInABlock) {
  const auto expect = [](const std::string& text, const std::string& part) {
    expect_error(diatom_error(text), part);
  };
  const std::string ball = sphere("0 0 0", "1");
  expect("diatom\npackage 'a'\nmaterial 0\n", "line 3: found material '0', expected an integer from 1");
  expect("diatom\npackage 'a'\nmaterial 1 2\n", "line 3: found '2', expected 'material', 'insert'");
  expect("diatom\npackage 'a'\nmaterial 1\nmaterial 1\n", "line 4: 'material' is given twice");
  expect("diatom\npackage 'a'\n" + ball + "endpackage\nenddiatom\n",
         "line 2: package 'a' has no material, expected 'material <id>'");
  expect("diatom\npackage 'a'\nmaterial 1\ntemprature 300\n",
         "line 4: found 'temprature', expected 'material', 'insert', 'delete' or 'endpackage' or a state "
         "such as "
         "'velocity'; did you mean 'temperature'?");
  expect("diatom\n" + ball + "enddiatom\n", "line 2: found 'insert', expected 'package' or 'enddiatom'");
  expect(ball, "line 1: found 'insert', expected 'diatom'");
  expect("diatom\npackage 'a'\nmaterial 1\ninsert sphere\nradius 1\n",
         "line 4: 'insert' is not closed, expected 'endinsert'");
  expect("diatom\npackage 'a'\nmaterial 1\ndelete sphere\n", "line 4: 'delete' is not closed");
  expect("diatom\npackage 'a'\nmaterial 1\n", "line 2: 'package' is not closed");
  expect("diatom\npackage 'a'\nmaterial 1\ninsert\n", "line 4: the file ends, expected the name of a shape");
  expect("\ndiatom\n", "line 2: 'diatom' is not closed, expected 'enddiatom'");
  expect("hello\n", "line 1: found 'hello', expected 'diatom'");
  expect("diatom\nenddiatom\n", "holds no shape");
  expect("diatom\npackage 'a'\nmaterial 1\nendpackage\nenddiatom\n", "holds no shape");
  expect("diatom\npackage 'a\n", "line 2: the line ends, expected a closing '");
}

TEST(Diatom, NeedsAGrid) {
  const TemporaryFile file(concentric("0.5", "0.8"));
  Deck deck = diatom_deck(file.path(), 4, 1);
  deck.given_options = {};
  EXPECT_TRUE(contains(error_of([&] { (void)open_source(Comm::self(), deck, Log()); }),
                       "diatom_file needs a grid: expected cell_size, or nelx, nely and nelz"));
  deck = diatom_deck(file.path(), 4, 1);
  deck.ymax = -1;
  EXPECT_TRUE(contains(error_of([&] { (void)open_source(Comm::self(), deck, Log()); }),
                       "ymin = -1, ymax = -1: expected ymin < ymax"));
  deck = diatom_deck(file.path() + ".not", 4, 1);
  EXPECT_TRUE(
      contains(error_of([&] { (void)open_source(Comm::self(), deck, Log()); }), "diatom_file: cannot open"));
}

TEST(Diatom, PrintsItsProgress) {
  const TemporaryFile file(concentric("0.5", "0.8"));
  testing::internal::CaptureStdout();
  const auto source = open_source(Comm::self(), diatom_deck(file.path(), 2, 1), Log(true));
  (void)source->read(Comm::self(), std::vector<IndexBox>(1, whole({2, 2, 2})));
  EXPECT_EQ(testing::internal::GetCapturedStdout(),
            "initializing geometry...\n Parsing diatom input\n Finished loading diatom master buffer\n"
            " Finished communicating diatom master buffer\n Finished creating diatoms\n"
            "inserting volume fractions...\n");
}

}  // namespace
}  // namespace sculpt
