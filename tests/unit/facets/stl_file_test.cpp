#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "sculpt/base/error.hpp"
#include "support/surfaces.hpp"

namespace sculpt::test {
namespace {

const Facets kCube = box_facets({0, 0, 0}, {1, 2, 3});

std::string error_of(const std::string& text) {
  try {
    (void)parse_stl(text, "f.stl");
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(StlFile, BinaryAndAsciiAreTheSame) {
  const FacetMesh binary = parse_stl(binary_stl(kCube), "b.stl"),
                  ascii = parse_stl(ascii_stl(kCube), "a.stl");
  EXPECT_EQ(binary.vertices, ascii.vertices);
  EXPECT_EQ(binary.triangles, ascii.triangles);
  EXPECT_EQ(binary.vertices.size(), 8U);
  EXPECT_EQ(binary.triangles.size(), 12U);
  EXPECT_EQ(binary.facet.back(), 12);
}

TEST(StlFile, BinaryMayBeginWithSolid) {
  EXPECT_EQ(parse_stl(binary_stl(kCube, "solid of a program"), "b.stl").triangles.size(), 12U);
}

TEST(StlFile, KeepsTheNamesOfSolids) {
  const FacetMesh mesh = parse_stl(
      ascii_stl(kCube, "left part") + "\n" + ascii_stl(moved(kCube, {5, 0, 0}), "right") + ascii_stl({}, ""),
      "a.stl");
  EXPECT_EQ(mesh.part_names, (std::vector<std::string>{"left part", "right", ""}));
  EXPECT_EQ(mesh.part[11], 0);
  EXPECT_EQ(mesh.part[12], 1);
}

TEST(StlFile, AsciiMayBeUntidy) {
  std::string text = ascii_stl(kCube);
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, "\r");
  const std::size_t first = text.find("facet");
  text.replace(first, 5, "\t FACET");
  text.replace(text.find("vertex 0 "), 9, "vertex -0.0E+00  ");
  EXPECT_EQ(parse_stl(text, "a.stl").vertices.size(), 8U);
}

TEST(StlFile, OfNoFacetsIsEmpty) {
  EXPECT_TRUE(parse_stl("solid nothing\nendsolid nothing\n", "a.stl").triangles.empty());
  EXPECT_TRUE(parse_stl(binary_stl({}), "b.stl").triangles.empty());
}

TEST(StlFile, CutOffIsRefused) {
  const std::string text = binary_stl(kCube);
  EXPECT_EQ(
      error_of(text.substr(0, 600)),
      "f.stl: found 600 bytes; a binary STL file of 12 facets, as its header says, has 684 bytes, and an "
      "ASCII one begins with 'solid': it is cut off, damaged or no STL file");
  EXPECT_NE(error_of(text + "x").find("found 685 bytes"), std::string::npos);
  EXPECT_EQ(error_of("nonsense"),
            "f.stl: found 8 bytes that do not begin with 'solid', expected an STL file");
  EXPECT_EQ(error_of("solid s\nfacet normal 0 0 1\nouter loop\nvertex 1 2 3\nvertex 1 2\nendloop\n"),
            "f.stl, line 6: found 'endloop', expected three finite coordinates of a vertex");
  EXPECT_EQ(error_of("solid s\nfacet normal 0 0 1\nouter loop\n"),
            "f.stl, line 4: found the end of the file, expected 'vertex'");
  EXPECT_EQ(error_of("solid s\n"),
            "f.stl, line 2: found the end of the file, expected 'facet' or 'endsolid'");
}

TEST(StlFile, NumbersThatAreNoneAreRefused) {
  std::string text = ascii_stl(kCube);
  text.replace(text.find("vertex 1 "), 9, "vertex nan ");
  EXPECT_EQ(error_of(text), "f.stl, line 5: found 'nan', expected three finite coordinates of a vertex");
  std::string binary = binary_stl(kCube);
  const float infinity = std::numeric_limits<float>::infinity();
  std::memcpy(binary.data() + 84 + 50 * 3 + 12, &infinity, sizeof infinity);
  EXPECT_EQ(error_of(binary), "f.stl, facet 4: found a coordinate inf, expected a finite number");
}

}  // namespace
}  // namespace sculpt::test
