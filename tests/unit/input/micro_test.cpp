#include "input_fixture.hpp"

namespace sculpt {
namespace {

const char* const kHeader =
    "TITLE = \"two by two\"\nVARIABLES = \"x\" \"y\" \"z\" \"a\" \"b\"\nZONE I=2, J=2, K=2, F=POINT\n";

// Eight rows; cell number n (x fastest) holds n/10 of material 1.
std::string rows(const std::string& separator = " ", const std::string& end = "\n") {
  std::string text;
  for (int n = 0; n < 8; ++n)
    text += std::to_string(n % 2) + separator + std::to_string(n / 2 % 2) + separator +
            std::to_string(n / 4) + separator + "0." + std::to_string(n) + separator +
            (n == 0 ? "1.0" : "0." + std::to_string(10 - n)) + end;
  return text;
}

Deck micro_deck(const std::string& path) {
  Deck deck;
  deck.input_micro = path;
  return deck;
}

std::string micro_error(const std::string& text) {
  const TemporaryFile file(text);
  return error_of([&] { (void)read_box(Comm::self(), micro_deck(file.path())); });
}

void expect_eight_cells(const std::string& text) {
  const TemporaryFile file(text);
  MaterialData data;
  ASSERT_EQ(error_of([&] { data = read_box(Comm::self(), micro_deck(file.path())); }), "");
  ASSERT_EQ(data.fractions.cells(), 8);
  for (int n = 0; n < 8; ++n) EXPECT_NEAR(fraction_of(data.fractions, n, 0), 0.1 * n, 1e-15) << n;
  expect_valid(data);
}

TEST(Micro, ReadsRowsOnUnitCellsAroundTheCentroids) {
  const TemporaryFile file(kHeader + rows());
  const auto source = open_source(Comm::self(), micro_deck(file.path()), Log());
  EXPECT_EQ(source->grid().cells, (Index3{2, 2, 2}));
  EXPECT_EQ(source->grid().planes[0], (std::vector<double>{-0.5, 0.5, 1.5}));
  const MaterialData data = source->read(Comm::self(), std::vector<IndexBox>(1, whole({2, 2, 2})));
  EXPECT_EQ(data.table.block_id, (std::vector<std::int64_t>{1, 2}));
  EXPECT_FALSE(data.table.void_material);
  EXPECT_EQ(data.fractions.offset[1], 1) << "an absent material takes no entry";
  EXPECT_EQ(data.fractions.value[0], 1.0);
  expect_eight_cells(kHeader + rows());
}

TEST(Micro, UnderstandsTheUsualSpellingsOfTheHeader) {
  expect_eight_cells("variables=x,y,z,a,b\nzone k=2 j=2 i=2\n" + rows());
  expect_eight_cells(
      "# comment\r\nTITLE=\"t\"\r\nVARIABLES = \"x\"\r\n\"y\"\r\n\"z\", \"a 1\"\r\n\"b\"\r\n"
      "ZONE T=\"zone 1\"\r\n I = 2 , J = 2\r\nK=2, DATAPACKING=POINT, DT=(SINGLE SINGLE)\r\n" +
      rows(" ", "\r\n"));
  expect_eight_cells(
      "VARIABLES = \"X\" \"Y\" \"Z\" \"A\" \"B\" ZONE AUXDATA n=\"v\" I=2 J=2 K=2 ZONETYPE=ORDERED\n" +
      rows());
}

TEST(Micro, RowsMayWrapAndNumbersMayBeFortran) {
  expect_eight_cells(kHeader + rows("\n", "\n"));
  expect_eight_cells(kHeader + rows(" ", " "));
  std::string text = rows();
  text.replace(text.find("0.7"), 3, "+7.D-1");
  expect_eight_cells(kHeader + text);
}

TEST(Micro, PlacesRowsByTheirCentroids) {
  std::string reversed;
  const std::string text = rows();
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at) + 1;
    reversed.insert(0, text.substr(at, end - at));
    at = end;
  }
  expect_eight_cells(kHeader + reversed);
}

TEST(Micro, ClipsToTheCellsWhoseCentresAreInside) {
  const TemporaryFile file(kHeader + rows());
  Deck deck = micro_deck(file.path());
  deck.xmin = 0.2;
  deck.zmax = 0.9;
  deck.ymin = 0.5;  // not given
  deck.given_options.add("xmin", "test");
  deck.given_options.add("zmax", "test");
  const auto source = open_source(Comm::self(), deck, Log());
  EXPECT_EQ(source->grid().cells, (Index3{1, 2, 1}));
  EXPECT_EQ(source->grid().planes[0], (std::vector<double>{0.5, 1.5}));
  const MaterialData data = source->read(Comm::self(), std::vector<IndexBox>(1, whole({1, 2, 1})));
  EXPECT_NEAR(fraction_of(data.fractions, 0, 0), 0.1, 1e-15);
  EXPECT_NEAR(fraction_of(data.fractions, 1, 0), 0.3, 1e-15);
  deck.xmin = 1.2;
  EXPECT_TRUE(contains(error_of([&] { (void)open_source(Comm::self(), deck, Log()); }),
                       "no cell is left: xmin = 1.2"));
}

