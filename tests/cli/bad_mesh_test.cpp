// What a user can get wrong with an input mesh: on one rank and on four the same clear message, and no file.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

#include "bad_input.hpp"
#include "input_meshes.hpp"
#include "support/faulty_meshes.hpp"

namespace sculpt::cli {
namespace {

using test::ExodusMesh;

// A cylinder of 36 hexes in two blocks, 3 and 7, with fractions of two materials.
ExodusMesh good_mesh() {
  ExodusMesh mesh = exodus_mesh("cylinder", {"--n", "2", "--layers", "3", "--grains", "2", "m.g"});
  mesh.blocks.push_back({7, "upper", {}});
  mesh.blocks[0].id = 3;
  auto& all = mesh.blocks[0].nodes;
  mesh.blocks[1].nodes.assign(all.begin() + 24 * 8, all.end());
  all.resize(24 * 8);
  for (auto& v : mesh.variables) v.in_block.push_back(1);
  return mesh;
}

void write_mesh_deck(BadInput& t, const ExodusMesh& mesh, const std::string& more = "") {
  test::write_exodus_mesh(t.path("m.g"), mesh);
  t.write("deck.i", "BEGIN SCULPT\ninput_mesh = m.g\n" + more + "END SCULPT\n");
}

// The good mesh but for one change, and more lines of the deck.
Mistake mesh_mistake(const std::string& name, const std::function<void(ExodusMesh&)>& change,
                     const Words& expected, const std::string& more = "") {
  return {name,
          [=](BadInput& t) {
            ExodusMesh mesh = good_mesh();
            change(mesh);
            write_mesh_deck(t, mesh, more);
          },
          expected};
}
Mistake deck_mistake(const std::string& name, const std::string& more, const Words& expected) {
  return mesh_mistake(
      name, [](ExodusMesh&) {}, expected, more);
}

// Four of the eight nodes of each hex of a block.
void make_tets(ExodusMesh::Block& block) {
  ExodusMesh::Ints nodes;
  for (std::size_t n = 0; n < block.nodes.size(); n += 8)
    for (const std::size_t c : {0U, 1U, 3U, 4U}) nodes.push_back(block.nodes[n + c]);
  block.nodes = nodes;
  block.type = "TETRA4";
  block.nodes_per_element = 4;
}
void no_sets(ExodusMesh& m) {
  m.side_sets.clear();
  m.node_sets.clear();
}

std::vector<Mistake> element_mistakes() {
  return {
      mesh_mistake(
          "Tets",
          [](ExodusMesh& m) {
            no_sets(m);
            for (auto& block : m.blocks) make_tets(block);
          },
          {"'m.g'", "block 3, element 1", "found TETRA4 with 4 nodes", "expected HEX8 with 8 nodes"}),
      mesh_mistake(
          "MixedElements",
          [](ExodusMesh& m) {
            no_sets(m);
            make_tets(m.blocks[1]);
          },
          {"'m.g'", "block 7, element 25", "found TETRA4 with 4 nodes", "expected HEX8 with 8 nodes"}),
      mesh_mistake("InvertedHex",
                   [](ExodusMesh& m) {
                     auto& nodes = m.blocks[1].nodes;
                     std::swap_ranges(nodes.begin() + 16, nodes.begin() + 20, nodes.begin() + 20);
                   },
                   {"'m.g'", "1 inverted or degenerate hexes", "element 27 of block 7 at (", "determinant -",
                    "expected more than 0"}),
      mesh_mistake("NodeTwice",
                   [](ExodusMesh& m) { m.blocks[0].nodes[8 * 4 + 1] = m.blocks[0].nodes[8 * 4]; },
                   {"'m.g'", "element 5 of block 3", "two corners", "expected eight different nodes"}),
      mesh_mistake(
          "CollapsedHex",
          [](ExodusMesh& m) {
            const auto& nodes = m.blocks[0].nodes;
            const auto a = static_cast<std::size_t>(nodes[0] - 1), b = static_cast<std::size_t>(nodes[1] - 1);
            m.x[b] = m.x[a];
            m.y[b] = m.y[a];
          },
          {"'m.g'", "inverted or degenerate hexes, the first: element 1 of block 3 at (", "determinant 0,"}),
      mesh_mistake("NodeAtNoPlace", [](ExodusMesh& m) { m.y[10] = std::numeric_limits<double>::quiet_NaN(); },
                   {"'m.g'", "node 11 is at (", "nan", "expected finite coordinates"}),
      mesh_mistake("NodeBeyondTheLast", [](ExodusMesh& m) { m.blocks[1].nodes[0] = 1000; },
                   {"'m.g'", "block 7", "entry 1", "node 1000 does not exist", "expected 1 to"}),
      mesh_mistake("NoElements",
                   [](ExodusMesh& m) {
                     no_sets(m);
                     m.blocks.clear();
                     m.variables.clear();
                   },
                   {"'m.g' has no elements"}),
      mesh_mistake(
          "SideBeyondTheLast", [](ExodusMesh& m) { m.side_sets[1].element[2] = 37; },
          {"'m.g'", "side set 2", "entry 3", "element 37 does not exist", "expected 1 to 36"},
          "gen_sidesets = input_mesh\n"),
  };
}

// Meshes that do not fit together, with the messages of the tests of check_conformity.
std::vector<Mistake> conformity_mistakes() {
  std::vector<Mistake> mistakes;
  const std::map<std::string, std::string> names{{"a face of three", "FaceOfThree"},
                                                 {"not merged", "NotMerged"},
                                                 {"hardly apart", "HardlyApart"},
                                                 {"hanging", "HangingNode"},
                                                 {"three nodes of a face", "ThreeNodesOfAFace"}};
  for (const test::FaultyMesh& faulty : test::faulty_meshes()) {
    const auto name = names.find(faulty.mesh.name);
    if (name == names.end()) continue;
    mistakes.push_back({name->second,
                        [mesh = faulty.mesh](BadInput& t) {
                          ExodusMesh m;
                          for (const Vec3& p : mesh.position) {
                            m.x.push_back(p.x);
                            m.y.push_back(p.y);
                            m.z.push_back(p.z);
                          }
                          m.blocks = {{10, "", {}}, {20, "", {}}};
                          for (std::size_t e = 0; e < mesh.corner.size(); ++e)
                            for (const GlobalId n : mesh.corner[e])
                              m.blocks[static_cast<std::size_t>(mesh.block[e])].nodes.push_back(n + 1);
                          t.write("s.diatom", two_spheres());
                          write_mesh_deck(t, m, "diatom_file = s.diatom\n");
                        },
                        {faulty.message}});
  }
  return mistakes;
}

void set_value(ExodusMesh& m, std::size_t variable, std::size_t element, double value) {
  m.variables[variable].steps[0][element] = value;
}

std::vector<Mistake> material_mistakes() {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const auto values = [](const std::string& name, double a, double b, const Words& expected) {
    return mesh_mistake(
        name,
        [=](ExodusMesh& m) {
          set_value(m, 0, 29, a);
          set_value(m, 1, 29, b);
        },
        expected);
  };
  return {
      values("FractionNegative", -0.5, 1.5, {"'m.g', element 30", "-0.5", "'vf_1'", "expected 0 to 1"}),
      values("FractionAboveOne", 0, 1.25, {"'m.g', element 30", "1.25", "'vf_2'", "expected 0 to 1"}),
      values("FractionsOfHalf", 0.25, 0.25, {"'m.g', element 30", "sum to 0.5", "expected 1"}),
      values("FractionNan", 0.5, kNan, {"'m.g', element 30", "nan", "'vf_2'", "expected 0 to 1"}),
      mesh_mistake("NoMaterials", [](ExodusMesh& m) { m.variables.clear(); },
                   {"no source of materials", "'m.g' has no element variables", "input_spn", "diatom_file"}),
      mesh_mistake("NoMaterialsInABlock", [](ExodusMesh& m) { m.variables[0].in_block[1] = 0; },
                   {"'m.g', element 2", "sum to", "expected 1"}),
      {"SpnOfAnotherSize",
       [](BadInput& t) {
         write_mesh_deck(t, good_mesh(), spn_deck({3, 5, 5, {}}, "v.spn"));
         t.write_voxels();
       },
       {"v.spn", "found 60 integers", "3 x 5 x 5 = 75"}},
  };
}

std::vector<Mistake> file_mistakes() {
  const auto with_file = [](const std::string& name, const std::function<void(BadInput&)>& spoil,
                            const Words& expected) {
    return Mistake{name,
                   [spoil](BadInput& t) {
                     write_mesh_deck(t, good_mesh());
                     spoil(t);
                   },
                   expected};
  };
  const auto pamgen = [](const std::string& name, const std::string& text, const Words& expected) {
    return Mistake{name,
                   [text](BadInput& t) {
                     t.write("s.diatom", two_spheres());
                     t.write("deck.i",
                             "BEGIN SCULPT\ninput_mesh_pamgen = m.pamgen\ndiatom_file = s.diatom\nEND "
                             "SCULPT\n");
                     if (text != "-") t.write("m.pamgen", text);
                   },
                   expected};
  };
  const std::string radial =
      "mesh\n  radial\n    numz 1\n      zblock 1 1.0 interval 2\n    numr 1\n      rblock 1 1.0 interval 2\n"
      "    numa 1\n      ablock 1 90.0 interval 4\n  end\nend\n";
  std::string misspelt = radial;
  misspelt.replace(misspelt.find("rblock"), 6, "rblok");
  return {
      with_file("MeshIsAFolder",
                [](BadInput& t) {
                  std::filesystem::remove(t.path("m.g"));
                  std::filesystem::create_directory(t.path("m.g"));
                },
                {"'m.g'"}),
      with_file("MeshTruncated",
                [](BadInput& t) {
                  std::filesystem::resize_file(t.path("m.g"), std::filesystem::file_size(t.path("m.g")) / 2);
                },
                {"'m.g'"}),
      with_file("MeshEmpty", [](BadInput& t) { t.write("m.g", ""); }, {"'m.g'"}),
      with_file("MeshIsText", [](BadInput& t) { t.write("m.g", "no Exodus\n"); }, {"'m.g'"}),
      pamgen("PamgenMissing", "-", {"input_mesh_pamgen", "m.pamgen", "No such file"}),
      pamgen("PamgenEmpty", "$ nothing\n", {"input_mesh_pamgen", "'m.pamgen' has no description"}),
      pamgen("PamgenMisspelt", misspelt, {"input_mesh_pamgen", "'m.pamgen'", "line 6"}),
      pamgen("PamgenCollapsed", radial, {"'m.pamgen'", "element 1", "block 1", "expected"}),
  };
}

std::vector<Mistake> option_mistakes() {
  const std::string none = "'m.g' is not a Cartesian grid";
  return {
      deck_mistake("BlockMissing", "input_mesh_blocks = 7 8\n",
                   {"'input_mesh_blocks' (line 3 of deck.i)", "'m.g' has no block 8", "only 3 7"}),
      deck_mistake("Refinement", "adapt_type = vfrac_average\n",
                   {"'adapt_type' (line 3 of deck.i)", none, "Cartesian grid"}),
      deck_mistake("Periodic", "periodic = true\n", {"'periodic' (line 3 of deck.i)", none}),
      deck_mistake("Expansion", "micro_expand = 1\n", {"'micro_expand' (line 3 of deck.i)", none}),
      deck_mistake("SidesOfABox", "gen_sidesets = rve\n",
                   {"'gen_sidesets' (line 3 of deck.i)", none, "variable"}),
      deck_mistake("TwoSources", "input_spn = v.spn\ndiatom_file = s.diatom\n",
                   {"only one input geometry", "line 3 of deck.i", "line 4 of deck.i"}),
      deck_mistake("MicroAsWell", "input_micro = f.tec\n",
                   {"input_mesh takes its materials from", "input_micro = f.tec (line 3 of deck.i)"}),
      deck_mistake("CartExoAsWell", "input_cart_exo = f.g\n",
                   {"input_mesh takes its materials from", "input_cart_exo = f.g (line 3 of deck.i)"}),
      deck_mistake("TwoMeshes", "input_mesh_pamgen = m.pamgen\n",
                   {"only one mesh", "input_mesh = m.g", "input_mesh_pamgen = m.pamgen (line 3 of deck.i)"}),
      deck_mistake(
          "SpnWithoutCounts", "input_spn = v.spn\nnely = 2\n",
          {"input_spn needs the number of cells", "nely = 2 (line 4 of deck.i)", "not given: nelx, nelz"}),
      {"BlocksWithoutMesh",
       [](BadInput& t) { t.write_deck("input_mesh_blocks = 1\n"); },
       {"input_mesh_blocks needs input_mesh or input_mesh_pamgen", "line 6 of deck.i"}},
      {"SetsWithoutMesh",
       [](BadInput& t) { t.write_deck("gen_sidesets = input_mesh\n"); },
       {"gen_sidesets = input_mesh", "line 6 of deck.i", "give input_mesh or input_mesh_pamgen"}},
      {"PamgenWithoutSource",
       [](BadInput& t) { t.write("deck.i", "BEGIN SCULPT\ninput_mesh_pamgen = m.pamgen\nEND SCULPT\n"); },
       {"input_mesh_pamgen has no element variables", "line 2 of deck.i"}},
  };
}

class BadMesh : public BadInput, public ::testing::WithParamInterface<Mistake> {};

TEST_P(BadMesh, IsRefusedAlike) {
  GetParam().prepare(*this);
  const std::string alone = expect_refused(1, GetParam().expected);
  EXPECT_EQ(expect_refused(4, GetParam().expected), alone);
}

const auto kName = [](const auto& info) { return info.param.name; };
INSTANTIATE_TEST_SUITE_P(Elements, BadMesh, ::testing::ValuesIn(element_mistakes()), kName);
INSTANTIATE_TEST_SUITE_P(Conformity, BadMesh, ::testing::ValuesIn(conformity_mistakes()), kName);
INSTANTIATE_TEST_SUITE_P(Materials, BadMesh, ::testing::ValuesIn(material_mistakes()), kName);
INSTANTIATE_TEST_SUITE_P(Files, BadMesh, ::testing::ValuesIn(file_mistakes()), kName);
INSTANTIATE_TEST_SUITE_P(Options, BadMesh, ::testing::ValuesIn(option_mistakes()), kName);

// The good mesh is one, and the decks are fine without the mistakes.
TEST_F(BadMesh, IsGoodWithoutTheMistake) {
  write_mesh_deck(*this, good_mesh());
  succeed({"sculpt", "-i", "deck.i", "-e", "out"});
}

class BadParts : public BadInput {
 protected:
  void write_good_parts(int ranks, int seed = 0) {
    const ExodusMesh mesh = good_mesh();
    write_mesh_deck(*this, mesh);
    write_parts(path("m.g"), mesh, ranks, [=](int e) { return (e + seed) * ranks / 36 % ranks; });
  }
};

TEST_F(BadParts, SomeAreMissing) {
  write_good_parts(4);
  std::filesystem::remove(path("m.g.4.2"));
  expect_refused(4, {"found 3 of the 4 parts of 'm.g'", "'m.g.4.2' is missing",
                     "expected 'm.g.4.0' to 'm.g.4.3'", "decomp -p 4 m.g"});
  succeed({"sculpt", "-i", "deck.i", "-e", "out"});  // the whole is there
}

TEST_F(BadParts, OfAnotherNumber) {
  write_good_parts(3);
  std::filesystem::remove(path("m.g"));
  const std::string found = "'m.g' does not exist; found parts of it for this many ranks: 3; expected ";
  expect_refused(1, {found, "the whole file on one rank"});
  expect_refused(4, {found, "'m.g.4.0' to 'm.g.4.3'", "decomp -p 4 m.g"});
}

TEST_F(BadParts, RenamedFromAnotherNumber) {
  write_good_parts(2);
  for (int r = 0; r < 4; ++r)
    std::filesystem::copy_file(path(fmt::format("m.g.2.{}", r % 2)), path(fmt::format("m.g.4.{}", r)));
  expect_refused(4,
                 {"'m.g.4.0' says that it is one of 2 parts", "expected one of 4 parts", "decomp -p 4 m.g"});
}

TEST_F(BadParts, OfTwoDecompositions) {
  write_good_parts(4);
  std::filesystem::copy_file(path("m.g.4.1"), path("saved"));
  write_good_parts(4, 3);
  std::filesystem::copy_file(path("saved"), path("m.g.4.1"),
                             std::filesystem::copy_options::overwrite_existing);
  expect_refused(4, {"'m.g'", "two decompositions", "decomp -p 4 m.g", "expected one"});
}

TEST_F(BadParts, OfTwoMeshes) {
  write_good_parts(4);
  ExodusMesh other = good_mesh();
  other.blocks[1].id = 9;
  write_parts(path("o.g"), other, 4, [](int e) { return e / 9; });
  std::filesystem::rename(path("o.g.4.3"), path("m.g.4.3"));
  expect_refused(4, {"'m.g.4.3' has blocks: 3 9, but the first part has blocks: 3 7"});
}

TEST_F(BadParts, OneIsTruncated) {
  write_good_parts(4);
  std::filesystem::resize_file(path("m.g.4.3"), 900);
  expect_refused(4, {"'m.g.4.3'"});
}

TEST_F(BadParts, NoneAndNoWhole) {
  write("deck.i", "BEGIN SCULPT\ninput_mesh = m.g\nEND SCULPT\n");
  const std::string found = "cannot open 'm.g': No such file or directory, and no parts of it; expected ";
  expect_refused(1, {found + "the whole file on one rank"});
  expect_refused(4, {found + "it, or 'm.g.4.0' to 'm.g.4.3', made by: decomp -p 4 m.g"});
}

TEST_F(BadParts, NamedInsteadOfTheWhole) {
  write_good_parts(4);
  write("deck.i", "BEGIN SCULPT\ninput_mesh = m.g.4.0\nEND SCULPT\n");
  for (const int ranks : {1, 4})
    expect_refused(ranks, {"'m.g.4.0' is one of 4 parts of a mesh", "expected the whole mesh"});
}

// Options that ask for nothing are taken, and the user is told.
class IdleOfMeshes : public BadInput {
 protected:
  std::string console(const std::string& deck) {
    write("s.diatom", two_spheres());
    write("deck.i", "BEGIN SCULPT\n" + deck + "END SCULPT\n");
    return succeed({"sculpt", "-i", "deck.i", "-e", "out"}).out;
  }
};

TEST_F(IdleOfMeshes, AreTold) {
  test::write_exodus_mesh(path("m.g"), good_mesh());
  const std::string grid = "nelx = 3\nnely = 5\nnelz = 4\n", box = "xmin = -50\nzmax = 50\n";
  const std::string shapes =
      console("input_mesh = m.g\ndiatom_file = s.diatom\nmesh_void = true\n" + grid + box);
  EXPECT_NE(shapes.find("WARNING: the input mesh is the grid; no effect: nelx, nely, nelz\n"),
            std::string::npos);
  EXPECT_NE(shapes.find("no effect: xmin, zmax\n"), std::string::npos);
  write_voxels();
  const std::string voxels = console("input_mesh = m.g\ninput_spn = v.spn\nmesh_void = true\n" + grid);
  EXPECT_EQ(voxels.find("WARNING: the input mesh"), std::string::npos);
  const std::string none = console(spn_deck(letter_f(), "v.spn") +
                                   "feature_angle = 100\nexterior_sliding = surface\n"
                                   "input_mesh_partition = rib\ninput_mesh_material = automatic\n");
  EXPECT_NE(none.find("WARNING: there is no input mesh; no effect: feature_angle, exterior_sliding, "
                      "input_mesh_partition, input_mesh_material\n"),
            std::string::npos);
}

}  // namespace
}  // namespace sculpt::cli
