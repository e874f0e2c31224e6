// STL files as users have them: what the programs make of them.
#include <gtest/gtest.h>

#include <cmath>

#include "same_bits.hpp"
#include "support/surfaces.hpp"

namespace sculpt::cli {
namespace {

using test::operator+;

class Stl : public SameBits {
 protected:
  [[nodiscard]] bool warned(const std::string& of) const {
    for (const std::string& line : lines_of(first_console()))
      if (line.starts_with("WARNING: ") && line.find(of) != std::string::npos) return true;
    return false;
  }
};

test::Facets ball(int slices, double radius) {
  return test::ball_facets(slices, [=](const Vec3&) { return radius; });
}

// Sculpt makes 6672 hexes of a ball of radius 0.4995.
TEST_F(Stl, BallHasTheHexesOfSculpt) {
  write("ball.stl", test::binary_stl(ball(92, 0.5)));
  const RankMesh mesh = expect_same("stl_file = ball.stl\n" + box_deck(26, 0.6241), {3});
  EXPECT_EQ(hexes_of(mesh), 6672);
  EXPECT_GE(summary(first_console(), "Min Quality"), 0.3518);
  EXPECT_FALSE(warned("ball.stl"));
}

TEST_F(Stl, DefectsAreToldAndRanksAgree) {
  test::Facets bad = test::ball_facets(24, [](const Vec3& w) { return 0.8 + 0.15 * w.x * w.y; });
  for (std::size_t f = 0; f < bad.size(); f += 5) std::swap(bad[f][0], bad[f][1]);
  bad.erase(bad.begin() + 100, bad.begin() + 104);
  bad.push_back(bad[7]);
  write("bad.stl", test::ascii_stl(bad));
  expect_same("stl_file = bad.stl\n" + box_deck(12, 1.1) + "smooth = to_geometry\n", kFew);
  for (const char* what : {"facets flipped", "duplicate facets dropped", "open edges"})
    EXPECT_TRUE(warned(what)) << what;
}

TEST_F(Stl, MixesWithShapesInADiatomFile) {
  write("a.stl", test::ascii_stl(ball(20, 0.6) + test::moved(ball(20, 0.6), {0.3, 0.2, 0.1})));
  write("none.stl", "solid none\nendsolid none\n");
  write("mix.diatom",
        "diatom\npackage 'a'\nmaterial 3\ninsert sphere\ncenter 0.8 0 0\nradius 0.4\nendinsert\nendpackage\n"
        "package 'n'\nmaterial 7\ninsert stl\nfile = none.stl\nendinsert\nendpackage\n"
        "package 'b'\nmaterial 2\ninsert stl\nFILE = 'a.stl'\nendinsert\nendpackage\nenddiatom\n");
  const RankMesh mesh = expect_same("diatom_file = mix.diatom\n" + box_deck(14, 1.3), kFew);
  EXPECT_EQ(hexes_by_block(mesh).size(), 2U);
  EXPECT_TRUE(warned("'none.stl' has no facets and fills nothing"));
}

}  // namespace
}  // namespace sculpt::cli
