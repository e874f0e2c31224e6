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

TEST(Diatom, NamesTheLineOfAMistake) {
  const auto in_sphere = [](const std::string& body) {
    return diatom_error("diatom\npackage 'a'\nmaterial 1\ninsert sphere\n" + body +
                        "endinsert\nendpackage\nenddiatom\n");
  };
  EXPECT_EQ(in_sphere("center 0 0 0\nradius 1\n"), "");
  EXPECT_TRUE(
      contains(in_sphere("center 0 0 0\nradius 0\n"), "line 6: found radius 0, expected a value > 0"));
  EXPECT_TRUE(contains(in_sphere("center 0 0 0\nradius -2\n"), "line 6: found radius -2"));
  EXPECT_TRUE(
      contains(in_sphere("center 0 0\nradius 1\n"), "line 6: found 'radius', expected three coordinates"));
  EXPECT_TRUE(contains(in_sphere("radius 1\n"), "line 4: the sphere has no center"));
  EXPECT_TRUE(contains(in_sphere("center 0 0 0\n"), "line 4: the sphere has no radius"));
  EXPECT_TRUE(contains(in_sphere("colour 3\n"),
                       "line 5: found 'colour', expected 'center', 'radius' or 'endinsert'"));
  EXPECT_TRUE(contains(diatom_error("diatom\npackage 'a'\nmaterial 1\ninsert box\n"),
                       "line 4: insert 'box' is not supported yet"));
  EXPECT_TRUE(contains(diatom_error("diatom\npackage 'a'\nmaterial 0\n"),
                       "line 3: found material '0', expected an integer from 1"));
  EXPECT_TRUE(
      contains(diatom_error("diatom\npackage 'a'\n" + sphere("0 0 0", "1") + "endpackage\nenddiatom\n"),
               "line 2: the package has no material"));
  EXPECT_TRUE(contains(diatom_error("diatom\npackage 'a'\nmaterial 1\ninsert sphere\nradius 1\n"),
                       "line 4: 'insert' is not closed, expected 'endinsert'"));
  EXPECT_TRUE(contains(diatom_error("diatom\npackage 'a'\nmaterial 1\n"), "line 2: 'package' is not closed"));
  EXPECT_TRUE(contains(diatom_error("\ndiatom\n"), "line 2: 'diatom' is not closed, expected 'enddiatom'"));
  EXPECT_TRUE(contains(diatom_error("hello\n"), "line 1: found 'hello', expected 'diatom'"));
  EXPECT_TRUE(contains(diatom_error("diatom\nenddiatom\n"), "holds no shape"));
  EXPECT_TRUE(contains(diatom_error("diatom\npackage 'a\n"), "line 2: expected a closing '"));
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
