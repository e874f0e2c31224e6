#include "sculpt/mesh/exterior.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sculpt/mesh/edit.hpp"
#include "sculpt/mesh/hex_mesh.hpp"
#include "support/cases.hpp"
#include "support/input_meshes.hpp"
#include "support/mesh_checks.hpp"

namespace sculpt {
namespace {

Vec3 random_point(std::uint64_t item, double size = 3) {
  const auto number = [&](std::uint64_t d) { return size * (test::scatter_unit(31, 3 * item + d) - 0.5); };
  return {number(0), number(1), number(2)};
}

TEST(NearestOnTriangle, IsNoFartherThanAnyOfManyPoints) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Vec3 a = random_point(4 * i), b = random_point(4 * i + 1), c = random_point(4 * i + 2),
               p = random_point(4 * i + 3, 6), q = nearest_on_triangle(p, a, b, c);
    double least = 1e9, to_q = 1e9;
    for (int u = 0; u <= 40; ++u)
      for (int v = 0; u + v <= 40; ++v) {
        const Vec3 on = a + (u / 40.0) * (b - a) + (v / 40.0) * (c - a);
        least = std::min(least, norm(on - p));
        to_q = std::min(to_q, norm(on - q));
      }
    EXPECT_LE(norm(q - p), least + 1e-12);
    EXPECT_LT(to_q, 0.2) << "it lies on the triangle";
    EXPECT_LT(std::fabs(dot(q - a, unit(cross(b - a, c - a)))), 1e-12);
  }
}

TEST(NearestOnTriangle, KeepsWhatTheCornersHaveInCommon) {
  const double x = 1.0 / 3;
  for (std::uint64_t i = 0; i < 300; ++i) {
    Vec3 a = random_point(4 * i), b = random_point(4 * i + 1), c = random_point(4 * i + 2);
    const std::size_t axis = i % 3;
    a[axis] = b[axis] = c[axis] = x;
    EXPECT_EQ(nearest_on_triangle(random_point(4 * i + 3, 6), a, b, c)[axis], x);
    EXPECT_EQ(nearest_on_segment(random_point(4 * i + 3, 6), a, b)[axis], x);
  }
}

TEST(NearestOnTriangle, OfCornersAndWithoutArea) {
  const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
  EXPECT_EQ(nearest_on_triangle({-1, -1, 5}, a, b, c), a);
  EXPECT_EQ(nearest_on_triangle({3, -1, 5}, a, b, c), b);
  EXPECT_EQ(nearest_on_triangle({-1, 3, 5}, a, b, c), c);
  EXPECT_EQ(nearest_on_triangle({0.25, 0.5, -2}, a, b, c), (Vec3{0.25, 0.5, 0}));
  EXPECT_EQ(nearest_on_triangle({1, 1, 0}, a, b, c), (Vec3{0.5, 0.5, 0}));
  EXPECT_EQ(nearest_on_triangle({5, 5, 5}, a, a, a), a);
  EXPECT_EQ(nearest_on_segment({5, 5, 5}, a, a), a);
  EXPECT_EQ(nearest_on_segment({0.25, 2, 0}, a, b), (Vec3{0.25, 0, 0}));
}

// A square in the plane z = height, seen from above, from (x, y) on.
Facet square(double x, double y, double height = 0) {
  Facet f;
  f.corner = {{{x, y, height}, {x + 1, y, height}, {x + 1, y + 1, height}, {x, y + 1, height}}};
  return f;
}

