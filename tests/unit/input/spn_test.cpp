#include "input_fixture.hpp"

namespace sculpt {
namespace {

std::string numbers_up_to(int count) {
  std::string text;
  for (int n = 0; n < count; ++n) text += std::to_string(n) + (n % 5 == 4 ? "\n" : " ");
  return text;
}

std::string spn_error(const std::string& text, const Index3& cells) {
  const TemporaryFile file(text);
  return error_of([&] { (void)read_box(Comm::self(), spn_deck(file.path(), cells)); });
}

TEST(Spn, ReadsAllSixOrdersOfTheAxes) {
  const TemporaryFile file(numbers_up_to(24));
  const IndexBox box = whole({2, 3, 4});
  // The number of the file at the cells (0,1,2) and (1,0,3), by hand.
  const std::array<std::array<std::int64_t, 2>, 6> expected{
      {{6, 15}, {7, 21}, {10, 7}, {12, 7}, {13, 21}, {14, 19}}};
  for (int order = 0; order < 6; ++order) {
    const auto ids = block_ids(read_box(Comm::self(), spn_deck(file.path(), {2, 3, 4}, order)));
    ASSERT_EQ(ids.size(), 24U);
    EXPECT_EQ(ids.front(), 0);
    EXPECT_EQ(ids.back(), 23);
    const auto& [first, second] = expected[static_cast<std::size_t>(order)];
    EXPECT_EQ(ids[static_cast<std::size_t>(box.position({0, 1, 2}))], first) << "order " << order;
    EXPECT_EQ(ids[static_cast<std::size_t>(box.position({1, 0, 3}))], second) << "order " << order;
  }
}

TEST(Spn, OrderZyxIsTheOrderOfMemory) {
  const TemporaryFile file("5 6 7 8 9 10 11 12");
  EXPECT_EQ(block_ids(read_box(Comm::self(), spn_deck(file.path(), {2, 2, 2}, kSpnZyx))),
            (std::vector<std::int64_t>{5, 6, 7, 8, 9, 10, 11, 12}));
}

TEST(Spn, HasUnitCellsAtTheOrigin) {
  const TemporaryFile file(numbers_up_to(24));
  const auto source = open_source(Comm::self(), spn_deck(file.path(), {2, 3, 4}), Log());
  EXPECT_EQ(source->grid().cells, (Index3{2, 3, 4}));
  EXPECT_EQ(source->grid().planes[2], (std::vector<double>{0, 1, 2, 3, 4}));
}

TEST(Spn, LeavesOnlyTheWantedBox) {
  const TemporaryFile file(numbers_up_to(24));
  const IndexBox box{{1, 1, 1}, {2, 3, 3}};
  const MaterialData data = read_box(Comm::self(), spn_deck(file.path(), {2, 3, 4}), box);
  EXPECT_EQ(block_ids(data), (std::vector<std::int64_t>{17, 21, 18, 22}));
  EXPECT_EQ(data.table.block_id.size(), 24U);
  expect_valid(data);
  EXPECT_EQ(read_box(Comm::self(), spn_deck(file.path(), {2, 3, 4}), IndexBox{}).fractions.cells(), 0);
}

TEST(Spn, AcceptsAnyWhiteSpaceAndNoEndOfLine) {
  const TemporaryFile file("\r\n\t1\r\n2\t\v3\f  \r\n\r\n4");
  EXPECT_EQ(block_ids(read_box(Comm::self(), spn_deck(file.path(), {1, 2, 2}))),
            (std::vector<std::int64_t>{1, 3, 2, 4}));
}

TEST(Spn, KeepsArbitraryIdsAndZero) {
  const TemporaryFile file("2147483647 0 70000000 0007");
  const MaterialData data = read_box(Comm::self(), spn_deck(file.path(), {1, 1, 4}));
  EXPECT_EQ(data.table.block_id, (std::vector<std::int64_t>{0, 7, 70000000, 2147483647}));
  EXPECT_EQ(data.fractions.material, (std::vector<std::int32_t>{3, 0, 2, 1}));
  EXPECT_FALSE(data.table.void_material);
}

TEST(Spn, CompressesIdsOnRequest) {
  const TemporaryFile file("900 0 17 900");
  Deck deck = spn_deck(file.path(), {1, 1, 4});
  deck.compress_spn_ids = true;
  const MaterialData data = read_box(Comm::self(), deck);
  EXPECT_EQ(data.table.block_id, (std::vector<std::int64_t>{1, 2, 3}));
  EXPECT_EQ(block_ids(data), (std::vector<std::int64_t>{3, 1, 2, 3}));
}

TEST(Spn, VoidMatNamesTheVoidUnlessItIsMeshed) {
  const TemporaryFile file("4 9 4 9");
  Deck deck = spn_deck(file.path(), {1, 1, 4});
  deck.void_mat = 9;
  EXPECT_FALSE(read_box(Comm::self(), deck).table.void_material) << "not given";
  deck.given_options.add("void_mat", "test");
  EXPECT_EQ(read_box(Comm::self(), deck).table.void_material, 1);
  deck.mesh_void = true;
  EXPECT_FALSE(read_box(Comm::self(), deck).table.void_material);
  deck.mesh_void = false;
  deck.void_mat = 5;
  EXPECT_FALSE(read_box(Comm::self(), deck).table.void_material) << "no such cells";
}

TEST(Spn, CountsTheIntegers) {
  EXPECT_TRUE(contains(spn_error("1 2 3 4 5", {1, 2, 3}),
                       "found 5 integers, expected nelx x nely x nelz = 1 x 2 x 3 = 6"));
  EXPECT_TRUE(contains(spn_error("1 2 3 4 5 6 7\n8", {1, 2, 3}), "found 8 integers, expected"));
  EXPECT_TRUE(contains(spn_error("100000 200000", {1, 1, 3}), "found 2 integers, expected"));
  EXPECT_TRUE(contains(spn_error("1 2", {1000000, 1000000, 1000}), "found 2 integers, expected"));
  EXPECT_TRUE(contains(spn_error(" \n ", {1, 1, 1}), "found 0 integers, expected"));
}

TEST(Spn, NamesLineAndTextOfWhatIsNoId) {
  for (const char* bad : {"a", "-3", "2147483648", "99999999999999999999999", "1.5", "1e3", "7x", "+4"}) {
    const std::string error = spn_error(std::string("1 2\n3\n4 ") + bad + " 5\n6", {1, 1, 7});
    EXPECT_TRUE(
        contains(error, "line 3: found '" + std::string(bad) + "', expected an integer from 0 to 2147483647"))
        << error;
  }
}

TEST(Spn, RefusesFilesThatAreNoText) {
  const Deck missing = spn_deck("/no/such/file.spn", {1, 1, 1});
  EXPECT_TRUE(contains(error_of([&] { (void)open_source(Comm::self(), missing, Log()); }),
                       "input_spn: cannot open '/no/such/file.spn': No such file"));
  const Deck directory = spn_deck(std::filesystem::temp_directory_path().string(), {1, 1, 1});
  EXPECT_TRUE(
      contains(error_of([&] { (void)open_source(Comm::self(), directory, Log()); }), "is a directory"));
  EXPECT_TRUE(contains(spn_error("", {1, 1, 1}), "is empty"));
  EXPECT_TRUE(contains(spn_error("\x1f\x8b stuff", {1, 1, 1}), "is compressed (gzip); unpack it first"));
}

TEST(Spn, NeedsTheNumbersOfCells) {
  const TemporaryFile file("1");
  Deck deck = spn_deck(file.path(), {1, 1, 0});
  EXPECT_TRUE(
      contains(error_of([&] { (void)open_source(Comm::self(), deck, Log()); }), "input_spn needs nelz"));
  deck = spn_deck(file.path(), {std::int64_t{1} << 31, std::int64_t{1} << 31, 8});
  EXPECT_TRUE(contains(error_of([&] { (void)open_source(Comm::self(), deck, Log()); }), "more cells than"));
}

// Blanks push numbers into the second round of pieces (8 MB each), one of them right across the boundary.
TEST(Spn, ReadsLargeFilesInRounds) {
  const std::size_t round = std::size_t{8} << 20;
  std::string text(2 * round + 100, ' ');
  text.replace(10, 1, "1");
  text.replace(round - 2, 5, "23456");
  text.replace(round + 500, 1, "3");
  text.replace(2 * round - 1, 1, "4");
  text.replace(2 * round + 1, 1, "5");
  const TemporaryFile file(text);
  EXPECT_EQ(block_ids(read_box(Comm::self(), spn_deck(file.path(), {5, 1, 1}))),
            (std::vector<std::int64_t>{1, 23456, 3, 4, 5}));
}

TEST(OpenSource, WantsOneSource) {
  EXPECT_TRUE(
      contains(error_of([] { (void)open_source(Comm::self(), Deck(), Log()); }), "no source of materials"));
  Deck deck = spn_deck("a.spn", {1, 1, 1});
  deck.input_micro = "a.tec";
  EXPECT_TRUE(contains(error_of([&] { (void)open_source(Comm::self(), deck, Log()); }),
                       "both input_spn and input_micro are given"));
}

TEST(Spn, PrintsTheSummary) {
  const TemporaryFile file("4 9 4 9");
  const Deck deck = spn_deck(file.path(), {1, 2, 2});
  testing::internal::CaptureStdout();
  const auto source = open_source(Comm::self(), deck, Log(true));
  (void)source->read(Comm::self(), std::vector<IndexBox>(1, whole({1, 2, 2})));
  const std::string printed = testing::internal::GetCapturedStdout();
  EXPECT_TRUE(contains(printed, "Summary of imported Microstructures spn file grid parameters\n")) << printed;
  EXPECT_TRUE(contains(printed, file.path()));
  EXPECT_TRUE(contains(printed, "Expanded initial Cartesian grid by 0 layers\n"));
  EXPECT_TRUE(contains(printed, "Number of Materials  2\n"));
}

}  // namespace
}  // namespace sculpt
