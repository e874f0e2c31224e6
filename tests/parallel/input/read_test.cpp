// All ranks read together what one rank alone reads, and fail with one message whichever rank sees the
// mistake.
#include <fmt/core.h>

#include "../../unit/input/input_fixture.hpp"
#include "support/surfaces.hpp"

namespace sculpt {
namespace {

using test::operator+;

// Boxes of very different kinds: slabs with one cell of overlap, everything for rank 1, nothing for rank 2.
std::vector<IndexBox> mixed_boxes(const Comm& comm, const Index3& cells) {
  std::vector<IndexBox> boxes;
  for (int r = 0; r < comm.size(); ++r) {
    IndexBox box = whole(cells);
    box.lo[0] = cells[0] * r / comm.size();
    box.hi[0] = std::min(cells[0], cells[0] * (r + 1) / comm.size() + 1);
    box.lo[2] = r % 2;
    if (r == 1) box = whole(cells);
    if (r == 2) box = {};
    boxes.push_back(box);
  }
  return boxes;
}

void expect_same(const Fractions& a, const Fractions& b) {
  EXPECT_EQ(a.offset, b.offset);
  EXPECT_EQ(a.material, b.material);
  EXPECT_EQ(a.value, b.value);
}

// Boxes across two cells each: what this rank's part says of them and what the whole says.
void expect_same_fields(const Deck& deck, const MaterialSource& together, const Fractions& mine,
                        const IndexBox& box) {
  const auto alone = open_source(Comm::self(), deck, Log());
  const Grid& grid = alone->grid();
  const std::vector<IndexBox> all(1, whole(grid.cells));
  const auto expected = alone->field(alone->read(Comm::self(), all).fractions, all[0]);
  const auto field = together.field(mine, box);
  Fractions measured, of_the_whole;
  for (std::int64_t p = 0; p < box.size(); ++p) {
    const Index3 cell = box.cell(p);
    if (cell[0] + 1 == box.hi[0]) continue;
    Box two;
    for (std::size_t d = 0; d < 3; ++d) {
      two.lo[d] = grid.planes[d][static_cast<std::size_t>(cell[d])];
      two.hi[d] = grid.planes[d][static_cast<std::size_t>(cell[d]) + (d == 0 ? 2 : 1)];
    }
    two.lo.x += 0.3 * (two.hi.x - two.lo.x);
    field->measure(two, measured);
    expected->measure(two, of_the_whole);
    EXPECT_EQ(field->sole_material(two), expected->sole_material(two));
  }
  expect_same(measured, of_the_whole);
}

void expect_same_alone_and_together(const Deck& deck) {
  const Comm comm = Comm::world();
  const auto together = open_source(comm, deck, Log());
  const auto boxes = mixed_boxes(comm, together->grid().cells);
  const MaterialData mine = together->read(comm, boxes);
  const auto alone = open_source(Comm::self(), deck, Log());
  EXPECT_EQ(alone->grid().planes, together->grid().planes);
  const MaterialData expected =
      alone->read(Comm::self(), std::span(boxes).subspan(static_cast<std::size_t>(comm.rank()), 1));
  EXPECT_EQ(mine.table.block_id, expected.table.block_id);
  EXPECT_EQ(mine.table.void_material, expected.table.void_material);
  expect_same(mine.fractions, expected.fractions);
  expect_same_fields(deck, *together, mine.fractions, boxes[static_cast<std::size_t>(comm.rank())]);
}

// Ids of 1 to 10 digits, separated by blanks of many kinds: numbers lie across the borders of the pieces.
std::string scattered_ids(int count) {
  std::string text;
  std::int64_t id = 1;
  for (int n = 0; n < count; ++n) {
    id = (id * 48271) % 2147483647;
    text += std::to_string(n % 3 == 0 ? id : id % 10);
    text += n % 7 == 0 ? "\r\n" : n % 5 == 0 ? "    " : " ";
  }
  return text;
}

std::string tec_file(const Index3& cells) {
  std::string text =
      fmt::format("VARIABLES = x y z a b c\nZONE I={} J={} K={}\n", cells[0], cells[1], cells[2]);
  for (std::int64_t n = 0; n < cells[0] * cells[1] * cells[2]; ++n) {
    const Index3 c = whole(cells).cell(n);
    const double f = 0.1 * static_cast<double>(n % 10);
    text += fmt::format("{}.5 {}.5 {}.5\n{:.1f} 0 {:.1f}\n", c[0], c[1], c[2], f, 1 - f);
  }
  return text;
}

TEST(ReadTogether, SpnInAllOrders) {
  const TemporaryFile file(Comm::world(), scattered_ids(5 * 4 * 7));
  for (int order = 0; order < 6; ++order)
    expect_same_alone_and_together(spn_deck(file.path(), {5, 4, 7}, order));
}

TEST(ReadTogether, SpnWithFewerNumbersThanRanks) {
  const TemporaryFile file(Comm::world(), "2147483647 1");
  expect_same_alone_and_together(spn_deck(file.path(), {1, 1, 2}));
}

TEST(ReadTogether, SpnInSeveralRounds) {
  // Blanks make the file larger than what all ranks take in one round (8 MB each); one number lies across the
  // border of the first two pieces, one across that of the rounds.
  const Comm comm = Comm::world();
  const std::size_t piece = std::size_t{8} << 20, round = piece * static_cast<std::size_t>(comm.size());
  std::string text(round + 1000, ' '), numbers;
  const auto put = [&](std::size_t at, std::string_view number) {
    std::copy(number.begin(), number.end(), text.begin() + static_cast<std::ptrdiff_t>(at));
    numbers.append(number).append(" ");
  };
  put(5, "7");
  if (comm.size() > 1) put(piece - 1, "678");
  put(round - 2, "12345");
  put(round + 700, "99");
  const TemporaryFile file(comm, text), small(comm, numbers);
  const Index3 cells{comm.size() == 1 ? 3 : 4, 1, 1};
  expect_same_alone_and_together(spn_deck(file.path(), cells));
  const MaterialData large = read_box(comm, spn_deck(file.path(), cells));
  EXPECT_EQ(block_ids(large), block_ids(read_box(comm, spn_deck(small.path(), cells))));
}

TEST(ReadTogether, MicroWithRowsAcrossPieces) {
  const TemporaryFile file(Comm::world(), tec_file({5, 4, 3}));
  Deck deck;
  deck.input_micro = file.path();
  expect_same_alone_and_together(deck);
  deck.xmin = 1;
  deck.zmax = 2;
  deck.given_options.add("xmin", "test");
  deck.given_options.add("zmax", "test");
  expect_same_alone_and_together(deck);
  const TemporaryFile tiny(Comm::world(), tec_file({1, 1, 1}));
  deck = Deck();
  deck.input_micro = tiny.path();
  expect_same_alone_and_together(deck);
}

TEST(ReadTogether, Diatom) {
  const TemporaryFile file(
      Comm::world(),
      "diatom\npackage 'a'\nmaterial 2\ninsert sphere\ncenter 0 0.1 0\nradius 0.7\nendi\nendp\n"
      "package 'b'\nmaterial 1\ninsert sphere\ncenter 0.3 0 0\nradius 0.8\nendi\nendp\nenddia\n");
  expect_same_alone_and_together(diatom_deck(file.path(), 9, 1));
}

// The error of all ranks together; checks that they agree and that one rank alone says the same.
std::string agreed_error(const Deck& deck) {
  const Comm comm = Comm::world();
  const std::string mine = error_of([&] { (void)read_box(comm, deck); });
  EXPECT_EQ(comm.broadcast(mine, 0), mine);
  EXPECT_EQ(error_of([&] { (void)read_box(Comm::self(), deck); }), mine);
  return mine;
}

TEST(FailTogether, SpnWhoseLastNumberIsBad) {
  const Comm comm = Comm::world();
  const TemporaryFile letter(comm, scattered_ids(139) + "x");
  EXPECT_TRUE(
      contains(agreed_error(spn_deck(letter.path(), {5, 4, 7})), "line 21: found 'x', expected an integer"));
  const TemporaryFile few(comm, scattered_ids(139));
  EXPECT_TRUE(contains(agreed_error(spn_deck(few.path(), {5, 4, 7})), "found 139 integers, expected"));
  const TemporaryFile many(comm, scattered_ids(1000));
  EXPECT_TRUE(contains(agreed_error(spn_deck(many.path(), {5, 4, 7})), "found 1000 integers, expected"));
}

TEST(FailTogether, SpnNamesTheFirstOfTwoMistakes) {
  const TemporaryFile file(Comm::world(), "1 2 3\n4 -5 6 7 8 9 10 11 12 13 14 15\n16 17 18 19 20 21 22 b\n");
  EXPECT_TRUE(contains(agreed_error(spn_deck(file.path(), {1, 1, 23})), "line 2: found '-5'"));
}

TEST(FailTogether, FilesThatCannotBeRead) {
  EXPECT_TRUE(contains(agreed_error(spn_deck("/no/such.spn", {1, 1, 1})), "cannot open '/no/such.spn'"));
  const TemporaryFile empty(Comm::world(), "");
  EXPECT_TRUE(contains(agreed_error(spn_deck(empty.path(), {1, 1, 1})), "is empty"));
  EXPECT_TRUE(contains(agreed_error(diatom_deck(empty.path(), 2, 1)), "is empty"));
}

TEST(FailTogether, MicroWhoseLastRowIsBad) {
  const Comm comm = Comm::world();
  std::string text = tec_file({5, 4, 3});
  const std::size_t last = text.rfind("0.9");
  const auto error_with = [&](const std::string& numbers) {
    const TemporaryFile file(comm, text.substr(0, last) + numbers);
    Deck deck;
    deck.input_micro = file.path();
    return agreed_error(deck);
  };
  EXPECT_EQ(error_with("0.9 0 0.1\n"), "");
  EXPECT_TRUE(
      contains(error_with("0.9 0 0.3\n"), "line 121: the volume fractions add up to 1.2, expected 1"));
  EXPECT_TRUE(contains(error_with("0.9 0 ?\n"), "line 122: found '?', expected a number"));
  EXPECT_TRUE(contains(error_with("0.9 0\n"),
                       "found 359 numbers (59 rows of 6), expected I x J x K = 5 x 4 x 3 = 60"));
}

TEST(FailTogether, MicroWithACellTwice) {
  std::string text = tec_file({5, 4, 3});
  text[text.find("3.5 3.5 1.5")] = '2';
  const TemporaryFile file(Comm::world(), text);
  Deck deck;
  deck.input_micro = file.path();
  EXPECT_TRUE(contains(agreed_error(deck), "two rows for the cell (2, 3, 1), counted from 0, expected one"));
}

// A surface with holes and facets that look inwards, and one that goes through itself.
TEST(ReadTogether, Stl) {
  test::Facets bad = test::ball_facets(24, [](const Vec3& w) { return 0.8 + 0.15 * w.x * w.y; });
  for (std::size_t f = 0; f < bad.size(); f += 5) std::swap(bad[f][0], bad[f][1]);
  bad.erase(bad.begin() + 100, bad.begin() + 106);
  const test::Facets ball = test::ball_facets(20, [](const Vec3&) { return 0.6; });
  const TemporaryFile first(Comm::world(), test::binary_stl(bad)),
      second(Comm::world(), test::ascii_stl(ball + test::moved(ball, {0.35, 0.2, 0.1})));
  Deck deck = diatom_deck("", 9, 1.1);
  deck.stl_file = first.path();
  expect_same_alone_and_together(deck);
  const TemporaryFile both(
      Comm::world(), fmt::format("diatom\npackage 'a'\nmaterial 2\ninsert stl\nfile = '{}'\nendi\nendp\n"
                                 "package 'b'\nmaterial 1\ninsert stl\nfile = '{}'\nendi\nendp\nendd\n",
                                 second.path(), first.path()));
  expect_same_alone_and_together(diatom_deck(both.path(), 9, 1.1));
}

TEST(FailTogether, StlThatIsCutOff) {
  const std::string text = test::binary_stl(test::box_facets({0, 0, 0}, {1, 1, 1}));
  const TemporaryFile file(Comm::world(), text.substr(0, 400)), empty(Comm::world(), "solid\nendsolid\n");
  Deck deck = diatom_deck("", 3, 1.1);
  deck.stl_file = file.path();
  EXPECT_TRUE(contains(agreed_error(deck), "found 400 bytes; a binary STL file of 12 facets"));
  deck.stl_file = empty.path();
  EXPECT_TRUE(contains(agreed_error(deck), "has no facets"));
}

TEST(FailTogether, DiatomWithAMistake) {
  const TemporaryFile file(Comm::world(), "diatom\npackage 'a'\nmaterial 2\ninsert cube\n");
  EXPECT_TRUE(contains(agreed_error(diatom_deck(file.path(), 2, 1)),
                       "line 4: found shape 'cube', expected 'sphere'"));
}

}  // namespace
}  // namespace sculpt
