#include "input/data_field.hpp"

#include <map>
#include <random>

#include "input_fixture.hpp"
#include "sculpt/base/error.hpp"

namespace sculpt {
namespace {

using Random = std::mt19937_64;

double uniform(Random& random, double lo, double hi) {
  return std::uniform_real_distribution<double>(lo, hi)(random);
}

// 7 x 5 x 6 cells of different widths.
Grid stretched_grid() {
  Grid grid;
  grid.cells = {7, 5, 6};
  Random random(11);
  for (std::size_t d = 0; d < 3; ++d) {
    double at = -1;
    for (std::int64_t i = 0; i <= grid.cells[d]; ++i) {
      grid.planes[d].push_back(at);
      at += uniform(random, 0.3, 2.0);
    }
  }
  return grid;
}
Grid equal_grid() { return uniform_grid({7, 5, 6}, {-0.3, 2.1, 0.7}, {0.1, 0.3, 0.7}); }

// Blocks of cells of four materials; every third cell is mixed unless all are to be pure.
Fractions some_fractions(const IndexBox& box, bool pure) {
  Fractions f;
  for (std::int64_t p = 0; p < box.size(); ++p) {
    const Index3 c = box.cell(p);
    const auto m = static_cast<std::int32_t>((c[0] / 3 + c[1] / 2 + c[2] / 2) % 3);
    if (pure || (c[0] + c[1] * c[2]) % 3 != 0) {
      f.add(m, 1.0);
    } else {
      const double share = (1.0 + static_cast<double>((c[0] * 7 + c[1] * 5 + c[2]) % 11)) / 13;
      f.add(m, share);
      f.add(m + 1, 1 - share);
    }
    f.end_cell();
  }
  return f;
}

Fractions measured(MaterialField& field, const Box& box) {
  Fractions f;
  field.measure(box, f);
  EXPECT_EQ(f.cells(), 1);
  return f;
}

// Cells [from, to) of the grid as a box.
Box box_of(const Grid& grid, const Index3& from, const Index3& to) {
  Box box;
  for (std::size_t d = 0; d < 3; ++d) {
    box.lo[d] = grid.planes[d][static_cast<std::size_t>(from[d])];
    box.hi[d] = grid.planes[d][static_cast<std::size_t>(to[d])];
  }
  return box;
}

void expect_same(const Fractions& a, const Fractions& b) {
  EXPECT_EQ(a.offset, b.offset);
  EXPECT_EQ(a.material, b.material);
  EXPECT_EQ(a.value, b.value);
}

// The average by going through all cells.
std::map<std::int32_t, double> average(const Grid& grid, const Fractions& f, const Box& box) {
  std::map<std::int32_t, double> sum;
  double volume = 0;
  const IndexBox all = whole(grid.cells);
  for (std::int64_t p = 0; p < all.size(); ++p) {
    const Index3 c = all.cell(p);
    const Box cell = box_of(grid, c, {c[0] + 1, c[1] + 1, c[2] + 1});
    double overlap = 1;
    for (std::size_t d = 0; d < 3; ++d) {
      const double lo = c[d] == 0 ? -1e9 : cell.lo[d], hi = c[d] + 1 == grid.cells[d] ? 1e9 : cell.hi[d];
      overlap *= std::max(0.0, std::min(hi, box.hi[d]) - std::max(lo, box.lo[d]));
    }
    volume += overlap;
    for (auto e = static_cast<std::size_t>(f.offset[static_cast<std::size_t>(p)]);
         e < static_cast<std::size_t>(f.offset[static_cast<std::size_t>(p) + 1]); ++e)
      sum[f.material[e]] += overlap * f.value[e];
  }
  for (auto& [material, share] : sum) share /= volume;
  return sum;
}

Box random_box(Random& random, const Grid& grid, double beyond) {
  Box box;
  for (std::size_t d = 0; d < 3; ++d) {
    const double lo = grid.planes[d].front() - beyond, hi = grid.planes[d].back() + beyond;
    const double a = uniform(random, lo, hi), b = uniform(random, lo, hi);
    box.lo[d] = std::min(a, b);
    box.hi[d] = std::max(a, b);
  }
  return box;
}

// The four kinds of data: pure or mixed, on equal or on stretched cells.
class DataFieldOf : public testing::TestWithParam<std::tuple<bool, bool>> {
 protected:
  const bool pure_ = std::get<0>(GetParam());
  const Grid grid_ = std::get<1>(GetParam()) ? stretched_grid() : equal_grid();
  const IndexBox all_ = whole(grid_.cells);
  const Fractions fractions_ = some_fractions(all_, pure_);
  const std::unique_ptr<MaterialField> field_ = data_field(grid_, all_, fractions_);
};

TEST_P(DataFieldOf, GivesCellsAndPartsOfCellsWhatWasRead) {
  Random random(1);
  Fractions cells;
  for (std::int64_t p = 0; p < all_.size(); ++p) {
    const Index3 c = all_.cell(p);
    const Box cell = box_of(grid_, c, {c[0] + 1, c[1] + 1, c[2] + 1});
    field_->measure(cell, cells);
    Box part;
    for (std::size_t d = 0; d < 3; ++d) {
      part.lo[d] = uniform(random, cell.lo[d], cell.hi[d]);
      part.hi[d] = uniform(random, part.lo[d], cell.hi[d]);
    }
    Fractions one;
    const auto at = static_cast<std::size_t>(p);
    for (auto e = static_cast<std::size_t>(fractions_.offset[at]);
         e < static_cast<std::size_t>(fractions_.offset[at + 1]); ++e)
      one.add(fractions_.material[e], fractions_.value[e]);
    one.end_cell();
    expect_same(measured(*field_, part), one);
  }
  expect_same(cells, fractions_);
}

TEST_P(DataFieldOf, AveragesByVolume) {
  Random random(2);
  for (int n = 0; n < 500; ++n) {
    const Box box = random_box(random, grid_, n % 2 == 0 ? 0 : 1.5);
    MaterialData data;
    data.fractions = measured(*field_, box);
    expect_valid(data);
    const auto expected = average(grid_, fractions_, box);
    for (std::int32_t m = 0; m < 4; ++m) {
      const double share = expected.contains(m) ? expected.at(m) : 0;
      EXPECT_NEAR(fraction_of(data.fractions, 0, m), share, 2e-6);  // slivers may be left out
    }
  }
}

TEST_P(DataFieldOf, NamesASoleMaterialOnlyWhereItIs) {
  Random random(3);
  int sole = 0;
  for (int n = 0; n < 2000; ++n) {
    Box box = random_box(random, grid_, 0.5);
    for (std::size_t d = 0; d < 3; ++d)
      box.hi[d] = box.lo[d] + uniform(random, 0, 2) * grid_.cell_size()[d] + 1e-3;
    const auto material = field_->sole_material(box);
    const Fractions f = measured(*field_, box);
    EXPECT_EQ(material.has_value(), f.material.size() == 1);
    if (!material) continue;
    ++sole;
    EXPECT_EQ(f.material, (std::vector<std::int32_t>{*material}));
    EXPECT_EQ(f.value, (std::vector<double>{1.0}));
  }
  EXPECT_GT(sole, 100);
}

// One rank may have pure cells only where another one has a mixed cell farther away.
TEST(DataField, PureCellsAddUpInOneWay) {
  const Grid grid = uniform_grid({12, 5, 4}, {0, 0, 0}, {0.1, 0.13, 0.07});
  const IndexBox all = whole(grid.cells), part{{0, 0, 0}, {8, 5, 4}};
  const auto fractions_of = [](const IndexBox& box) {
    Fractions f;
    for (std::int64_t p = 0; p < box.size(); ++p) {
      const Index3 c = box.cell(p);
      if (c == Index3{11, 2, 2}) {
        f.add(0, 0.25);
        f.add(1, 0.75);
      } else {
        f.add((c[0] / 3 + c[1]) % 2 == 0 ? 0 : 1, 1);
      }
      f.end_cell();
    }
    return f;
  };
  const auto mixed = data_field(grid, all, fractions_of(all)),
             pure = data_field(grid, part, fractions_of(part));
  Random random(9);
  for (int n = 0; n < 1000; ++n) {
    Box box;
    for (std::size_t d = 0; d < 3; ++d) {
      const double end = grid.planes[d][static_cast<std::size_t>(part.hi[d])];
      box.lo[d] = uniform(random, 0, end);
      box.hi[d] = uniform(random, box.lo[d], end);
    }
    expect_same(measured(*pure, box), measured(*mixed, box));
  }
}

TEST_P(DataFieldOf, DoesNotDependOnTheCellsThatWereRead) {
  const IndexBox part{{2, 1, 2}, {6, 4, 6}};
  Fractions of_part;
  for (std::int64_t p = 0; p < part.size(); ++p) {
    const auto at = static_cast<std::size_t>(all_.position(part.cell(p)));
    for (auto e = static_cast<std::size_t>(fractions_.offset[at]);
         e < static_cast<std::size_t>(fractions_.offset[at + 1]); ++e)
      of_part.add(fractions_.material[e], fractions_.value[e]);
    of_part.end_cell();
  }
  const auto field = data_field(grid_, part, std::move(of_part));
  const Box inner = box_of(grid_, part.lo, part.hi);
  Random random(4);
  for (int n = 0; n < 300; ++n) {
    Box box;
    for (std::size_t d = 0; d < 3; ++d) {
      box.lo[d] = uniform(random, inner.lo[d], inner.hi[d]);
      box.hi[d] = uniform(random, box.lo[d], inner.hi[d]);
    }
    expect_same(measured(*field, box), measured(*field_, box));
    EXPECT_EQ(field->sole_material(box), field_->sole_material(box));
  }
  Box outside = inner;
  outside.lo.x = 0.5 * (outside.lo.x + grid_.planes[0][1]);
  Fractions ignored;
  EXPECT_THROW(field->measure(outside, ignored), BrokenPromise);
  EXPECT_THROW((void)field->sole_material(outside), BrokenPromise);
}

INSTANTIATE_TEST_SUITE_P(Kinds, DataFieldOf, testing::Combine(testing::Bool(), testing::Bool()));

TEST(DataField, CountsPureVoxelsExactly) {
  const Grid grid = equal_grid();  // its planes are rounded
  const IndexBox all = whole(grid.cells);
  const Fractions f = some_fractions(all, true);
  const auto field = data_field(grid, all, f);
  const IndexBox block{{1, 0, 2}, {6, 4, 5}};
  const Fractions average = measured(*field, box_of(grid, block.lo, block.hi));
  std::map<std::int32_t, int> count;
  for (std::int64_t p = 0; p < block.size(); ++p)
    ++count[f.material[static_cast<std::size_t>(all.position(block.cell(p)))]];
  ASSERT_EQ(count.size(), 3U);
  for (const auto& [material, n] : count)
    EXPECT_EQ(fraction_of(average, 0, material), n / static_cast<double>(block.size()));
}

TEST(DataField, TakesPlanesWithinRoundingForTheSame) {
  const Grid grid = uniform_grid({2, 1, 1}, {}, {1, 1, 1});
  Fractions f;
  f.add(0, 1);
  f.end_cell();
  f.add(1, 1);
  f.end_cell();
  const auto field = data_field(grid, whole(grid.cells), f);
  EXPECT_EQ(field->sole_material({{0, 0, 0}, {1 + 1e-9, 1, 1}}), 0);
  EXPECT_EQ(field->sole_material({{1 - 1e-9, 0, 0}, {2, 1, 1}}), 1);
  EXPECT_EQ(fraction_of(measured(*field, {{-1e-9, 0, 0}, {2 + 1e-9, 1, 1}}), 0, 0), 0.5);
  EXPECT_FALSE(field->sole_material({{0, 0, 0}, {1.001, 1, 1}}));
}

TEST(DataField, ExtendsTheOutermostCells) {
  const Grid grid = uniform_grid({2, 1, 1}, {}, {1, 1, 1});
  Fractions f;
  f.add(0, 1);
  f.end_cell();
  f.add(1, 1);
  f.end_cell();
  const auto field = data_field(grid, whole(grid.cells), f);
  EXPECT_EQ(field->sole_material({{-5, -3, 2}, {-4, -2, 3}}), 0);
  EXPECT_EQ(field->sole_material({{2, 0, 0}, {3, 1, 1}}), 1);
  EXPECT_NEAR(fraction_of(measured(*field, {{-2, 0, 0}, {2, 1, 1}}), 0, 0), 0.75, 1e-15);
}

// By way of the sources, whose field outlives them.
TEST(DataField, ComesFromASource) {
  const TemporaryFile file("1 1 1 1 2 2 2 1");
  std::unique_ptr<MaterialField> field;
  {
    const auto source = open_source(Comm::self(), spn_deck(file.path(), {2, 2, 2}), Log());
    EXPECT_TRUE(source->is_data());
    const std::vector<IndexBox> wanted(1, whole({2, 2, 2}));
    field = source->field(source->read(Comm::self(), wanted).fractions, wanted[0]);
  }
  EXPECT_EQ(fraction_of(measured(*field, {{0, 0, 0}, {2, 2, 2}}), 0, 1), 0.375);
  EXPECT_EQ(field->sole_material({{0, 0, 0}, {1, 2, 2}}), 0);
  const TemporaryFile tec("VARIABLES = x y z a b\nZONE I=2 J=1 K=1\n0 0 0 0.25 0.75\n1 0 0 1 0\n");
  Deck deck;
  deck.input_micro = tec.path();
  const auto source = open_source(Comm::self(), deck, Log());
  EXPECT_TRUE(source->is_data());
  const std::vector<IndexBox> wanted(1, whole({2, 1, 1}));
  field = source->field(source->read(Comm::self(), wanted).fractions, wanted[0]);
  EXPECT_EQ(fraction_of(measured(*field, {{-0.5, -0.5, -0.5}, {1.5, 0.5, 0.5}}), 0, 0), 0.625);
}

}  // namespace
}  // namespace sculpt
