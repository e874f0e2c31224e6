// Diatom files of many shapes: the same mesh on any number of ranks, and one message for each mistake.
#include <gtest/gtest.h>

#include "bad_input.hpp"
#include "same_bits.hpp"
#include "solids/solids.hpp"

namespace sculpt::cli {
namespace {

std::string deck(const std::string& more = "") {
  return "diatom_file = s.diatom\nnelx = 18\nnely = 18\nnelz = 18\nxmin = -3\nymin = -3\nzmin = -3\nxmax = "
         "3\nymax = 3\nzmax = 3\n" +
         more;
}

class DiatomShapes : public SameBits {};

TEST_F(DiatomShapes, MixedWithStlAndDeletes) {
  write("part.stl", examples::ascii_stl(examples::box({0.8, 0.7, 0.6}), "part"));
  write("s.diatom",
        "diatom\n"
        "package 'tube' material 4\n"
        "  insert cylinder ce1 -2.5 -1.5 0 ce2 2.5 -1.5 0.5 radius 1 ri 0.5 endinsert\n"
        "endpackage\n"
        "package 'part' material 2\n"
        "  insert stl file = 'part.stl' rotate = 30 0 0 1 translate = 1.4 1.2 0.3\n"
        "    delete sphere center 0.8 0.7 0.6 radius 0.5 enddelete\n"
        "  endinsert\n"
        "endpackage\n"
        "package 'rest' material 7\n"
        "  delete box p1 -3 -3 -0.4 p2 0 3 0.4 enddelete\n"
        "  insert torus center -0.6 1.3 0 axis 1 0 3 major 1.2 minor 0.6 endinsert\n"
        "  insert ellipsoid center 0 0 0 radii 2.8 2.5 2 rotate 20 0 1 0 endinsert\n"
        "endpackage\n"
        "enddiatom\n");
  const RankMesh mesh = expect_same(deck(), {2, 3, 5});
  const auto hexes = hexes_by_block(mesh);
  EXPECT_EQ(hexes.size(), 3U);
  for (const std::int64_t id : {2, 4, 7}) EXPECT_GT(hexes.at(id), 50);
  EXPECT_GE(summary(first_console(), "Min Quality"), 0.1);
}

class BadDiatom : public BadInput {};

TEST_F(BadDiatom, IsRefusedWithOneMessage) {
  write("deck.i", "BEGIN SCULPT\n" + deck() + "END SCULPT\n");
  const auto expect = [&](const std::string& lines, const Words& expected) {
    SCOPED_TRACE(lines);
    write("s.diatom", "diatom\npackage 'a'\nmaterial 1\n" + lines + "endpackage\nenddiatom\n");
    expect_refused(3, expected);
  };
  expect("insert circle\ncenter 0 0\nradius 1\nendinsert\n", {"s.diatom", "line 4", "'circle'", "'sphere'"});
  expect("insert box\np1 0 0 0\np2 1 1 nan\nendinsert\n", {"s.diatom", "line 6", "nan", "'p2'"});
  expect("insert cone\nce1 0 0 0\nce2 0 0 0\nrad1 1\nrad2 0\nendinsert\n", {"s.diatom", "line 4: a cone"});
  expect("insert stl\nfile 'one.stl'\nendinsert\ninsert stl\nfile 'two.stl'\nendinsert\n",
         {"s.diatom", "line 4", "2 of 2 STL files", "'one.stl', 'two.stl'"});
}

}  // namespace
}  // namespace sculpt::cli
