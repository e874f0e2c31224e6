#include "sculpt/geom/solids.hpp"

#include <gtest/gtest.h>

#include "sculpt/base/error.hpp"
#include "solid_samples.hpp"

namespace sculpt {
namespace {

// The line from q to `within` enters or leaves the solid at q.
bool ends_at(const Shape& shape, const Vec3& q, const Vec3& within) {
  const std::vector<Piece> pieces = pieces_on(shape, q, within - q);
  return std::any_of(pieces.begin(), pieces.end(), [](const Piece& piece) {
    return std::fabs(piece.lo) < kSame || std::fabs(piece.hi) < kSame;
  });
}

TEST(Solids, NoPointOfTheSurfaceIsNearerThanTheNearest) {
  for_placed([](const Placed& placed, Random& random) {
    const Box around = grown(placed.shape->bounds(), 0.3);
    std::vector<Vec3> surface;
    Vec3 within;
    while (surface.size() < 300) {
      const Vec3 from = random.in(placed.shape->bounds()), step = random.direction();
      for (const auto& [lo, hi] : pieces_on(*placed.shape, from, step)) {
        surface.push_back(from + lo * step);
        surface.push_back(from + hi * step);
        within = from + 0.5 * (lo + hi) * step;
      }
    }
    int told = 0;
    for (int n = 0; n < 40; ++n) {
      const Vec3 p = random.in(around);
      const std::optional<Vec3> near = placed.shape->nearest_on_surface(p);
      if (!near) continue;
      ++told;
      const double distance = norm(*near - p);
      for (const Vec3& q : surface) EXPECT_GE(norm(q - p), distance - kSame);
      EXPECT_TRUE(ends_at(*placed.shape, *near, within) || has_both_sides(placed.inside, *near, random))
          << "not on the surface";
    }
    EXPECT_GE(told, 20);
  });
}

TEST(Solids, MovesFollowOneAnother) {
  // First a quarter turn around z and a step along x, then a step along y.
  const auto once = moved(box({1, 0, 0}, {3, 1, 1}), {{10, 0, 0}, {{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}}});
  EXPECT_EQ(once->bounds().lo, (Vec3{9, 1, 0}));
  EXPECT_EQ(once->bounds().hi, (Vec3{10, 3, 1}));
  const auto twice =
      moved(moved(box({1, 0, 0}, {3, 1, 1}), {{10, 0, 0}, {{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}}}),
            {{0, 0, 5}, {{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}}});
  EXPECT_EQ(twice->bounds().lo, (Vec3{9, -1, 6}));
  EXPECT_EQ(twice->bounds().hi, (Vec3{10, 0, 8}));
}

// Tells its chords only within a box: a stand-in for solids with many facets.
class Searched final : public Shape {
 public:
  explicit Searched(std::unique_ptr<Shape> shape) : shape_(std::move(shape)) {}
  [[nodiscard]] Box bounds() const override { return shape_->bounds(); }
  [[nodiscard]] bool contains(const Box& box) const override { return shape_->contains(box); }
  [[nodiscard]] bool misses(const Box& box) const override { return shape_->misses(box); }
  [[nodiscard]] bool is_gentle(const Box& box) const override { return shape_->is_gentle(box); }
  [[nodiscard]] bool has_edges(const Box& box) const override { return shape_->has_edges(box); }
  [[nodiscard]] std::size_t steepest_axis(const Vec3& p) const override { return shape_->steepest_axis(p); }
  void chords(std::size_t, double, std::span<const double>, ChordRow&) const override {
    FAIL() << "a search";
  }
  void line_chords(std::span<const Vec3>, std::span<const Vec3>, ChordRow&) const override {
    FAIL() << "a search";
  }
  [[nodiscard]] const Shape& within(const Box& box, std::unique_ptr<Shape>& storage) const override {
    EXPECT_FALSE(shape_->misses(box));
    storage.reset();
    return *shape_;
  }

