#include "smooth/star.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "sculpt/mesh/adjacency.hpp"
#include "support/stages.hpp"

namespace sculpt {
namespace {

constexpr Vec3 kScale{1, 1, 1};

// 2x2x2 cells with moved nodes; the middle node is the one to move.
struct Block {
  explicit Block(double noise, std::uint64_t seed = 1)
      : mesh(test::overlay(test::voxels({2, 2, 2}, std::vector<std::int32_t>(8, 0))).cells), around(mesh) {
    for (std::size_t n = 0; n < mesh.position.size(); ++n)
      for (std::size_t d = 0; d < 3; ++d)
        mesh.position[n][d] += noise * (test::scatter_unit(seed, 3 * n + d) - 0.5);
  }
  [[nodiscard]] Star star(Star::Target target = Star::Target::kPresent, std::size_t hexes = 8) const {
    Star s;
    s.gather(mesh.hexes, mesh.position, around[kMiddle].subspan(0, hexes), kMiddle, kScale, target);
    return s;
  }
  static constexpr LocalId kMiddle = 13;
  HexMesh mesh;
  NodeHexes around;
};

TEST(Star, EnergyOfPerfectCubesIsOnePerTet) {
  for (const int r : {1, 2, 4, 8}) {
    const Star star = Block(0).star();
    EXPECT_EQ(star.tets(), 32);
    EXPECT_EQ(star.shortest_edge(), 1);
    const Derivatives d = star.derivatives(r, 0);
    EXPECT_NEAR(d.energy, 32, 1e-12);
    EXPECT_NEAR(norm(d.gradient), 0, 1e-12);
    EXPECT_EQ(d.not_positive, 0);
    EXPECT_NEAR(d.hessian[0], d.hessian[3], 1e-9) << "the block looks the same along every axis";
    EXPECT_NEAR(d.hessian[3], d.hessian[5], 1e-9);
    EXPECT_GT(d.hessian[0], 0);
  }
}

TEST(Star, DerivativesAgreeWithDifferencesOfValues) {
  constexpr double kStep = 1e-5;
  for (const auto target : {Star::Target::kPresent, Star::Target::kUnit})
    for (const int r : {1, 2, 4})
      for (const double eps : {0.0, 1e-2}) {
        const Star star = Block(0.5, static_cast<std::uint64_t>(r)).star(target);
        const Derivatives d = star.derivatives(r, eps);
        const double size = d.energy;
        EXPECT_NEAR(star.value({}, r, eps).energy / size, 1, 1e-12);
        for (std::size_t a = 0; a < 3; ++a) {
          Vec3 step;
          step[a] = kStep;
          const double up = star.value(step, r, eps).energy, down = star.value(-step, r, eps).energy;
          EXPECT_NEAR(d.gradient[a] / size, (up - down) / (2 * kStep) / size, 1e-6)
              << "axis " << a << ", r " << r;
        }
      }
}

// At a minimum of every single tetrahedron the curvature is exact; elsewhere the part that could make it
// indefinite may be left out. Perfect cubes are such a point.
TEST(Star, CurvatureOfPerfectCubesAgreesWithDifferences) {
  constexpr double kStep = 1e-4;
  const Star star = Block(0).star(Star::Target::kUnit);
  for (const int r : {1, 2}) {
    const Derivatives d = star.derivatives(r, 0);
    const double middle = star.value({}, r, 0).energy;
    const double curvature =
        (star.value({kStep, 0, 0}, r, 0).energy - 2 * middle + star.value({-kStep, 0, 0}, r, 0).energy) /
        (kStep * kStep);
    EXPECT_NEAR(d.hessian[0], curvature, 1e-3 * curvature) << "r " << r;
  }
}

TEST(Star, TheValueOfAMoveIsTheValueAfterTheMove) {
  const Vec3 move{0.07, -0.04, 0.05};
  for (const double eps : {0.0, 0.1}) {
    Block block(0.4);
    const Star before = block.star(Star::Target::kUnit);
    block.mesh.position[Block::kMiddle] += move;
    const Star after = block.star(Star::Target::kUnit);
    const Star::Value foretold = before.value(move, 2, eps), found = after.value({}, 2, eps);
    EXPECT_NEAR(foretold.energy / found.energy, 1, 1e-12);
    EXPECT_EQ(foretold.not_positive, found.not_positive);
    const Star::Shape shape = before.shape(move), seen = after.shape({});
    EXPECT_NEAR(shape.scaled_jacobian, seen.scaled_jacobian, 1e-12);
    EXPECT_NEAR(shape.edge, seen.edge, 1e-12);
  }
}

TEST(Star, ShapeIsTheScaledJacobianOfTheCornersWithTheNode) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Block block(0.9, seed);
    double least = 2, edge = 1e300;
    for (const std::int32_t item : block.around[Block::kMiddle]) {
      const HexCorners p = block.mesh.corners(item / 8);
      const auto corner = static_cast<std::size_t>(item % 8);
      least = std::min(least, corner_scaled_jacobian(p, item % 8));
      for (const int n : kCornerNeighbours[corner]) {
        least = std::min(least, corner_scaled_jacobian(p, n));
        edge = std::min(edge, norm(p[static_cast<std::size_t>(n)] - p[corner]));
      }
    }
    const Star::Shape shape = block.star().shape({});
    EXPECT_NEAR(shape.scaled_jacobian, least, 1e-12);
    EXPECT_NEAR(shape.edge, edge, 1e-12);
    EXPECT_NEAR(block.star().shortest_edge(), edge, 1e-12);
  }
}