TEST(Micro, RenormalisesRoundedFractions) {
  const TemporaryFile file("VARIABLES = x y z a b c\nZONE I=1 J=1 K=1\n7 8 9 0.3333 0.6663 -1e-9\n");
  const MaterialData data = read_box(Comm::self(), micro_deck(file.path()));
  EXPECT_EQ(data.table.block_id.size(), 3U) << "materials without cells stay";
  EXPECT_EQ(data.fractions.material, (std::vector<std::int32_t>{0, 1}));
  EXPECT_DOUBLE_EQ(data.fractions.value[0], 0.3333 / 0.9996);
  expect_valid(data);
}

TEST(Micro, RefusesFractionsThatAreNone) {
  const auto with = [](const std::string& numbers) {
    return micro_error("VARIABLES = x y z a b\nZONE I=1 J=1 K=2\n0 0 0 1 0\n0 0 1 " + numbers + "\n");
  };
  EXPECT_EQ(with("0.5 0.5"), "");
  EXPECT_TRUE(contains(with("0.5 0.4"), "line 4: the volume fractions add up to 0.9, expected 1"));
  EXPECT_TRUE(
      contains(with("-0.5 1.5"), "line 4: the volume fraction of material 1 is -0.5, expected 0 to 1"));
  EXPECT_TRUE(contains(with("0 nan"), "line 4: the volume fraction of material 2 is nan"));
  EXPECT_TRUE(contains(with("inf 0"), "line 4: the volume fraction of material 1 is inf"));
  EXPECT_TRUE(contains(with("0.5 half"), "line 4: found 'half', expected a number"));
}

TEST(Micro, RefusesRowsBesideTheGrid) {
  const auto with = [](const std::string& row) {
    return micro_error("VARIABLES = x y z a\nZONE I=1 J=1 K=3\n0 0 0 1\n" + row + "\n0 0 2 1\n");
  };
  EXPECT_EQ(with("0 0 1 1"), "");
  EXPECT_TRUE(
      contains(with("0 0 1.3 1"), "line 4: the centroid (0, 0, 1.3) is none of the 1 x 1 x 3 unit cells"));
  EXPECT_TRUE(contains(with("0 1 1 1"), "line 4: the centroid (0, 1, 1)"));
  EXPECT_TRUE(contains(with("0 0 nan 1"), "line 4: the centroid (0, 0, nan)"));
  EXPECT_TRUE(contains(with("0 0 2 1"), "no row for the cell (0, 0, 1)") ||
              contains(with("0 0 2 1"), "two rows for the cell (0, 0, 2)"));
}

TEST(Micro, CountsTheRows) {
  std::string text = rows();
  text.resize(text.rfind("1 1 1"));
  EXPECT_TRUE(contains(micro_error(kHeader + text),
                       "found 35 numbers (7 rows of 5), expected I x J x K = 2 x 2 x 2 = 8 rows"));
  EXPECT_TRUE(contains(micro_error(kHeader + rows() + "1"), "found 41 numbers"));
  EXPECT_TRUE(
      contains(micro_error("VARIABLES = x y z a\nZONE I=900000 J=900000 K=9\n0 0 0 1\n"), "found 4 numbers"));
}

TEST(Micro, RefusesBrokenHeaders) {
  EXPECT_TRUE(contains(micro_error("0 0 0 1\n"), "line 1: found a number, expected the TITLE"));
  EXPECT_TRUE(contains(micro_error("TITLE = \"x\n"), "expected a closing"));
  EXPECT_TRUE(contains(micro_error("VARIABLES = x y z a\n"), "the header ends without a ZONE"));
  EXPECT_TRUE(
      contains(micro_error("VARIABLES = x y z\nZONE I=1 J=1 K=1\n0 0 0"), "line 3: found 3 variables"));
  EXPECT_TRUE(contains(micro_error("VARIABLES = x y z a\nZONE I=1 J=1\n0 0 0 1"), "the ZONE gives no K"));
  EXPECT_TRUE(contains(micro_error("VARIABLES = x y z a\nZONE I=0 J=1 K=1\n0 0 0 1"), "line 2: found I = 0"));
  EXPECT_TRUE(
      contains(micro_error("VARIABLES = x y z a\nZONE I=1 J=1 K=1 F=BLOCK\n0 0 0 1"), "expected POINT"));
  EXPECT_TRUE(contains(micro_error("VARIABLES = x y z a\nZONE I=1 J=1 K=1\n"), "expected rows of numbers"));
}

}  // namespace
}  // namespace sculpt
