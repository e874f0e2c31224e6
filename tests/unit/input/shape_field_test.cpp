#include <array>
#include <numeric>
#include <random>

#include "input/cell_meter.hpp"
#include "input/shape_fractions.hpp"
#include "input/shape_index.hpp"
#include "input_fixture.hpp"
#include "sculpt/geom/sphere.hpp"

namespace sculpt {
namespace {

using Random = std::mt19937_64;
using Shapes = std::vector<InsertedShape>;

double uniform(Random& random, double lo, double hi) {
  return std::uniform_real_distribution<double>(lo, hi)(random);
}
Vec3 point(Random& random, double lo, double hi) {
  return {uniform(random, lo, hi), uniform(random, lo, hi), uniform(random, lo, hi)};
}

// Balls of materials 0 to 2 in [0,100]^3, some beyond it; many overlap, the first one is large.
std::shared_ptr<const Shapes> many_balls(int count, double radius) {
  auto shapes = std::make_shared<Shapes>();
  Random random(7);
  for (int s = 0; s < count; ++s)
    shapes->push_back({std::make_unique<Sphere>(point(random, -5, 105),
                                                s == 0 ? 30 : uniform(random, 0.2 * radius, radius)),
                       s % 3});
  return shapes;
}
const Grid kGrid = uniform_grid({100, 100, 100}, {}, {1, 1, 1});

Box random_box(Random& random, double size) {
  const Vec3 lo = point(random, -10, 105);
  return {lo, lo + point(random, 0.01 * size, size)};
}

std::vector<std::int32_t> all_of(const Shapes& shapes) {
  std::vector<std::int32_t> all(shapes.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

void expect_same(const Fractions& a, const Fractions& b) {
  EXPECT_EQ(a.offset, b.offset);
  EXPECT_EQ(a.material, b.material);
  EXPECT_EQ(a.value, b.value);
}

TEST(ShapeField, FindsAmongManyWhatGoingThroughAllFinds) {
  const auto shapes = many_balls(100000, 1);
  const auto field = shape_field(shapes, kGrid, 3);
  const ShapeIndex index(*shapes, space_of(kGrid), 0.5);
  const std::vector<std::int32_t> all = all_of(*shapes);
  CellMeter meter(*shapes, 3);
  Random random(8);
  for (int n = 0; n < 100; ++n) {
    const Box box = random_box(random, n % 4 == 0 ? 4 : 1.5);
    Fractions found, expected;
    field->measure(box, found);
    meter.measure(box, all, expected);
    expect_same(found, expected);
    EXPECT_EQ(field->sole_material(box), meter.sole_material(box, all));
    std::vector<std::int32_t> near, all_near;
    index.find(box, near);
    for (const std::int32_t s : all) {
      const Box b = (*shapes)[static_cast<std::size_t>(s)].shape->bounds();
      bool overlap = true;
      for (std::size_t d = 0; d < 3; ++d)
        overlap = overlap && b.lo[d] - 0.5 < box.hi[d] && box.lo[d] < b.hi[d] + 0.5;
      if (overlap) all_near.push_back(s);
    }
    EXPECT_EQ(near, all_near);
    const auto around = index.around(box.lo);
    for (const std::int32_t s : all)
      if (index.is_near(s, box.lo)) EXPECT_TRUE(std::binary_search(around.begin(), around.end(), s)) << s;
  }
}

TEST(ShapeField, GivesCellsWhatWasRead) {
  const std::string inserts =
      "insert sphere\n center = 0.3 0.1 0\n radius = 0.7\nendinsert\n"
      "insert sphere\n center = -0.4 0 0.2\n radius = 0.6\nendinsert\n";
  const TemporaryFile file("diatom\npackage 'a'\nmaterial 1\n" + inserts + "endpackage\nenddiatom\n");
  std::unique_ptr<MaterialField> field;
  Grid grid;
  Fractions read;
  {
    const auto source = open_source(Comm::self(), diatom_deck(file.path(), 9, 1.1), Log());
    EXPECT_FALSE(source->is_data());
    const std::vector<IndexBox> wanted(1, whole({9, 9, 9}));
    grid = source->grid();
    read = source->read(Comm::self(), wanted).fractions;
    field = source->field({}, wanted[0]);
  }
  Fractions again;
  for (const Index3 cell : {Index3{0, 0, 0}, {4, 4, 4}, {6, 4, 3}}) {
    Box box;
    for (std::size_t d = 0; d < 3; ++d) {
      box.lo[d] = grid.planes[d][static_cast<std::size_t>(cell[d])];
      box.hi[d] = grid.planes[d][static_cast<std::size_t>(cell[d]) + 1];
    }
    again = {};
    field->measure(box, again);
    const auto c = static_cast<LocalId>(grid.cell_id(cell));
    for (std::int32_t m = 0; m < 2; ++m) EXPECT_EQ(fraction_of(again, 0, m), fraction_of(read, c, m));
  }
}

TEST(MeasureCells, AnyNumberOfThreadsMeasuresTheSame) {
  const auto shapes = many_balls(200, 12);
  const IndexBox box{{10, 20, 30}, {31, 33, 37}};
  for (const FractionMethod method : {FractionMethod::kLines, FractionMethod::kPoints}) {
    const auto make = [&] { return shape_field(shapes, kGrid, 3, method); };
    const Fractions one = measure_cells(kGrid, box, make, 1);
    EXPECT_EQ(one.cells(), box.size());
    for (const int threads : {2, 3, 8}) expect_same(measure_cells(kGrid, box, make, threads), one);
  }
  EXPECT_EQ(measure_cells(
                kGrid, IndexBox{}, [&] { return shape_field(shapes, kGrid, 3); }, 4)
                .cells(),
            0);
}

TEST(MeasureCells, FailureOfAThreadIsThrown) {
  const MakeField fails = []() -> std::unique_ptr<MaterialField> { throw Error("no field"); };
  EXPECT_THROW((void)measure_cells(kGrid, whole({4, 4, 4}), fails, 3), Error);
}

// The 125 points of a box are those that the first ball around them has.
TEST(ShapeField, PointsBelongToTheFirstShape) {
  const auto shapes = many_balls(300, 12);
  const auto field = shape_field(shapes, kGrid, 3, FractionMethod::kPoints);
  Random random(5);
  int mixed = 0;
  for (int n = 0; n < 100; ++n) {
    const Box box = random_box(random, 4);
    std::array<int, 4> count{};
    for (int p = 0; p < 125; ++p) {
      Vec3 at;
      const std::array<int, 3> place{p % 5, p / 5 % 5, p / 25};
      for (std::size_t d = 0; d < 3; ++d)
        at[d] = box.lo[d] + (box.hi[d] - box.lo[d]) * (0.2 * place[d] + 0.1);
      const auto first = std::find_if(shapes->begin(), shapes->end(), [&](const InsertedShape& inserted) {
        return inserted.shape->contains({at, at});
      });
      ++count[static_cast<std::size_t>(first == shapes->end() ? 3 : first->material)];
    }
    Fractions found;
    field->measure(box, found);
    mixed += found.material.size() > 1;
    for (std::int32_t m = 0; m < 4; ++m)
      EXPECT_EQ(fraction_of(found, 0, m), count[static_cast<std::size_t>(m)] / 125.0);
  }
  EXPECT_GT(mixed, 10);
}

TEST(ShapeField, NamesASoleMaterialOnlyWhereItIs) {
  const auto shapes = many_balls(300, 12);
  const auto field = shape_field(shapes, kGrid, 3);
  Random random(9);
  int sole = 0;
  for (int n = 0; n < 800; ++n) {
    const Box box = random_box(random, 3);
    const auto material = field->sole_material(box);
    if (!material) continue;
    ++sole;
    for (int probe = 0; probe < 50; ++probe) {
      Vec3 p;
      for (std::size_t d = 0; d < 3; ++d) p[d] = uniform(random, box.lo[d], box.hi[d]);
      const auto first = std::find_if(shapes->begin(), shapes->end(), [&](const InsertedShape& inserted) {
        return inserted.shape->contains({p, p});
      });
      ASSERT_EQ(first == shapes->end() ? 3 : first->material, *material);
    }
  }
  EXPECT_GT(sole, 100);
}

TEST(ShapeField, HasOnlyOneMaterialWhereTheOutsideIsOfIt) {
  auto shapes = std::make_shared<Shapes>();
  shapes->push_back({std::make_unique<Sphere>(Vec3{50, 50, 50}, 10), 0});
  const auto field = shape_field(shapes, kGrid, 0);
  EXPECT_EQ(field->sole_material({{35, 35, 35}, {65, 65, 65}}), 0);
}

// Share of a ball in unit cells that its surface crosses, against very many lines.
TEST(CellMeter, MeasuresBallsOfAllSizes) {
  for (const double radius : {0.6, 1.0, 1.9, 2.1, 4.0, 30.0}) {
    Random random(10);
    double squares = 0;
    constexpr int kCells = 80;
    for (int n = 0; n < kCells; ++n) {
      const Vec3 centre = point(random, -0.5, 0.5);
      const Vec3 on_surface = centre + radius * unit(point(random, -1, 1));
      Box cell;
      for (std::size_t d = 0; d < 3; ++d) {
        cell.lo[d] = std::floor(on_surface[d]);
        cell.hi[d] = cell.lo[d] + 1;
      }
      const Sphere ball(centre, radius);
      constexpr std::size_t kLines = 250;
      std::vector<double> v(kLines);
      ChordRow row;
      const std::size_t axis = ball.steepest_axis(0.5 * (cell.lo + cell.hi));
      const auto line = [&](std::size_t a, std::size_t l) {
        return cell.lo[a] + (static_cast<double>(l) + 0.5) / kLines;
      };
      for (std::size_t l = 0; l < kLines; ++l) v[l] = line((axis + 2) % 3, l);
      double expected = 0;
      for (std::size_t l = 0; l < kLines; ++l) {
        row.begin(kLines);
        ball.chords(axis, line((axis + 1) % 3, l), v, row);
        const auto [lo, hi] = row.layer(0);
        for (std::size_t k = 0; k < kLines; ++k)
          expected += std::max(0.0, std::min(hi[k], cell.hi[axis]) - std::max(lo[k], cell.lo[axis]));
      }
      expected /= kLines * kLines;
      Shapes shapes;
      shapes.push_back({std::make_unique<Sphere>(centre, radius), 0});
      Fractions f;
      CellMeter(shapes, 1).measure(cell, std::vector<std::int32_t>{0}, f);
      const double error = fraction_of(f, 0, 0) - expected;
      EXPECT_LT(std::fabs(error), 1e-3) << "radius " << radius;
      squares += error * error;
    }
    EXPECT_LT(std::sqrt(squares / kCells), 2e-4) << "radius " << radius;
  }
}

// The two ways of dealing out lines agree: a third ball in the cell, hidden in the first, changes nothing.
TEST(CellMeter, DealsOutOverlappingBalls) {
  Shapes shapes;
  shapes.push_back({std::make_unique<Sphere>(Vec3{0.2, 0.3, 0.4}, 0.5), 0});
  shapes.push_back({std::make_unique<Sphere>(Vec3{0.6, 0.5, 0.4}, 0.45), 1});
  shapes.push_back({std::make_unique<Sphere>(Vec3{0.2, 0.3, 0.4}, 0.3), 2});
  const Box cell{{0, 0, 0}, {1, 1, 1}};
  CellMeter meter(shapes, 3);
  Fractions two, three;
  meter.measure(cell, std::vector<std::int32_t>{0, 1}, two);
  meter.measure(cell, std::vector<std::int32_t>{0, 1, 2}, three);
  ASSERT_EQ(two.material, (std::vector<std::int32_t>{0, 1, 3}));
  EXPECT_EQ(three.material, two.material);
  for (std::size_t e = 0; e < 3; ++e) EXPECT_NEAR(three.value[e], two.value[e], 1e-14);
}

}  // namespace
}  // namespace sculpt
