#include "sculpt/input/pamgen.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "input/pamgen_trial.hpp"
#include "input_fixture.hpp"
#include "pamgen_descriptions.hpp"
#include "sculpt/geom/hex.hpp"

namespace sculpt {
namespace {

using namespace test;

InputMesh mesh_of(const std::string& text) {
  const TemporaryFile file(text);
  return read_pamgen(Comm::self(), file.path(), Log());
}

HexCorners corners_of(const ElementShare& share, std::size_t e) {
  HexCorners p;
  for (std::size_t c = 0; c < 8; ++c) p[c] = share.position[static_cast<std::size_t>(share.corner[e][c])];
  return p;
}

double volume(const InputMesh& mesh, std::int32_t block = -1) {
  double sum = 0;
  for (std::size_t e = 0; e < mesh.share.element.size(); ++e)
    if (block < 0 || mesh.share.block[e] == block) sum += hex_volume(corners_of(mesh.share, e));
  return sum;
}

// Faces of one hex only.
std::int64_t outer_faces(const InputMesh& mesh) {
  std::map<std::array<GlobalId, 4>, int> hexes_at;
  for (const auto& corner : mesh.share.corner)
    for (const auto& face : kFaces) {
      std::array<GlobalId, 4> nodes;
      for (std::size_t c = 0; c < 4; ++c) nodes[c] = corner[static_cast<std::size_t>(face[c])];
      std::sort(nodes.begin(), nodes.end());
      ++hexes_at[nodes];
    }
  return std::count_if(hexes_at.begin(), hexes_at.end(), [](const auto& f) { return f.second == 1; });
}

void expect_numbered(const InputMesh& mesh, GlobalId elements, GlobalId nodes) {
  const ElementShare& share = mesh.share;
  EXPECT_FALSE(mesh.decomposed);
  EXPECT_EQ(share.elements, elements);
  EXPECT_EQ(share.nodes, nodes);
  EXPECT_EQ(share.values_per_element, 0);
  ASSERT_EQ(std::ssize(share.element), elements);
  ASSERT_EQ(std::ssize(share.node), nodes);
  for (std::size_t e = 0; e < share.element.size(); ++e)
    EXPECT_EQ(share.element[e], static_cast<GlobalId>(e));
  for (std::size_t n = 0; n < share.node.size(); ++n) EXPECT_EQ(share.node[n], static_cast<GlobalId>(n));
}

// All corners of all faces of a set.
void expect_on(const InputMesh& mesh, const InputMesh::SideSet& set,
               const std::function<bool(const Vec3&)>& is_there) {
  EXPECT_EQ(set.element.size(), set.face.size());
  for (std::size_t i = 0; i < set.element.size(); ++i)
    for (const int c : kFaces[static_cast<std::size_t>(set.face[i])])
      EXPECT_TRUE(is_there(
          corners_of(mesh.share, static_cast<std::size_t>(set.element[i]))[static_cast<std::size_t>(c)]));
}

TEST(Pamgen, RectilinearBlocks) {
  const InputMesh mesh = mesh_of(kRectilinear);
  expect_numbered(mesh, 8 * 5 * 12, 9 * 6 * 13);
  ASSERT_EQ(mesh.blocks.size(), 4U);
  for (std::size_t b = 0; b < 4; ++b)
    EXPECT_EQ(mesh.blocks[b], (InputMesh::Block{static_cast<std::int64_t>(b) + 1, ""}));
  EXPECT_NEAR(volume(mesh), 1.0 * 1.9 * 3.0, 1e-12);
  for (std::int32_t b = 0; b < 4; ++b) EXPECT_NEAR(volume(mesh, b), 1.0 * 1.9 * 3.0 / 4, 1e-12);
}

TEST(Pamgen, SetsAreOnTheirSides) {
  const InputMesh mesh = mesh_of(kRectilinear);
  ASSERT_EQ(mesh.side_sets.size(), 2U);
  EXPECT_EQ(mesh.side_sets[0].id, 10);
  EXPECT_EQ(mesh.side_sets[0].element.size(), 5U * 12);
  expect_on(mesh, mesh.side_sets[0], [](const Vec3& p) { return p.x == 1; });
  EXPECT_EQ(mesh.side_sets[1].id, 30);  // of block 1 alone, whose end in x is in the middle
  EXPECT_EQ(mesh.side_sets[1].element.size(), 5U * 6);
  expect_on(mesh, mesh.side_sets[1], [](const Vec3& p) { return p.x == 0.5 && p.z <= 1.5; });
  ASSERT_EQ(mesh.node_sets.size(), 1U);
  EXPECT_EQ(mesh.node_sets[0].id, 20);
  EXPECT_EQ(mesh.node_sets[0].node.size(), 9U * 13);
  for (const GlobalId n : mesh.node_sets[0].node)
    EXPECT_EQ(mesh.share.position[static_cast<std::size_t>(n)].y, 0.1);
}

TEST(Pamgen, GradedBrick) {
  const InputMesh mesh = mesh_of(kBrick);
  EXPECT_EQ(mesh.blocks.size(), 2U);
  EXPECT_NEAR(volume(mesh, 0), 1, 1e-12);
  EXPECT_NEAR(volume(mesh, 1), 2, 1e-12);
}

TEST(Pamgen, CylinderWithoutAnAxis) {
  const InputMesh mesh = mesh_of(kCylinder);
  EXPECT_EQ(mesh.blocks.size(), 2U);
  constexpr double kPi = 3.14159265358979323846;
  const double polygon = 12 * std::sin(2 * kPi / 24);  // area of the regular 24-gon in the unit circle
  EXPECT_NEAR(volume(mesh), 9 * polygon * 2, 1e-9);
  for (std::size_t e = 0; e < mesh.share.element.size(); ++e)
    EXPECT_GT(scaled_jacobian(corners_of(mesh.share, e)), 0.3);
  EXPECT_EQ(outer_faces(mesh), 24 * 6 + 2 * mesh.share.elements / 6);  // no seam where the turn is full
  ASSERT_EQ(mesh.side_sets.size(), 1U);
  EXPECT_EQ(mesh.side_sets[0].element.size(), 24U * 6);
  expect_on(mesh, mesh.side_sets[0],
            [](const Vec3& p) { return std::fabs(std::hypot(p.x, p.y) - 3) < 1e-12; });
}

TEST(Pamgen, SectionOfASphere) {
  const InputMesh mesh = mesh_of(kSphere);
  expect_numbered(mesh, 6 * 8 * 8, 7 * 9 * 9);
  ASSERT_EQ(mesh.side_sets.size(), 1U);
  EXPECT_EQ(mesh.side_sets[0].element.size(), 64U);
  expect_on(mesh, mesh.side_sets[0], [](const Vec3& p) { return std::fabs(norm(p) - 1) < 1e-12; });
}

TEST(Pamgen, UserDefinedTransformation) {
  const InputMesh mesh = mesh_of(kTransformed);
  EXPECT_EQ(mesh.share.elements, 64);
  EXPECT_NEAR(volume(mesh), 2, 1e-12);  // sheared and stretched
}

std::string error_of(const std::string& text) {
  const TemporaryFile file(text);
  try {
    (void)read_pamgen(Comm::self(), file.path(), Log());
  } catch (const AgreedError& e) {
    std::string message = e.what();
    const auto name = message.find(file.path());
    return name == std::string::npos ? message : message.replace(name, file.path().size(), "FILE");
  }
  return "";
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(PamgenErrors, NameTheLine) {
  EXPECT_EQ(error_of(changed(kRectilinear, "gmin", "gmn")),
            "input_mesh_pamgen: 'FILE': line 9: Unknown identifier in this context: GMN");
  EXPECT_EQ(error_of(changed(kRectilinear, "sideset, ihi", "sideset, qhi")),
            "input_mesh_pamgen: 'FILE': line 13: Inappropriate token in sidesets:QHI");
  EXPECT_TRUE(
      error_of(changed(kRectilinear, "rectilinear", "rectiliner"))
          .starts_with("input_mesh_pamgen: 'FILE': line 2: incorrect keyword, expected a geometry type "
                       "(CYLINDRICAL"))
      << error_of(changed(kRectilinear, "rectilinear", "rectiliner"));
}

TEST(PamgenErrors, AreInPamgensWords) {
  EXPECT_EQ(
      error_of(changed(kRectilinear, "gmax = 1.0", "gmax = -1.0")),
      "input_mesh_pamgen: 'FILE': Invalid span for 'X' range of inline mesh specification. The span must "
      "be positive");
  EXPECT_NE(error_of(changed(kRectilinear, "ihi, 30, 1", "ihi, 30, 7")).find("block index 7 is outside"),
            std::string::npos);
  EXPECT_NE(error_of(changed(kRectilinear, "nx = 4", "nx = 0")).find("Inline_Mesh_Desc::Decompose"),
            std::string::npos);
  EXPECT_NE(error_of(changed(kRectilinear, "nx = 4", "nx = 1000000000"))
                .find("120000000000 elements requested, max 2147483647 elements permitted. Terminating"),
            std::string::npos)
      << error_of(changed(kRectilinear, "nx = 4", "nx = 1000000000"));
}

// Pamgen ends the process at these.
TEST(PamgenErrors, SurviveItsCrashes) {
  const std::string crash = "input_mesh_pamgen: 'FILE': Pamgen crashes on it; expected 'mesh'";
  const std::string text = kRectilinear;
  EXPECT_TRUE(error_of(text.substr(0, text.rfind("end"))).starts_with(crash));
  EXPECT_TRUE(error_of(changed(text, "sideset, ihi", "sideset, ")).starts_with(crash));
  EXPECT_TRUE(
      error_of("mesh\n set assign\n sideset, ihi, 3\n end\nend\n").starts_with("input_mesh_pamgen: "));
}

TEST(PamgenErrors, NothingThere) {
  EXPECT_EQ(error_of("$ only a comment\n\n# and another\n"), "input_mesh_pamgen: 'FILE' has no description");
  EXPECT_EQ(error_of(""), "input_mesh_pamgen: 'FILE' is empty");
  try {
    (void)read_pamgen(Comm::self(), "no/such.pamgen", Log());
    FAIL();
  } catch (const AgreedError& e) {
    EXPECT_STREQ(e.what(), "input_mesh_pamgen: cannot open 'no/such.pamgen': No such file or directory");
  }
}

TEST(PamgenErrors, CollapsedHexes) {
  const std::string text = error_of(changed(kSphere, "gmin = 0.5 45.0 -45.0", "gmin = 0.5 0.0 -45.0"));
  EXPECT_TRUE(text.starts_with("'FILE': 48 inverted or degenerate hexes")) << text;
}

TEST(PamgenErrors, DoNotDisturbTheNextMesh) {
  EXPECT_NE(error_of(changed(kRectilinear, "gmax", "gmx")), "");
  expect_numbered(mesh_of(kRectilinear), 480, 702);
}

TEST(PamgenComplaint, Lines) {
  EXPECT_EQ(first_complaint("    1: mesh\n    2: end\n"), "");
  EXPECT_EQ(first_complaint("    1: mesh\n    2:  nx = 3:\n\n***** ERROR Parsing: odd \n\n    3: "),
            "line 2: odd");
  // Earlier descriptions are repeated too.
  EXPECT_EQ(first_complaint("    1: a\n    2:     1: a\n    2: b\n    3: \n***** ERROR Parsing: c\n"),
            "line 3: c");
  EXPECT_EQ(first_complaint("    1: a\n***** ERROR Parsing: b \nexpected c\n    2: d"),
            "line 1: b, expected c");
  EXPECT_EQ(first_complaint("    1: a\n***** ERROR Parsing: b\nSelect from:\n  c\n***** ERROR Parsing: d"),
            "line 1: b");
}

}  // namespace
}  // namespace sculpt
