#include "sculpt/vfrac/fractions.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "support/cases.hpp"

namespace sculpt {
namespace {

using Entries = std::vector<std::pair<std::int32_t, double>>;

Fractions cells(const std::vector<Entries>& list) {
  Fractions f;
  for (const Entries& entries : list) {
    for (const auto& [m, v] : entries) f.add(m, v);
    f.end_cell();
  }
  return f;
}

Entries entries(const Fractions& f, std::size_t cell) {
  Entries e;
  for (auto i = static_cast<std::size_t>(f.offset[cell]); i < static_cast<std::size_t>(f.offset[cell + 1]);
       ++i)
    e.emplace_back(f.material[i], f.value[i]);
  return e;
}

TEST(FractionOf, IsZeroForWhatIsNotListed) {
  const Fractions f = cells({{{1, 0.25}, {4, 0.75}}, {{0, 1}}});
  EXPECT_EQ(fraction_of(f, 0, 4), 0.75);
  EXPECT_EQ(fraction_of(f, 0, 1), 0.25);
  EXPECT_EQ(fraction_of(f, 0, 0), 0);
  EXPECT_EQ(fraction_of(f, 1, 0), 1);
  EXPECT_EQ(fraction_of(f, 1, 4), 0);
}

TEST(SourceOf, ClampsTheGrownBoxToTheData) {
  const Index3 source{5, 5, 5};
  EXPECT_EQ(source_of(whole({9, 9, 9}), 2, source), whole(source));
  EXPECT_EQ(source_of({{0, 0, 0}, {1, 1, 1}}, 2, source), (IndexBox{{0, 0, 0}, {1, 1, 1}}));
  EXPECT_EQ(source_of({{0, 0, 0}, {2, 4, 9}}, 2, source), (IndexBox{{0, 0, 0}, {1, 2, 5}}));
  EXPECT_EQ(source_of({{7, 3, 8}, {9, 5, 9}}, 2, source), (IndexBox{{4, 1, 4}, {5, 3, 5}}));
  EXPECT_TRUE(source_of({}, 2, source).empty());
  const IndexBox inside{{1, 2, 3}, {4, 5, 5}};
  EXPECT_EQ(source_of(inside, 0, source), inside);
}

TEST(ExpandFractions, RepeatsTheOutermostCells) {
  // One row of two cells, one layer around it: 4 x 3 x 3 cells, left half like the first.
  const Fractions data = cells({{{0, 0.5}, {2, 0.5}}, {{1, 1}}});
  const Index3 source{2, 1, 1};
  const Fractions grown = expand_fractions(data, whole(source), whole({4, 3, 3}), 1, source);
  ASSERT_EQ(grown.cells(), 36);
  for (std::size_t c = 0; c < 36; ++c)
    EXPECT_EQ(entries(grown, c), c % 4 < 2 ? (Entries{{0, 0.5}, {2, 0.5}}) : (Entries{{1, 1}}))
        << "cell " << c;
}

TEST(ExpandFractions, OfAPartEqualsThePartOfTheWhole) {
  const test::Case input = test::two_phase_fractions({6, 5, 4}, 3);
  const Index3 source = input.grid.cells;
  const std::int64_t layers = 3;
  const IndexBox grown = whole({12, 11, 10});
  const Fractions all =
      expand_fractions(test::fractions_in(input, whole(source)), whole(source), grown, layers, source);
  for (const IndexBox box :
       {IndexBox{{0, 0, 0}, {5, 11, 2}}, IndexBox{{8, 4, 4}, {12, 6, 10}}, IndexBox{{4, 4, 4}, {5, 5, 5}}}) {
    const IndexBox from = source_of(box, layers, source);
    const Fractions part = expand_fractions(test::fractions_in(input, from), from, box, layers, source);
    ASSERT_EQ(part.cells(), box.size());
    for (std::int64_t p = 0; p < box.size(); ++p)
      EXPECT_EQ(entries(part, static_cast<std::size_t>(p)),
                entries(all, static_cast<std::size_t>(grown.position(box.cell(p)))));
  }
}

TEST(FollowAssignment, LeavesAgreementAlone) {
  Fractions f = cells({{{1, 0.3}, {4, 0.7}}, {{0, 1}}, {{0, 0.5}, {1, 0.5}}, {{0, 0.5}, {1, 0.5}}});
  const Fractions before = f;
  follow_assignment(f, std::vector<std::int32_t>{4, 0, 0, 1});
  EXPECT_EQ(f.material, before.material);
  EXPECT_EQ(f.value, before.value);
  EXPECT_EQ(f.offset, before.offset);
}

TEST(FollowAssignment, ExchangesTheFormerAndTheNewMaterial) {
  Fractions f = cells({{{1, 0.3}, {4, 0.6}, {6, 0.1}}});
  follow_assignment(f, std::vector<std::int32_t>{1});
  EXPECT_EQ(entries(f, 0), (Entries{{1, 0.6}, {4, 0.3}, {6, 0.1}}));
}

TEST(FollowAssignment, GivesAnAbsentMaterialThePlaceOfTheFormer) {
  for (const auto& [to, expected] : std::vector<std::pair<std::int32_t, Entries>>{
           {0, {{0, 0.7}, {1, 0.3}}}, {3, {{1, 0.3}, {3, 0.7}}}, {9, {{1, 0.3}, {9, 0.7}}}}) {
    Fractions f = cells({{{2, 1}}, {{1, 0.3}, {4, 0.7}}, {{5, 1}}});
    follow_assignment(f, std::vector<std::int32_t>{2, to, 5});
    EXPECT_EQ(entries(f, 0), (Entries{{2, 1}}));
    EXPECT_EQ(entries(f, 1), expected) << "to " << to;
    EXPECT_EQ(entries(f, 2), (Entries{{5, 1}}));
  }
  Fractions pure = cells({{{2, 1}}});
  follow_assignment(pure, std::vector<std::int32_t>{0});
  EXPECT_EQ(entries(pure, 0), (Entries{{0, 1}}));
}

TEST(FollowAssignment, MakesTheAssignedMaterialDominantAndKeepsTheSum) {
  Fractions f;
  std::vector<std::int32_t> material;
  for (std::uint64_t c = 0; c < 500; ++c) {
    const auto count = static_cast<std::int32_t>(1 + test::scatter(1, c) % 4);
    std::vector<double> value;
    for (std::int32_t m = 0; m < count; ++m)
      value.push_back(0.05 + test::scatter_unit(2, 4 * c + static_cast<std::uint64_t>(m)));
    const double sum = std::accumulate(value.begin(), value.end(), 0.0);
    for (std::int32_t m = 0; m < count; ++m) f.add(2 * m, value[static_cast<std::size_t>(m)] / sum);
    f.end_cell();
    material.push_back(static_cast<std::int32_t>(test::scatter(3, c) % 8));
  }
  follow_assignment(f, material);
  for (std::size_t c = 0; c < material.size(); ++c) {
    const Entries e = entries(f, c);
    EXPECT_TRUE(std::is_sorted(e.begin(), e.end()));
    double sum = 0;
    for (const auto& [m, v] : e) {
      sum += v;
      EXPECT_LE(v, fraction_of(f, static_cast<LocalId>(c), material[c]));
    }
    EXPECT_NEAR(sum, 1, 1e-14);
  }
}

}  // namespace
}  // namespace sculpt