 private:
  std::unique_ptr<Shape> shape_;
};

TEST(Solids, SearchesAreLeftToTheShapesWithin) {
  std::vector<std::shared_ptr<const Shape>> slot;
  slot.push_back(box({1.5, -9, -9}, {2, 9, 9}));
  const Frame quarter{{0, 0, 5}, {{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}}};
  const auto shape =
      moved(difference(std::make_unique<Searched>(samples()[1].make()), std::move(slot)), quarter);
  std::unique_ptr<Shape> storage;
  for (int cell = 0; cell < 2; ++cell) {  // the second one finds the storage of the first
    const Shape& local = shape->within({{-1, 1, 6}, {0, 3, 8}}, storage);
    const std::vector<Piece> pieces = pieces_on(local, {-0.5, 0, 7}, {0, 1, 0});
    ASSERT_EQ(pieces.size(), 2U);
    EXPECT_DOUBLE_EQ(pieces[0].lo, 1);
    EXPECT_DOUBLE_EQ(pieces[0].hi, 1.5);
    EXPECT_DOUBLE_EQ(pieces[1].lo, 2);
    EXPECT_DOUBLE_EQ(pieces[1].hi, 3);
  }
}

TEST(Solids, CornersOfADifferenceAreNotGuessed) {
  std::vector<std::shared_ptr<const Shape>> hole;
  hole.push_back(cylinder({2, 2, 0}, {2, 2, 4}, 1, 0));  // its ends lie in faces of the box
  const auto drilled = difference(box({0, 0, 0}, {4, 4, 4}), std::move(hole));
  EXPECT_FALSE(drilled->nearest_on_surface({2, 2, 4.25})) << "the open end of the hole is no surface";
  EXPECT_EQ(drilled->nearest_on_surface({0.5, 0.75, 4.25}), (Vec3{0.5, 0.75, 4}));
  EXPECT_EQ(drilled->nearest_on_surface({3.25, 2, 2}), (Vec3{3, 2, 2}));
}

TEST(Solids, PlanesMayBeGivenByFarPointsAndHaveNoPartInTheSolid) {
  const double far = 1e6;
  const auto cube = planes(std::vector<HalfSpace>{{{0, far, far}, {-1, 0, 0}},
                                                  {{1, far, 0}, {1, 0, 0}},
                                                  {{far, 0, 0}, {0, -1, 0}},
                                                  {{far, 1, far}, {0, 1, 0}},
                                                  {{far, far, 0}, {0, 0, -1}},
                                                  {{far, far, 1}, {0, 0, 1}},
                                                  {{far, far, far}, {1, 1, 1}}});
  EXPECT_LT(largest(cube->bounds().lo), 1e-9);
  EXPECT_LT(largest(cube->bounds().hi - Vec3{1, 1, 1}), 1e-9);
  EXPECT_TRUE(cube->contains({{0.1, 0.1, 0.1}, {0.9, 0.9, 0.9}}));
  EXPECT_TRUE(cube->misses({{1.1, 0.1, 0.1}, {1.2, 0.9, 0.9}}));
}

TEST(Solids, FacesOfAHexNeedNotBePlane) {
  const auto hex = polyhedron(std::vector<Vec3>{
      {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1.2, 1.2, 1.2}, {0, 1, 1}});
  // Six triangles around the last corner, with the origin tetrahedra of volume 1.2 / 6.
  EXPECT_NEAR(share_of(*hex, hex->bounds(), 0, 100) * 1.2 * 1.2 * 1.2, 1.2, 1e-3);
}

TEST(Solids, TheTipOfAPyramidIsOneCorner) {
  const auto pyramid = planes(std::vector<HalfSpace>{{{0, 0, 0}, {0, 0, -1}},
                                                     {{0, 0, 0.7}, {1, 0, 1}},
                                                     {{0, 0, 0.7}, {-1, 0, 1}},
                                                     {{0, 0, 0.7}, {0, 1, 1}},
                                                     {{0, 0, 0.7}, {0, -1, 1}}});
  EXPECT_NEAR(share_of(*pyramid, pyramid->bounds(), 2, 100), 1.0 / 3, 1e-4);
}

TEST(Solids, NearestPointsOfAnEllipsoidAcrossItsPlanesOfSymmetry) {
  const auto disc = ellipsoid({0, 0, 0}, {2, 1, 0.5});
  const auto distance = [&](const Vec3& p) { return norm(disc->nearest_on_surface(p).value() - p); };
  EXPECT_NEAR(distance({0, 0, 0}), 0.5, 1e-12);
  EXPECT_NEAR(distance({1.9, 0, 0}), 0.1, 1e-12) << "beyond the centre of curvature of the tip at 1.875";
  EXPECT_NEAR(distance({-5, 0, 0}), 3, 1e-12);
  EXPECT_NEAR(distance({0, 3, 0}), 2, 1e-12);
  // Before it: at x = 4 p / (4 - 0.25), z = 0.5 sqrt(1 - x^2 / 4).
  const double x = 4 * 1.5 / 3.75, z = 0.5 * std::sqrt(1 - x * x / 4);
  EXPECT_NEAR(distance({1.5, 0, 0}), std::hypot(x - 1.5, z), 1e-12);
}

std::string message_of(const std::function<void()>& make) {
  try {
    make();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Solids, WhatIsNoSolidIsRefused) {
  const double nan = std::nan("");
  const auto expect = [](const std::string& text, const std::function<void()>& make) {
    const std::string message = message_of(make);
    EXPECT_NE(message.find(text), std::string::npos) << message;
    EXPECT_NE(message.find("expected"), std::string::npos) << message;
  };
  const Vec3 o{0, 0, 0}, z{0, 0, 1};
  expect("radius of an ellipsoid is 0", [&] { (void)ellipsoid(o, {1, 0, 1}); });
  expect("center of an ellipsoid", [&] { (void)ellipsoid({nan, 0, 0}, {1, 1, 1}); });
  expect("side of a box is 0", [&] { (void)box(o, {1, 0, 1}); });
  expect("corner of a box", [&] { (void)box(o, {1, nan, 1}); });
  expect("radius of a cylinder is -1", [&] { (void)cylinder(o, z, -1, 0); });
  expect("radius of a cylinder is nan", [&] { (void)cylinder(o, z, nan, 0); });
  expect("inner radius 2", [&] { (void)cylinder(o, z, 2, 2); });
  expect("inner radius -1", [&] { (void)cylinder(o, z, 2, -1); });
  expect("both ends of its axis", [&] { (void)cylinder(z, z, 2, 1); });
  expect("finite", [&] { (void)cylinder({nan, 0, 0}, z, 2, 1); });
  expect("finite", [&] { (void)extrusion(o, z, {1, nan, 0}, notched()); });
  expect("finite", [&] { (void)planes(std::vector<HalfSpace>{{o, {nan, 0, 0}}}); });
  expect("radii 0 and 0", [&] { (void)cone(o, z, 0, 0); });
  expect("radius of a cone is -1", [&] { (void)cone(o, z, 1, -1); });
  expect("both ends of its axis", [&] { (void)cone(o, o, 1, 1); });
  expect("larger major radius", [&] { (void)torus(o, z, 1, 1); });
  expect("axis of a torus", [&] { (void)torus(o, o, 2, 1); });
  expect("minor radius of a torus is 0", [&] { (void)torus(o, z, 2, 0); });
  expect("3 corners", [&] { (void)polyhedron(std::vector<Vec3>{o, z, {1, 0, 0}}); });
  expect("lie in one plane", [&] {
    (void)polyhedron(std::vector<Vec3>{o, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}});
  });
  expect("point 5 of a polyhedron", [&] {
    (void)polyhedron(std::vector<Vec3>{o, z, {0, 1, 0}, {1, 0, 0}, {0.1, 0.1, 0.1}});
  });
  expect("point 5 of a polyhedron", [&] {
    (void)polyhedron(std::vector<Vec3>{o, z, {0, 1, 0}, {1, 0, 0}, {0.5, 0, 0}});
  });
  const std::vector<HalfSpace> open{{o, {-1, 0, 0}}, {o, {0, -1, 0}}, {o, {0, 0, -1}}, {z, {1, 1, 0}}};
  expect("infinity", [&] { (void)planes(open); });
  expect("infinity", [&] { (void)planes({}); });
  std::vector<HalfSpace> empty = open;
  empty.push_back({{-1, -1, -1}, {1, 1, 1}});
  expect("no volume", [&] { (void)planes(empty); });
  const std::vector<Point2> bow{{0, 0}, {2, 2}, {2, 0}, {0, 2}}, two{{0, 0}, {1, 1}},
      same{{0, 0}, {1, 0}, {1, 0}, {0, 1}}, back{{0, 0}, {2, 0}, {1, 0}}, left{{-1, 0}, {1, 0}, {1, 1}};
  expect("touch", [&] { (void)revolution(o, z, bow); });
  expect("2 corners", [&] { (void)revolution(o, z, two); });
  expect("corner 1 is at -1", [&] { (void)revolution(o, z, left); });
  expect("touch", [&] { (void)extrusion(o, z, {1, 0, 0}, bow); });
  expect("touch", [&] { (void)extrusion(o, z, {1, 0, 0}, back); });
  expect("corners 2 and 3", [&] { (void)extrusion(o, z, {1, 0, 0}, same); });
  expect("direction of u", [&] { (void)extrusion(o, z, {0, 0, 2}, left); });
}

}  // namespace
}  // namespace sculpt
