// Sharp edges and corners of STL solids in the mesh.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "same_bits.hpp"
#include "solids/solids.hpp"

namespace sculpt::cli {
namespace {

std::string deck(const std::string& more) {
  return "stl_file = solid.stl\ncapture = 5\nnelx = 14\nnely = 14\nnelz = 14\nxmin = -1\nymin = -1\nzmin = "
         "-1\n"
         "xmax = 1\nymax = 1\nzmax = 1\n" +
         more;
}

double from_nodes(const RankMesh& mesh, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < mesh.x.size(); ++n)
    least = std::min(least, norm(Vec3{mesh.x[n], mesh.y[n], mesh.z[n]} - p));
  return least;
}

class CaptureFromStl : public SameBits {};

TEST_F(CaptureFromStl, OfATurnedBox) {
  examples::Facets box = examples::box({0.6, 0.5, 0.55});
  examples::turn(box, 25, 15);
  write("solid.stl", examples::binary_stl(box, "box"));
  const RankMesh mesh = expect_same(deck("gen_sidesets = geometric_surfaces\n"), {2, 3, 5});
  EXPECT_GE(summary(first_console(), "Min Quality"), 0.1);
  EXPECT_EQ(mesh.side_sets.size(), 6U);
  for (const examples::Facet& facet : box)
    for (const Vec3& corner : facet) EXPECT_LT(from_nodes(mesh, corner), 1e-3);
}

TEST_F(CaptureFromStl, OfACylinderInItsMatrix) {
  write("solid.stl", examples::ascii_stl(examples::cylinder(0.6, 0.55, 32), "cylinder"));
  const RankMesh mesh = expect_same(deck("mesh_void = true\ngen_sidesets = variable\n"), {2, 3});
  EXPECT_GE(summary(first_console(), "Min Quality"), 0.1);
  EXPECT_EQ(mesh.side_sets.size(), 9U) << "the six sides of the box, the wall and the two ends";
  int on_rim = 0;
  for (std::size_t n = 0; n < mesh.x.size(); ++n) {
    const double r = std::hypot(mesh.x[n], mesh.y[n]);
    on_rim += std::fabs(std::fabs(mesh.z[n]) - 0.55) < 1e-3 && r < 0.6 + 1e-6 &&
              r > 0.6 * std::cos(M_PI / 32) - 1e-3;
  }
  EXPECT_GT(on_rim, 40);
}

TEST_F(CaptureFromStl, NeedsFacets) {
  write("spheres.diatom", two_spheres());
  write("d.i", "BEGIN SCULPT\n" + two_spheres_deck("spheres.diatom") + "capture = 5\nEND SCULPT\n");
  const RunResult result = run({"sculpt", "-i", "d.i", "-j", "2"});
  EXPECT_NE(result.status, 0);
  EXPECT_NE(result.error.find("no facets whose edges could be captured"), std::string::npos) << result.error;
}

TEST_F(CaptureFromStl, OfASideThatIsThere) {
  write("solid.stl", examples::binary_stl(examples::box({0.6, 0.5, 0.55}), "box"));
  write("d.i", "BEGIN SCULPT\n" + deck("capture_side = 7\n") + "END SCULPT\n");
  const RunResult result = run({"sculpt", "-i", "d.i"});
  EXPECT_NE(result.status, 0);
  EXPECT_NE(result.error.find("'capture_side' (line 13 of d.i): found 7, expected one of the 6 surfaces"),
            std::string::npos)
      << result.error;
}

}  // namespace
}  // namespace sculpt::cli
