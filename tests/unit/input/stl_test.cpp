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
    std::printf("%d: worst %g\n", slices, worst);
    EXPECT_LT(worst, 1e-3);
  }
}

TEST(StlFractions, OfBoxesAlongTheAxesAreRight) {
  const auto shapes = solid_of(test::box_facets({-1, -1, -1}, {1, 1, 1}));
  const auto field = shape_field(shapes, kSpace, 1);
  Random random(5);
  double worst = 0;
  for (int n = 0; n < 40; ++n) {
    const Vec3 lo = random_point(random, 0.7, 1), hi = lo + random_point(random, 0.3, 0.4);
    Fractions found;
    field->measure({lo, hi}, found);
    double exact = 1;
    for (std::size_t d = 0; d < 3; ++d) exact *= (1 - lo[d]) / (hi[d] - lo[d]);
    worst = std::max(worst, std::fabs(share_of(found) - exact));
  }
  std::printf("worst %g\n", worst);
}

}  // namespace
}  // namespace sculpt