TEST(Facet, NormalsPlanesAndEdges) {
  const Facet f = square(0, 0), beside = square(1, 0), above = square(1, 0, 0.1), far = square(3, 0);
  EXPECT_EQ(facet_normal(f), (Vec3{0, 0, 1}));
  EXPECT_TRUE(is_flat(f));
  EXPECT_TRUE(coplanar(f, beside));
  EXPECT_TRUE(coplanar(f, far));
  EXPECT_FALSE(coplanar(f, above));
  Facet down = beside;
  std::swap(down.corner[1], down.corner[3]);
  EXPECT_FALSE(coplanar(f, down)) << "back to back";
  Facet bent = f;
  bent.corner[2].z = 0.01;
  EXPECT_FALSE(is_flat(bent));
  EXPECT_FALSE(coplanar(bent, f));
  std::array<Vec3, 2> ends;
  ASSERT_TRUE(common_edge(f, beside, ends));
  EXPECT_EQ(ends, (std::array<Vec3, 2>{Vec3{1, 0, 0}, Vec3{1, 1, 0}}));
  ASSERT_TRUE(common_edge(beside, f, ends));
  EXPECT_EQ(ends, (std::array<Vec3, 2>{Vec3{1, 1, 0}, Vec3{1, 0, 0}}));
  EXPECT_FALSE(common_edge(f, far, ends));
  EXPECT_FALSE(common_edge(f, down, ends)) << "seen from the other side it runs the same way";
}

TEST(Exterior, HoldsOnLinesAndSurfaces) {
  Exterior e;
  EXPECT_TRUE(e.empty());
  e.facets = {square(0, 0), square(1, 0)};
  Facet wall;  // x = 2
  wall.corner = {{{2, 0, 0}, {2, 0, -1}, {2, 1, -1}, {2, 1, 0}}};
  e.facets.push_back(wall);
  e.faces = {{3, 1, 0}, {3, 4, 1}, {7, 0, 2}};
  EXPECT_EQ(e.facet_at(3, 4), 1);
  EXPECT_EQ(e.facet_at(7, 0), 2);
  EXPECT_EQ(e.facet_at(3, 0), kNone);
  EXPECT_EQ(e.facet_at(8, 0), kNone);

  const LocalId plane = e.add_surface(std::vector<LocalId>{0, 1}),
                bend = e.add_surface(std::vector<LocalId>{1, 2});
  EXPECT_EQ(e.nearest(plane, {1.75, 0.25, 4}), (Vec3{1.75, 0.25, 0}));
  EXPECT_EQ(e.nearest(plane, {9, 0.25, 4}), (Vec3{2, 0.25, 0}));
  EXPECT_EQ(e.direction(plane, {0.5, 0.5, 1}), (Vec3{0, 0, 1}));
  EXPECT_EQ(e.nearest(bend, {2.5, 0.5, -0.75}), (Vec3{2, 0.5, -0.75}));
  EXPECT_EQ(e.direction(bend, {2.5, 0.5, -0.75}), (Vec3{1, 0, 0}));
  EXPECT_EQ(e.nearest(bend, {0.5, 0.5, 1}), (Vec3{1, 0.5, 0})) << "other facets do not count";

  const LocalId line = e.add_line({Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 2, 0}}),
                one = e.add_line({Vec3{0, 0, 0}, Vec3{0, 0, 0}, Vec3{0, 2, 0}});
  EXPECT_EQ(e.nearest(line, {0.25, 0.125, 1}), (Vec3{0.25, 0, 0}));
  EXPECT_EQ(e.nearest(line, {1.25, 1, 1}), (Vec3{1, 1, 0}));
  EXPECT_EQ(e.direction(line, {0.25, 0.1, 0}), (Vec3{1, 0, 0}));
  EXPECT_EQ(e.direction(line, {1.25, 1, 1}), (Vec3{0, 1, 0}));
  EXPECT_EQ(e.direction(one, {0, 0, 0}), (Vec3{0, 1, 0})) << "not the segment without length";
  EXPECT_EQ(e.nearest(one, {5, 0.5, 0}), (Vec3{0, 0.5, 0}));
}

TEST(Held, OnABoxAlongItsSides) {
  HexMesh mesh = test::lattice({2, 2, 2});
  const auto node_at = [&](const Vec3& p) {
    for (LocalId n = 0; n < mesh.nodes(); ++n)
      if (mesh.position[at(n)] == p) return n;
    return kNone;
  };
  const Vec3 move{0.1, 0.2, 0.3};
  EXPECT_EQ(held(mesh, node_at({1, 1, 1}), {1, 1, 1}, move), move);
  EXPECT_EQ(held(mesh, node_at({0, 1, 1}), {0, 1, 1}, move), (Vec3{0, 0.2, 0.3}));
  EXPECT_EQ(held(mesh, node_at({0, 2, 1}), {0, 2, 1}, move), (Vec3{0, 0, 0.3}));
  EXPECT_EQ(held(mesh, node_at({0, 2, 0}), {0, 2, 0}, move), (Vec3{}));
  EXPECT_EQ(freedom(mesh, node_at({0, 1, 1}), {0, 1, 1}).along(move), (Vec3{0, 0.2, 0.3}));
  EXPECT_EQ(freedom(mesh, node_at({0, 1, 1}), {0, 1, 1}).dimensions, 3);
}