// Lanes that hold no hex count for nothing: the star of five hexes is the sum of the stars of its hexes.
TEST(Star, PaddingIsNeutral) {
  const Block block(0.5, 7);
  for (const std::size_t hexes : {std::size_t{1}, std::size_t{5}, std::size_t{7}}) {
    const Star star = block.star(Star::Target::kPresent, hexes);
    EXPECT_EQ(star.tets(), static_cast<int>(4 * hexes));
    const Derivatives all = star.derivatives(2, 1e-2);
    double energy = 0, xx = 0;
    Vec3 gradient;
    Star::Shape least{2, 1e300};
    for (std::size_t h = 0; h < hexes; ++h) {
      Star one;
      one.gather(block.mesh.hexes, block.mesh.position, block.around[Block::kMiddle].subspan(h, 1),
                 Block::kMiddle, kScale, Star::Target::kPresent);
      const Derivatives d = one.derivatives(2, 1e-2);
      energy += d.energy;
      gradient += d.gradient;
      xx += d.hessian[0];
      least.scaled_jacobian = std::min(least.scaled_jacobian, one.shape({}).scaled_jacobian);
      least.edge = std::min(least.edge, one.shape({}).edge);
    }
    EXPECT_NEAR(all.energy / energy, 1, 1e-12);
    EXPECT_NEAR(norm(all.gradient - gradient) / norm(gradient), 0, 1e-12);
    EXPECT_NEAR(all.hessian[0] / xx, 1, 1e-12);
    EXPECT_EQ(star.shape({}).scaled_jacobian, least.scaled_jacobian);
    EXPECT_EQ(star.shape({}).edge, least.edge);
  }
}

// More than eight hexes: a second batch, used again by a smaller star.
TEST(Star, TakesAnyNumberOfHexesOneAfterAnother) {
  const Block block(0.3, 5);
  std::vector<std::int32_t> items(block.around[Block::kMiddle].begin(), block.around[Block::kMiddle].end());
  std::vector<std::int32_t> twice = items;
  twice.insert(twice.end(), items.begin(), items.end());
  Star star;
  const auto energy = [&](std::span<const std::int32_t> of) {
    star.gather(block.mesh.hexes, block.mesh.position, of, Block::kMiddle, kScale, Star::Target::kPresent);
    return star.derivatives(1, 0).energy;
  };
  const double once = energy(items);
  EXPECT_NEAR(energy(twice), 2 * once, 1e-12 * once);
  EXPECT_EQ(energy(items), once);
}

TEST(Star, CountsInvertedCornersAndStaysFiniteThere) {
  Block block(0);
  block.mesh.position[Block::kMiddle] = {2.5, 1, 1};  // beyond its neighbour at x = 2
  const Star star = block.star(Star::Target::kUnit);
  const Derivatives d = star.derivatives(1, 1e-2);
  EXPECT_GT(d.not_positive, 0);
  EXPECT_EQ(star.value({}, 1, 1e-2).not_positive, d.not_positive);
  EXPECT_TRUE(std::isfinite(d.energy));
  EXPECT_LT(star.shape({}).scaled_jacobian, 0);
  EXPECT_GT(d.gradient.x, 0) << "the energy falls on the way back";
  EXPECT_EQ(star.value({-1.5, 0, 0}, 1, 1e-2).not_positive, 0);
}

TEST(Star, ScalesEveryAxis) {
  Block flat(0);
  for (Vec3& p : flat.mesh.position) p = scaled(p, {1, 0.1, 10});
  Star star;
  star.gather(flat.mesh.hexes, flat.mesh.position, flat.around[Block::kMiddle], Block::kMiddle, {1, 10, 0.1},
              Star::Target::kUnit);
  EXPECT_NEAR(star.derivatives(2, 0).energy, 32, 1e-12);
  EXPECT_NEAR(star.shortest_edge(), 1, 1e-15);
}

}  // namespace
}  // namespace sculpt
