#include "sculpt/geom/hex_quality.hpp"

#include <gtest/gtest.h>

#include <random>

namespace sculpt {
namespace {

// Twenty bent hexes, none sharing a node.
struct Bent {
  std::vector<Hex> hexes;
  std::vector<Vec3> position;
};

Bent bent_hexes() {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-0.4, 0.4);
  Bent bent;
  for (LocalId h = 0; h < 20; ++h) {
    Hex& hex = bent.hexes.emplace_back();
    for (std::size_t c = 0; c < 8; ++c) {
      hex[c] = static_cast<LocalId>(bent.position.size());
      Vec3 p{u(random) + h, u(random), u(random)};
      for (std::size_t d = 0; d < 3; ++d) p[d] += kCornerOffset[c][d];
      bent.position.push_back(p);
    }
  }
  return bent;
}

TEST(SizeOf, AgreesWithTheScalarFunctionsOnAnyAxes) {
  const Bent bent = bent_hexes();
  const Vec3 unit{0.5, 2, 3};
  for (LocalId first = 0; first < 20; first += 8) {
    std::vector<LocalId> which;
    for (LocalId h = first; h < std::min(20, first + 8); ++h) which.push_back(h);
    const HexSize size = size_of(bent.hexes, bent.position, which, unit);
    for (std::size_t i = 0; i < which.size(); ++i) {
      HexCorners p;
      for (std::size_t c = 0; c < 8; ++c) p[c] = scaled(bent.position[at(bent.hexes[at(which[i])][c])], unit);
      EXPECT_NEAR(size.volume[i], hex_volume(p), 1e-13) << which[i];
      EXPECT_NEAR(size.shortest_edge[i], shortest_edge(p), 1e-14) << which[i];
    }
  }
}

TEST(QualityOf, AgreesWithTheScalarFunctions) {
  const Bent bent = bent_hexes();
  const std::vector<LocalId> which{3, 17, 9};
  const HexQuality quality = quality_of(bent.hexes, bent.position, which);
  for (std::size_t i = 0; i < which.size(); ++i) {
    HexCorners p;
    for (std::size_t c = 0; c < 8; ++c) p[c] = bent.position[at(bent.hexes[at(which[i])][c])];
    EXPECT_NEAR(quality.scaled_jacobian[i], scaled_jacobian(p), 1e-14);
    EXPECT_NEAR(quality.shortest_edge[i], shortest_edge(p), 1e-14);
  }
}

}  // namespace
}  // namespace sculpt