TEST(Held, OnAnExterior) {
  HexMesh mesh;
  mesh.position.assign(4, {0.5, 0.5, 0});
  mesh.box_sides.assign(4, 0);
  Exterior& e = mesh.exterior;
  e.facets = {square(0, 0)};
  e.holds.push_back({});
  const LocalId plane = e.add_surface(std::vector<LocalId>{0}),
                line = e.add_line({Vec3{0, 0.5, 0}, Vec3{0.5, 0.5, 0}, Vec3{1, 0.5, 0}});
  e.hold_of = {kNone, 0, plane, line};
  const Vec3 from{0.5, 0.5, 0}, move{0.25, 0.125, 0.5};
  EXPECT_EQ(held(mesh, 0, from, move), move);
  EXPECT_EQ(held(mesh, 1, from, move), (Vec3{}));
  EXPECT_EQ(held(mesh, 2, from, move), (Vec3{0.25, 0.125, 0}));
  EXPECT_EQ(held(mesh, 2, from, 4 * move), (Vec3{0.5, 0.5, 0})) << "not beyond its facets";
  EXPECT_EQ(held(mesh, 3, from, move), (Vec3{0.25, 0, 0}));
  EXPECT_EQ(freedom(mesh, 0, from).dimensions, 3);
  EXPECT_EQ(freedom(mesh, 0, from).along(move), move);
  EXPECT_EQ(freedom(mesh, 1, from).along(move), (Vec3{}));
  EXPECT_EQ(freedom(mesh, 2, from).along(move), (Vec3{0.25, 0.125, 0}));
  EXPECT_EQ(freedom(mesh, 3, from).along(move), (Vec3{0.25, 0, 0}));
}

TEST(JoinHexes, OfTwoPartsIsTheWhole) {
  HexMesh whole = test::input_cells(Comm::self(), test::cylinder(2, 3)).cells;
  for (LocalId h = 0; h < whole.size(); ++h) whole.material[at(h)] = h % 3;
  for (const GlobalId factor : {1, 64}) {
    HexMesh one = whole, other = whole;
    std::vector<std::uint8_t> first(whole.hexes.size()), second(whole.hexes.size());
    for (std::size_t h = 0; h < first.size(); ++h) {
      first[h] = test::scatter(3, h) % 3 == 0;
      second[h] = !first[h];
    }
    (void)remove_hexes(Comm::self(), one, second);
    (void)remove_hexes(Comm::self(), other, first);
    EXPECT_EQ(one.size() + other.size(), whole.size());
    for (GlobalId& id : one.node_id) id *= factor;
    for (GlobalId& id : one.hex_id) id *= factor / 8 + 1;
    join_hexes(Comm::self(), one, other, factor, factor / 8 + 1);
    EXPECT_EQ(one.position, whole.position);
    EXPECT_EQ(one.hexes, whole.hexes);
    EXPECT_EQ(one.material, whole.material);
    EXPECT_EQ(one.node_unit, whole.node_unit);
    EXPECT_EQ(one.colour, whole.colour);
    EXPECT_TRUE(one.exterior.empty());
    ASSERT_EQ(one.node_id.size(), whole.node_id.size());
    for (std::size_t n = 0; n < one.node_id.size(); ++n) ASSERT_EQ(one.node_id[n], factor * whole.node_id[n]);
    for (std::size_t h = 0; h < one.hex_id.size(); ++h)
      ASSERT_EQ(one.hex_id[h], (factor / 8 + 1) * whole.hex_id[h]);
    EXPECT_EQ(test::conformity_problem(one, factor == 1 ? 0 : 1), "");
    EXPECT_EQ(test::ghost_problem(one), "");
  }
}

}  // namespace
}  // namespace sculpt
