// Volume fractions that a run writes and another one reads make the same mesh.
#include <filesystem>

#include "same_bits.hpp"

namespace sculpt::cli {
namespace {

class Volfrac : public SameBits {
 protected:
  // Writes with some numbers of ranks and reads with others. `source`: the line that names the input.
  void expect_round_trip(const std::string& source, const std::string& more) {
    for (const int writers : {1, 3}) {
      const std::string base = "v" + std::to_string(writers);
      const RankMesh direct = mesh(source + more + "volfrac_file = " + base + "\n", writers);
      ASSERT_GT(hexes_of(direct), 0);
      for (const int readers : writers == 1 ? Ranks{1, 3} : Ranks{2, 5}) {
        SCOPED_TRACE(std::to_string(writers) + " to " + std::to_string(readers));
        EXPECT_TRUE(mesh("input_vfrac = " + base + "\n" + more, readers) == direct);
      }
    }
  }
};

TEST_F(Volfrac, Shapes) {
  write("s.diatom", two_spheres());
  const std::string grid =
      "nelx = 12\nnely = 11\nnelz = 13\nxmin = -12\nymin = -12.1\nzmin = -11.3\nxmax = 12\n"
      "ymax = 12\nzmax = 12.7\n";
  expect_round_trip("diatom_file = s.diatom\n", grid);
  expect_round_trip("diatom_file = s.diatom\n", grid + "mesh_void = true\n");
}

TEST_F(Volfrac, Voxels) {
  write("v.spn", spn_text(grains(6, 5, 3)));
  expect_round_trip("input_spn = v.spn\n", "nelx = 6\nnely = 6\nnelz = 6\nvoid_mat = 2\n");
}

TEST_F(Volfrac, Table) {
  write("f.tec", smooth_fractions());
  expect_round_trip("input_micro = f.tec\n", "");
}

TEST_F(Volfrac, BadFilesAreRefused) {
  write("f.tec", smooth_fractions());
  (void)mesh("input_micro = f.tec\nvolfrac_file = v\n", 3);
  const auto complaint = [&](const std::string& base) {
    write("r.i", "BEGIN SCULPT\ninput_vfrac = " + base + "\nexodus_file = out\nEND SCULPT\n");
    const RunResult result = run({"sculpt", "-j", "2", "-i", "r.i"});
    EXPECT_NE(result.status, 0);
    return result.error;
  };
  EXPECT_NE(complaint("none").find("found neither 'none.e' nor parts of it"), std::string::npos);
  EXPECT_NE(complaint("mesh3").find("expected"), std::string::npos) << "a mesh has no fractions";
  std::filesystem::resize_file(path("v.e.3.2"), 3000);
  EXPECT_NE(complaint("v").find("v.e.3.2"), std::string::npos);
  std::filesystem::remove(path("v.e.3.1"));
  EXPECT_NE(complaint("v").find("found 2 of the 3 parts of 'v.e': 'v.e.3.1' is missing"), std::string::npos);
  EXPECT_FALSE(exists("out.e.2.0"));
}

}  // namespace
}  // namespace sculpt::cli
