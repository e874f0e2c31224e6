// Periodic meshes as the files show them: sides that match to the last bit, whatever the number of ranks.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "cases.hpp"
#include "scratch.hpp"

namespace sculpt::cli {
namespace {

using Point = std::array<double, 3>;
using FaceNodes = std::array<std::int32_t, 4>;

Point point(const RankMesh& mesh, std::size_t n) { return {mesh.x[n], mesh.y[n], mesh.z[n]}; }

// Faces of one hex only, their nodes ascending.
std::set<FaceNodes> boundary(const RankMesh& mesh) {
  constexpr int kSides[6][4] = {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6},
                                {0, 4, 7, 3}, {0, 3, 2, 1}, {4, 5, 6, 7}};
  std::map<FaceNodes, int> seen;
  for (const auto& block : mesh.blocks)
    for (std::size_t h = 0; h < block.nodes.size(); h += 8)
      for (const auto& side : kSides) {
        FaceNodes face;
        for (std::size_t v = 0; v < 4; ++v) face[v] = block.nodes[h + static_cast<std::size_t>(side[v])] - 1;
        std::sort(face.begin(), face.end());
        ++seen[face];
      }
  std::set<FaceNodes> single;
  for (const auto& [face, hexes] : seen) {
    EXPECT_LE(hexes, 2);
    if (hexes == 1) single.insert(face);
  }
  return single;
}

// What the sides of a mesh have in common with each other.
struct Match {
  std::array<std::int64_t, 3> faces{0, 0, 0};  // pairs per axis
  std::int64_t across_edges = 0;               // pairs that are a period apart in more than one axis
  std::int64_t left = 0;                       // boundary faces without a partner
};

// The node of each node one step away, to the last bit; -1 = none.
std::vector<std::int32_t> partners(const RankMesh& mesh, const Point& period,
                                   const std::array<int, 3>& step) {
  std::vector<std::int32_t> partner(mesh.x.size(), -1);
  std::map<Point, std::int32_t> places;
  for (std::size_t n = 0; n < mesh.x.size(); ++n) {
    Point p = point(mesh, n);
    for (std::size_t d = 0; d < 3; ++d)
      if (step[d] < 0) p[d] += period[d];
    places[p] = static_cast<std::int32_t>(n);
  }
  for (std::size_t n = 0; n < mesh.x.size(); ++n) {
    Point p = point(mesh, n);
    for (std::size_t d = 0; d < 3; ++d)
      if (step[d] > 0) p[d] += period[d];
    if (const auto found = places.find(p); found != places.end()) partner[n] = found->second;
  }
  return partner;
}

Match match_sides(const RankMesh& mesh, const Point& period) {
  std::set<FaceNodes> faces = boundary(mesh);
  Match match;
  std::vector<std::array<int, 3>> steps{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  // then those across edges
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      for (int k = -1; k <= 1; ++k)
        if (i * i + j * j + k * k > 1) steps.push_back({i, j, k});
  for (const auto& step : steps) {
    bool periodic = true;
    for (std::size_t d = 0; d < 3; ++d) periodic = periodic && (step[d] == 0 || period[d] != 0);
    if (!periodic) continue;
    const std::vector<std::int32_t> partner = partners(mesh, period, step);
    for (const FaceNodes& face : boundary(mesh)) {
      FaceNodes other;
      for (std::size_t v = 0; v < 4; ++v) other[v] = partner[static_cast<std::size_t>(face[v])];
      std::sort(other.begin(), other.end());
      if (other[0] < 0 || !faces.contains(face) || !faces.contains(other)) continue;
      faces.erase(face);
      faces.erase(other);
      const auto axis = static_cast<std::size_t>(std::find(step.begin(), step.end(), 1) - step.begin());
      ++(step[0] * step[0] + step[1] * step[1] + step[2] * step[2] == 1 ? match.faces[axis]
                                                                        : match.across_edges);
    }
  }
  match.left = static_cast<std::int64_t>(faces.size());
  return match;
}

const std::string kSixSets = "periodic_nodesets = 11 12 21 22 31 32\n";

class Periodic : public Scratch {
 protected:
  // Meshes on several ranks and compares; the mesh of one rank.
  RankMesh same_mesh(const std::string& deck) {
    const RankMesh alone = mesh(deck, 1);
    first_console_ = console();
    for (const int n : {2, 3, 5, 8}) EXPECT_TRUE(mesh(deck, n) == alone) << n << " ranks";
    return alone;
  }
  // Grain centres of a torus: cells of a periodic Voronoi diagram.
  static Voxels torus_grains(int nx, int ny, int nz, int count) {
    return {nx, ny, nz, [=](int i, int j, int k) {
              int best = 0;
              double least = 1e9;
              for (int g = 0; g < count; ++g) {
                double square = 0;
                const int n[3] = {nx, ny, nz}, at[3] = {i, j, k}, scatter[3] = {7919, 104729, 1299709};
                for (int d = 0; d < 3; ++d) {
                  const double c = (g + 1) * scatter[d] % 1009 / 1009.0 * n[d];
                  const double off = std::abs(at[d] + 0.5 - c), wrapped = std::min(off, n[d] - off);
                  square += wrapped * wrapped;
                }
                if (square < least) {
                  least = square;
                  best = g;
                }
              }
              return best + 1;
            }};
  }
  std::string grain_deck(int nx, int ny, int nz, int count, const std::string& more) const {
    const Voxels voxels = torus_grains(nx, ny, nz, count);
    write("v.spn", spn_text(voxels));
    return spn_deck(voxels, "v.spn") + "periodic = true\n" + more;
  }
  // Two spheres that cross sides of the box [0,2.7] x [-1,1] x [0.3,2.3], one at a corner, repeated where
  // they must be.
  std::string sphere_deck(const std::string& more, bool repeated = true,
                          const std::string& cells = "nelx = 13\nnely = 10\nnelz = 11\n") const {
    std::string text = "diatom\n package 'p'\n material 1\n";
    const double spheres[2][4] = {{0.1, -0.9, 0.25, 0.6}, {1.4, 0.1, 2.2, 0.55}};
    for (const auto& s : spheres)
      for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j)
          for (int k = -1; k <= 1; ++k) {
            if (!repeated && (i != 0 || j != 0 || k != 0)) continue;
            text += "  insert sphere\n   center = " + std::to_string(s[0] + 2.7 * i) + " " +
                    std::to_string(s[1] + 2 * j) + " " + std::to_string(s[2] + 2 * k) +
                    "\n   radius = " + std::to_string(s[3]) + "\n  endinsert\n";
          }
    write("s.diatom", text + " endpackage\nenddiatom\n");
    return "diatom_file = s.diatom\n" + cells + "xmin = 0\nymin = -1\nzmin = 0.3\n" +
           "xmax = 2.7\nymax = 1\nzmax = 2.3\nperiodic = true\n" + more;
  }
  static constexpr Point kSpherePeriod{2.7, 2, 2.3 - 0.3};
  [[nodiscard]] const std::string& first_console() const { return first_console_; }

 private:
  std::string first_console_;
};

TEST_F(Periodic, SidesMatchToTheLastBit) {
  const RankMesh mesh = same_mesh(grain_deck(9, 8, 7, 9, kSixSets + "gen_sidesets = rve\n"));
  const Match match = match_sides(mesh, {9, 8, 7});
  EXPECT_EQ(match.left, 0);
  for (const std::int64_t faces : match.faces) EXPECT_GT(faces, 40);
  EXPECT_LT(match.across_edges, match.faces[0] / 4);
  // The sides are ragged, and belong to side sets of which opposite ones have as many faces.
  EXPECT_LT(*std::min_element(mesh.x.begin(), mesh.x.end()), -0.05);
  ASSERT_EQ(mesh.side_sets.size(), 6U);
  std::size_t faces = 0;
  for (std::size_t s = 0; s < 6; ++s) {
    EXPECT_EQ(mesh.side_sets[s].element.size(), mesh.side_sets[s ^ 1].element.size());
    faces += mesh.side_sets[s].element.size();
  }
  EXPECT_EQ(faces, boundary(mesh).size());
  EXPECT_GE(summary(first_console(), "Min Quality"), 0.3);
}

TEST_F(Periodic, NodeSetsAreInMatchingOrder) {
  const RankMesh mesh = same_mesh(grain_deck(6, 7, 5, 6, kSixSets));
  ASSERT_EQ(mesh.node_sets.size(), 6U);
  for (std::size_t d = 0; d < 3; ++d) {
    const auto &low = mesh.node_sets[2 * d], &high = mesh.node_sets[2 * d + 1];
    EXPECT_EQ(low.id, static_cast<std::int64_t>(10 * (d + 1) + 1));
    EXPECT_EQ(high.id, static_cast<std::int64_t>(10 * (d + 1) + 2));
    ASSERT_EQ(low.node.size(), high.node.size());
    EXPECT_GT(low.node.size(), 30U);
    for (std::size_t i = 0; i < low.node.size(); ++i) {
      Point p = point(mesh, static_cast<std::size_t>(low.node[i]) - 1);
      p[d] += Point{6, 7, 5}[d];
      EXPECT_EQ(p, point(mesh, static_cast<std::size_t>(high.node[i]) - 1));
    }
  }
  EXPECT_EQ(summary(first_console(), "Num Nodesets"), 6);
}

TEST_F(Periodic, Spheres) {
  const RankMesh mesh = same_mesh(sphere_deck(kSixSets + "mesh_void = true\n"));
  EXPECT_EQ(match_sides(mesh, kSpherePeriod).left, 0);
  EXPECT_NE(first_console().find("check_periodic: volume fractions one period apart differ by at most"),
            std::string::npos);
  EXPECT_GE(summary(first_console(), "Min Quality"), 0.3);
}

// Refined cells and their transitions cross the sides.
TEST_F(Periodic, RefinedSpheres) {
  const std::string even = "nelx = 6\nnely = 4\nnelz = 4\n";
  for (const char* levels : {"1", "2"}) {
    const RankMesh mesh = same_mesh(sphere_deck(
        kSixSets + "mesh_void = true\nadapt_type = vfrac_average\nadapt_levels = " + levels + "\n", true,
        even));
    EXPECT_EQ(match_sides(mesh, kSpherePeriod).left, 0);
    EXPECT_GE(summary(first_console(), "Min Quality"), 0.3);
    for (std::size_t d = 0; d < 3; ++d)
      EXPECT_EQ(mesh.node_sets[2 * d].node.size(), mesh.node_sets[2 * d + 1].node.size());
  }
  EXPECT_NE(first_console().find("in transition to level 2"), std::string::npos);
  const std::string thin = "nelx = 6\nnely = 2\nnelz = 2\n";
  const RankMesh narrow = same_mesh(sphere_deck(
      "mesh_void = true\nadapt_type = vfrac_average\nadapt_levels = 2\nadapt_load_balance = true\n", true,
      thin));
  EXPECT_EQ(match_sides(narrow, kSpherePeriod).left, 0);
}

// Two cells in a direction: every node has the same neighbour on both sides.
TEST_F(Periodic, RefinedThinGrid) {
  const Voxels stripes{2, 16, 16, [](int, int j, int k) { return j < 4 ? 1 : k < 12 ? 2 : 3; }};
  write("v.spn", spn_text(stripes));
  const RankMesh mesh = same_mesh(spn_deck(stripes, "v.spn") +
                                  "periodic = true\nperiodic_directions = x\nadapt_type = vfrac_average\n"
                                  "adapt_levels = 1\n");
  EXPECT_GT(match_sides(mesh, {2, 0, 0}).faces[0], 100);
  EXPECT_NE(first_console().find("in transition to level 1"), std::string::npos);
}

// What is near a material counts on both sides of an end.
TEST_F(Periodic, DistancesReachAcrossTheSides) {
  const auto refined = [&](double x) {
    write("s.diatom", "diatom\n package 'p'\n material 1\n  insert sphere\n   center = " + std::to_string(x) +
                          " 8 8\n   radius = 0.9\n  endinsert\n endpackage\nenddiatom\n");
    (void)same_mesh(
        "diatom_file = s.diatom\nnelx = 16\nnely = 16\nnelz = 16\nxmin = 0\nymin = 0\nzmin = 0\nxmax = 16\n"
        "ymax = 16\nzmax = 16\nperiodic = true\nmesh_void = true\nadapt_type = material\n"
        "adapt_material = 1 1 0.0001 3\n");
    const std::size_t at = first_console().find("adapting the grid: ");
    return std::stod(first_console().substr(at + 19));
  };
  const double at_the_end = refined(1);
  EXPECT_GT(at_the_end, 20);
  EXPECT_EQ(at_the_end, refined(9));
}

TEST_F(Periodic, CoarsenedAndRefinedGrains) {
  const RankMesh coarse = same_mesh(grain_deck(16, 8, 16, 5, "adapt_type = coarsen\nadapt_levels = 2\n"));
  EXPECT_EQ(match_sides(coarse, {16, 8, 16}).left, 0);
  EXPECT_GE(summary(first_console(), "Min Quality"), 0.3);
  const RankMesh fine = same_mesh(grain_deck(
      6, 4, 7, 3,
      "periodic_directions = xy\nadapt_type = vfrac_average\nadapt_levels = 1\ngen_sidesets = rve\n"));
  EXPECT_EQ(match_sides(fine, {6, 4, 0}).faces[0] > 0, true);
  same_mesh(grain_deck(16, 8, 16, 5, "adapt_type = resample\nadapt_levels = 1\n"));
}

// Without the void the spheres end where they end; what crosses a side still matches.
TEST_F(Periodic, SpheresAlone) {
  const RankMesh mesh = same_mesh(sphere_deck("gen_sidesets = rve\nsmooth = to_geometry\n"));
  const Match match = match_sides(mesh, kSpherePeriod);
  EXPECT_GT(match.left, 0);
  ASSERT_EQ(mesh.side_sets.size(), 6U);
  for (std::size_t s = 0; s < 6; ++s)
    EXPECT_GE(static_cast<std::int64_t>(mesh.side_sets[s].element.size()), match.faces[s / 2]);
}

TEST_F(Periodic, OneDirectionOnly) {
  const RankMesh mesh = same_mesh(
      grain_deck(8, 7, 6, 8, "periodic_directions = y\nperiodic_nodesets = 5 6\ngen_sidesets = fixed\n"));
  const Match match = match_sides(mesh, {0, 7, 0});
  EXPECT_GT(match.faces[1], 40);
  EXPECT_EQ(mesh.node_sets.size(), 2U);
  for (const std::vector<double>* flat : {&mesh.x, &mesh.z}) {
    EXPECT_EQ(*std::min_element(flat->begin(), flat->end()), 0);
    EXPECT_EQ(*std::max_element(flat->begin(), flat->end()), flat == &mesh.x ? 8 : 6);
  }
  EXPECT_LT(*std::min_element(mesh.y.begin(), mesh.y.end()), 0);
}

TEST_F(Periodic, ThinGrids) {
  for (const int n : {2, 3}) {
    const RankMesh mesh = same_mesh(grain_deck(7, 6, n, 5, "defeature = 3\n"));
    EXPECT_EQ(match_sides(mesh, {7, 6, static_cast<double>(n)}).left, 0);
  }
  EXPECT_EQ(match_sides(same_mesh(grain_deck(2, 2, 2, 3, "")), {2, 2, 2}).left, 0);
}

TEST_F(Periodic, Layers) {
  const RankMesh mesh = same_mesh(
      grain_deck(7, 6, 5, 6, "pillow_surfaces = true\npillow_curves = true\npillow_curve_thresh = 0.6\n"));
  EXPECT_EQ(match_sides(mesh, {7, 6, 5}).left, 0);
  same_mesh(grain_deck(7, 6, 5, 6,
                       "periodic_directions = xz\npillow_boundary_layers = 2\ngen_sidesets = variable\n"));
}

TEST_F(Periodic, Stairs) {
  const RankMesh mesh = same_mesh(grain_deck(6, 5, 4, 5, "stair = full\n" + kSixSets));
  EXPECT_EQ(hexes_of(mesh), 120);
  EXPECT_EQ(mesh.x.size(), 7U * 6U * 5U);
  EXPECT_EQ(match_sides(mesh, {6, 5, 4}).left, 0);
}

// The period is scaled like everything else.
TEST_F(Periodic, Transformed) {
  const RankMesh mesh = same_mesh(grain_deck(6, 5, 4, 5, "scale = 0.1\nxtranslate = 1000.3\nyscale = 3.7\n"));
  EXPECT_EQ(match_sides(mesh, {6 * 0.1, 5 * (0.1 * 3.7), 4 * 0.1}).left, 0);
}

TEST_F(Periodic, RemovedHexes) { same_mesh(grain_deck(7, 6, 5, 6, "remove_bad = 0.6\n" + kSixSets)); }

class PeriodicErrors : public Periodic {
 protected:
  // What the program says on these ranks about a deck that it refuses.
  std::string complaint(const std::string& deck, int ranks) {
    write("bad.i", "BEGIN SCULPT\nexodus_file = bad\n" + deck + "END SCULPT\n");
    const RunResult result = run({"sculpt", "-i", "bad.i", "-j", std::to_string(ranks)});
    EXPECT_EQ(result.status, 2);
    return result.error;
  }
};

TEST_F(PeriodicErrors, GeometryThatIsNotPeriodic) {
  const std::string alone = complaint(sphere_deck("", false), 1);
  EXPECT_NE(alone.find("check_periodic: the geometry is not periodic in "), std::string::npos) << alone;
  EXPECT_NE(alone.find("go on with check_periodic = false"), std::string::npos) << alone;
  EXPECT_EQ(complaint(sphere_deck("", false), 5), alone);
  const std::string deck = sphere_deck("check_periodic = false\nmesh_void = true\n", false);
  EXPECT_EQ(match_sides(mesh(deck, 2), kSpherePeriod).left, 0) << "periodic all the same";
  EXPECT_GT(hexes_of(mesh(sphere_deck("check_periodic_tol = 1\n", false), 1)), 0);
}

TEST_F(PeriodicErrors, OneCellOnAnAxis) {
  EXPECT_NE(complaint(grain_deck(5, 4, 1, 3, ""), 3).find("periodic: the grid has 1 cell in z"),
            std::string::npos);
  same_mesh(grain_deck(5, 4, 1, 3, "periodic_directions = xy\n"));
}

// Cells are refined in pairs.
TEST_F(PeriodicErrors, OddGridsCannotBeRefined) {
  const std::string told = complaint(sphere_deck("adapt_type = vfrac_average\n"), 3);
  EXPECT_NE(told.find("periodic: a refined grid needs an even number of cells along x, found 13"),
            std::string::npos)
      << told;
  EXPECT_NE(complaint(grain_deck(16, 12, 16, 5, "adapt_type = coarsen\nadapt_levels = 2\n"), 1)
                .find("even number of cells along y, found 3 coarse ones"),
            std::string::npos);
}

TEST_F(PeriodicErrors, OptionsThatDoNotFit) {
  EXPECT_NE(complaint(grain_deck(5, 4, 3, 3, "micro_expand = 1\n"), 1).find("micro_expand puts cells around"),
            std::string::npos);
  EXPECT_NE(complaint(grain_deck(5, 4, 3, 3, "periodic_nodesets = 1 2 3 4\n"), 1)
                .find("periodic_nodesets needs two ids for each periodic direction"),
            std::string::npos);
  EXPECT_NE(complaint(grain_deck(5, 4, 3, 3, "pillow_boundary_layers = 1\n"), 1).find("has none"),
            std::string::npos);
  EXPECT_NE(complaint(grain_deck(5, 4, 3, 3, "periodic_axis = z\n"), 1).find("not supported yet"),
            std::string::npos);
  write("v.spn", spn_text(letter_f()));
  EXPECT_NE(
      complaint(spn_deck(letter_f(), "v.spn") + "periodic_directions = x\n", 1).find("need periodic = true"),
      std::string::npos);
}

}  // namespace
}  // namespace sculpt::cli
