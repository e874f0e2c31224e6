// What the program tells about its meshes: the quality file, the element variable, remove_bad, exit status.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include "cases.hpp"
#include "scratch.hpp"
#include "sculpt/exo/read_exodus.hpp"

namespace sculpt::cli {
namespace {

using Point = std::array<double, 3>;

struct Element {
  std::int64_t block;
  std::array<Point, 8> corner;
  double quality;
};

double determinant(const Point& o, const Point& a, const Point& b, const Point& c) {
  std::array<Point, 3> e{};
  for (std::size_t d = 0; d < 3; ++d) e[0][d] = a[d] - o[d], e[1][d] = b[d] - o[d], e[2][d] = c[d] - o[d];
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
         e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

double scaled_jacobian(const std::array<Point, 8>& p) {
  constexpr std::size_t kCorners[8][4] = {{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6}, {3, 0, 2, 7},
                                          {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3}};
  double least = 2;
  for (const auto& c : kCorners)
    least = std::min(least, determinant(p[c[0]], p[c[1]], p[c[2]], p[c[3]]) / distance(p[c[0]], p[c[1]]) /
                                distance(p[c[0]], p[c[2]]) / distance(p[c[0]], p[c[3]]));
  return least;
}

// The elements of a joined mesh, in the order of their numbers.
std::vector<Element> elements_of(const RankMesh& mesh) {
  std::vector<Element> all;
  for (const RankMesh::Block& block : mesh.blocks)
    for (std::size_t e = 0; e < block.nodes.size() / 8; ++e) {
      Element& out = all.emplace_back(Element{block.id, {}, 0});
      for (std::size_t c = 0; c < 8; ++c) {
        const auto n = static_cast<std::size_t>(block.nodes[8 * e + c]) - 1;
        out.corner[c] = {mesh.x[n], mesh.y[n], mesh.z[n]};
      }
      out.quality = scaled_jacobian(out.corner);
    }
  return all;
}

// Rows of a quality file in CSV: kind -> rows of cells, the header first. No cell of the tests has a comma.
using Tables = std::map<std::string, std::vector<Words>>;
Tables csv_tables(const std::string& text) {
  Tables tables;
  for (const std::string& line : lines_of(text)) {
    Words cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    const std::string kind = cells.front();
    cells.erase(cells.begin());
    tables[kind].push_back(cells);
  }
  return tables;
}

// A JSON text as "path.to.value" -> value; fails the test where the text is not JSON.
class Json {
 public:
  explicit Json(const std::string& text) : text_(text) {
    value("");
    skip();
    EXPECT_EQ(at_, text_.size()) << "text after the value";
  }
  [[nodiscard]] const std::map<std::string, std::string>& values() const { return values_; }
  [[nodiscard]] double number(const std::string& path) const {
    const auto found = values_.find(path);
    return found == values_.end() ? std::nan("") : std::stod(found->second);
  }

 private:
  void skip() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool take(char c) {
    skip();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  std::string string() {
    const std::size_t end = text_.find('"', at_);  // no string of the tests has a quote inside
    const std::string inside = text_.substr(at_, end - at_);
    at_ = end + 1;
    return inside;
  }
  void items(const std::string& path, char end, bool named) {
    if (take(end)) return;
    int index = 0;
    do {
      std::string name = std::to_string(index++);
      if (named) {
        EXPECT_TRUE(take('"'));
        name = string();
        EXPECT_TRUE(take(':'));
      }
      value(path.empty() ? name : path + "." + name);
    } while (take(',') && !HasFailure());
    EXPECT_TRUE(take(end)) << path;
  }
  void value(const std::string& path) {
    if (take('{')) return items(path, '}', true);
    if (take('[')) return items(path, ']', false);
    if (take('"')) {
      values_[path] = string();
      return;
    }
    skip();
    const std::size_t end = text_.find_first_of(",}] \n", at_);
    values_[path] = text_.substr(at_, end - at_);
    at_ = end;
    std::size_t used = 0;
    if (values_[path] != "null") (void)std::stod(values_[path], &used);
    EXPECT_TRUE(values_[path] == "null" || used == values_[path].size()) << path << ": " << values_[path];
  }
  static bool HasFailure() { return ::testing::Test::HasFailure(); }

  std::string text_;
  std::size_t at_ = 0;
  std::map<std::string, std::string> values_;
};

class Quality : public Scratch {
 protected:
  void write_deck(const std::string& more, const Voxels& voxels = grains(8, 6, 5)) const {
    write("v.spn", spn_text(voxels));
    write("deck.i", "BEGIN SCULPT\n" + spn_deck(voxels, "v.spn") + more + "END SCULPT\n");
  }
  // Runs the deck, joins its files and reads the result.
  [[nodiscard]] RankMesh made(int ranks, const Words& more = {}) const {
    const std::string n = std::to_string(ranks);
    Words words{"sculpt", "-qt", "-j", n, "-i", "deck.i", "-e", "m"};
    words.insert(words.end(), more.begin(), more.end());
    succeed(words);
    succeed({"eputool", "-p", n, "m"});
    return read_exodus(path("m.e"));
  }
  [[nodiscard]] Tables quality_tables(const std::string& file) const { return csv_tables(read(file)); }
};

// Everything in the file that can be measured again from the Exodus file is.
TEST_F(Quality, FileAgreesWithTheMesh) {
  write_deck("quality = q.csv\nscale = 3\nxtranslate = 7\nmaterial_name = 2 copper\n");
  const std::vector<Element> elements = elements_of(made(2));
  Tables tables = quality_tables("q.csv");

  std::map<std::string, double> summary;
  for (const Words& row : tables["summary"])
    if (row[0] != "name" && row[0] != "mesh") summary[row[0]] = std::stod(row[1]);
  const auto below = [&](double limit) {
    return static_cast<double>(std::count_if(elements.begin(), elements.end(),
                                             [limit](const Element& e) { return e.quality < limit; }));
  };
  double sum = 0, least = 2;
  for (const Element& e : elements) {
    sum += e.quality;
    least = std::min(least, e.quality);
  }
  EXPECT_EQ(summary["hexes"], static_cast<double>(elements.size()));
  EXPECT_NEAR(summary["scaled_jacobian_min"], least, 1e-12);
  EXPECT_NEAR(summary["scaled_jacobian_mean"], sum / summary["hexes"], 1e-9);
  EXPECT_EQ(summary["scaled_jacobian_below_0.5"], below(0.5));
  EXPECT_GT(below(0.5), 0) << "too good a mesh to test anything";
  EXPECT_NEAR(summary["mesh_volume"], 27 * 512, 1e-4);
  EXPECT_NEAR(summary["input_volume"], 27 * 512, 1e-4);
  EXPECT_NEAR(summary["shortest_edge"], 3 * summary["shortest_edge_cells"], 1e-12);

  ASSERT_EQ(tables["histogram"].size(), 21U);
  for (std::size_t b = 1; b <= 20; ++b)
    EXPECT_EQ(std::stod(tables["histogram"][b][2]),
              (b == 20 ? summary["hexes"] : below(std::stod(tables["histogram"][b][1]))) -
                  below(std::stod(tables["histogram"][b][0])));

  std::map<std::int64_t, std::pair<double, double>> blocks;  // hexes, sum of quality
  for (const Element& e : elements) {
    blocks[e.block].first += 1;
    blocks[e.block].second += e.quality;
  }
  ASSERT_EQ(tables["block"].size(), 7U);
  for (std::size_t b = 1; b <= 6; ++b) {
    const Words& row = tables["block"][b];
    const auto& [hexes, qualities] = blocks[std::stol(row[0])];
    EXPECT_EQ(row[1], row[0] == "2" ? "\"copper\"" : "\"\"");
    EXPECT_EQ(std::stod(row[2]), hexes);
    EXPECT_NEAR(std::stod(row[4]), qualities / hexes, 1e-9);
  }

  ASSERT_EQ(tables["worst"].size(), 51U);
  std::vector<double> sorted;
  for (const Element& e : elements) sorted.push_back(e.quality);
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t w = 1; w <= 50; ++w) {
    const Words& row = tables["worst"][w];
    const Element& e = elements.at(static_cast<std::size_t>(std::stol(row[0])) - 1);
    EXPECT_EQ(std::stol(row[1]), e.block);
    EXPECT_NEAR(std::stod(row[5]), e.quality, 1e-12) << "element " << row[0];
    EXPECT_NEAR(std::stod(row[5]), sorted[w - 1], 1e-12);
    for (std::size_t d = 0; d < 3; ++d) {
      double centre = 0;
      for (const Point& p : e.corner) centre += p[d] / 8;
      EXPECT_NEAR(std::stod(row[2 + d]), centre, 1e-11);
    }
    EXPECT_EQ(row[9], "1");
  }
  EXPECT_EQ(tables["invalid"].size(), 1U) << "the header only";
}

TEST_F(Quality, JsonSaysWhatCsvSays) {
  write_deck("void_mat = 3\n");
  succeed({"sculpt", "-qt", "-i", "deck.i", "-e", "m", "-Q", "q.csv"});
  succeed({"sculpt", "-qt", "-i", "deck.i", "-e", "m", "-Q", "q.json"});
  const Json json(read("q.json"));
  EXPECT_EQ(json.values().at("mesh"), "m");
  Tables tables = quality_tables("q.csv");
  std::size_t compared = 1;
  for (const Words& row : tables["summary"])
    if (row[0] != "name" && row[0] != "mesh") {
      EXPECT_EQ(json.number("summary." + row[0]), std::stod(row[1])) << row[0];
      ++compared;
    }
  for (const auto& [kind, list] : std::map<std::string, std::string>{
           {"histogram", "histogram"}, {"block", "blocks"}, {"worst", "worst"}})
    for (std::size_t r = 1; r < tables[kind].size(); ++r)
      for (std::size_t c = 0; c < tables[kind][0].size(); ++c, ++compared) {
        if (tables[kind][0][c] == "name") continue;
        EXPECT_EQ(json.number(list + "." + std::to_string(r - 1) + "." + tables[kind][0][c]),
                  std::stod(tables[kind][r][c]));
      }
  EXPECT_EQ(compared, json.values().size()) << "nothing more in the JSON file";
  EXPECT_EQ(tables["block"].size(), 6U) << "the void is no block";
}

TEST_F(Quality, FileIsTheSameForAnyNumberOfRanks) {
  for (const auto& [file, more] :
       {std::pair<std::string, std::string>{"q.csv", "remove_bad = 0.6\nvoid_mat = 3\n"}, {"q.json", ""}}) {
    write_deck(more);
    std::string alone;
    for (const char* ranks : {"1", "2", "3", "5"}) {
      succeed({"sculpt", "-qt", "-j", ranks, "-i", "deck.i", "-e", "m", "-Q", file});
      if (alone.empty()) alone = read(file);
      EXPECT_GT(alone.size(), 1000U);
      EXPECT_EQ(read(file), alone) << file << ", ranks: " << ranks;
    }
  }
}

TEST_F(Quality, FileIsNamedAfterTheMeshInOlderDecks) {
  write_deck("quality = true\nexodus_file = result\n", letter_f());
  succeed({"sculpt", "-qt", "-i", "deck.i"});
  EXPECT_TRUE(read("result.quality.csv").starts_with("summary,name,value\nsummary,mesh,\"result\"\n"));
  write_deck("quality = false\nexodus_file = none\n", letter_f());
  succeed({"sculpt", "-qt", "-i", "deck.i"});
  EXPECT_FALSE(exists("none.quality.csv"));
  EXPECT_FALSE(exists("false"));
}

TEST_F(Quality, FileThatCannotBeWrittenIsRefusedBeforeTheWork) {
  write_deck("", letter_f());
  std::filesystem::create_directory(path("folder"));
  const auto before = snapshot();
  for (const auto& [ranks, file] :
       {std::pair("1", "nowhere/q.csv"), std::pair("1", "folder"), std::pair("3", "/proc/q.json")}) {
    const RunResult result = run({"sculpt", "-qt", "-j", ranks, "-i", "deck.i", "-Q", file});
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(lines_of(result.error).size(), 1U) << result.error;
    EXPECT_NE(result.error.find(std::string("quality = ") + file), std::string::npos) << result.error;
    EXPECT_TRUE(snapshot() == before);
  }
}

TEST_F(Quality, VariableIsThatOfTheElement) {
  write_deck("quality_variable = true\n");
  const RankMesh alone = made(1), together = made(3);
  EXPECT_TRUE(together == alone);
  EXPECT_EQ(alone.times, std::vector<double>{0});
  ASSERT_EQ(alone.element_variables.size(), 1U);
  EXPECT_EQ(alone.element_variables[0].name, "scaled_jacobian");
  const std::vector<Element> elements = elements_of(alone);
  ASSERT_EQ(alone.element_values.at(0).size(), elements.size());
  for (std::size_t e = 0; e < elements.size(); ++e)
    EXPECT_NEAR(alone.element_values[0][e], elements[e].quality, 1e-13);
  write_deck("");
  EXPECT_TRUE(made(1).element_variables.empty());
}

TEST_F(Quality, RemoveBadTakesOutTheHexesBelow) {
  write_deck("gen_sidesets = rve\n");
  const RankMesh whole = made(1);
  const std::vector<Element> elements = elements_of(whole);
  std::multiset<double> expected;
  std::size_t faces = 0;
  for (const Element& e : elements)
    if (e.quality >= 0.6) expected.insert(e.quality);
  for (const auto& set : whole.side_sets)
    faces +=
        static_cast<std::size_t>(std::count_if(set.element.begin(), set.element.end(), [&](std::int32_t e) {
          return elements[static_cast<std::size_t>(e) - 1].quality >= 0.6;
        }));
  ASSERT_LT(expected.size(), elements.size());

  const RankMesh left = made(1, {"-rb", "0.6"});
  std::multiset<double> found;
  for (const Element& e : elements_of(left)) found.insert(e.quality);
  EXPECT_EQ(found, expected);
  std::set<std::int32_t> used;
  std::size_t faces_left = 0;
  for (const auto& block : left.blocks) used.insert(block.nodes.begin(), block.nodes.end());
  for (const auto& set : left.side_sets) faces_left += set.element.size();
  EXPECT_EQ(used.size(), left.x.size()) << "no node without a hex";
  EXPECT_EQ(faces_left, faces);
  EXPECT_EQ(left.hex_id.back(), static_cast<std::int64_t>(expected.size()));
  for (const int ranks : {2, 5, 7}) EXPECT_TRUE(made(ranks, {"-rb", "0.6"}) == left) << ranks;
}

TEST_F(Quality, RemoveBadSaysWhatItDid) {
  write_deck("remove_bad = 0.0\n");
  const RankMesh whole = made(1);
  EXPECT_TRUE(made(2) == whole);
  EXPECT_NE(succeed({"sculpt", "-i", "deck.i"}).out.find("remove_bad = 0: 0 hexes removed\n"),
            std::string::npos);
  write_deck("");
  EXPECT_TRUE(made(1) == whole) << "0 takes nothing from a good mesh";
  // The worst value itself is not below itself.
  write_deck("quality = q.json\nquality_variable = true\n");
  (void)made(1);
  const std::string least = Json(read("q.json")).values().at("summary.scaled_jacobian_min");
  write_deck("");
  EXPECT_TRUE(made(1, {"-rb", least}) == whole);
  const std::string out = succeed({"sculpt", "-i", "deck.i", "-rb", "0.5"}).out;
  EXPECT_EQ(summary(out, "Num Elements"), static_cast<double>(whole.hex_id.size()) -
                                              std::stod(out.substr(out.find("remove_bad = 0.5: ") + 18)));
}

TEST_F(Quality, RemovingEverythingIsAnError) {
  const Voxels diagonal{2, 2, 2,
                        [](int i, int j, int k) { return 1 + (i + j + k) % 2 * 1 + 2 * (i * j * k); }};
  write_deck("remove_bad = 1\n", diagonal);
  for (const char* ranks : {"1", "2"}) {
    const RunResult result = run({"sculpt", "-qt", "-j", ranks, "-i", "deck.i", "-e", "gone"});
    EXPECT_EQ(result.status, 2);
    EXPECT_NE(result.error.find("remove_bad = 1"), std::string::npos) << result.error;
    EXPECT_FALSE(exists("gone.e.1.0"));
  }
}

TEST_F(Quality, StatusSaysWhenTheMeshMissesWhatIsRequired) {
  write_deck("");
  succeed({"sculpt", "-i", "deck.i", "-e", "m", "--require_quality", "0"});
  succeed({"sculpt", "-j", "2", "-i", "deck.i", "-e", "m", "--require_quality", "0.3"});
  for (const std::string ranks : {"1", "3"}) {
    const RunResult missed =
        run({"sculpt", "-j", ranks, "-i", "deck.i", "-e", "m" + ranks, "--require_quality", "0.9"});
    EXPECT_EQ(missed.status, 3) << ranks;
    EXPECT_EQ(missed.error, "");
    EXPECT_NE(missed.out.find("WARNING: the mesh misses require_quality = 0.9"), std::string::npos);
    succeed({"eputool", "-p", ranks, "m" + ranks});
  }
}

// Without smoothing the contour of noise folds hexes: they are named, and the least requirement fails.
TEST_F(Quality, FoldedHexesAreNamed) {
  write_deck("smooth = off\nquality = q.csv\nrequire_quality = 0\n", grains(6, 60, 3));
  const RunResult result = run({"sculpt", "-j", "2", "-i", "deck.i", "-e", "m"});
  EXPECT_EQ(result.status, 3) << result.error;
  Tables tables = quality_tables("q.csv");
  const std::size_t listed = tables["invalid"].size() - 1;
  ASSERT_GT(listed, 0U) << "the mesh is good, so this tests nothing";
  std::size_t named = 0;
  for (const std::string& line : lines_of(result.out)) named += line.starts_with("WARNING: hex ");
  EXPECT_EQ(named, listed);
  const Words& first = tables["invalid"][1];
  EXPECT_NE(result.out.find("WARNING: hex " + first[0] + " of block " + first[1] + " at "),
            std::string::npos);
}

TEST_F(Quality, SummaryTellsFidelity) {
  write_deck(
      "quality = q.json\ncompare_volume = true\nopt_threshold = 0.3\nmax_pcol_iters = 0\npcol_threshold = "
      "0.9\n");
  const std::string out = succeed({"sculpt", "-i", "deck.i", "-e", "m"}).out;
  const Json json(read("q.json"));
  EXPECT_NEAR(summary(out, "Interface Kink (deg)"), json.number("summary.interface_kink_degrees"), 1e-6);
  EXPECT_GT(summary(out, "Interface Kink (deg)"), 1);
  EXPECT_NEAR(summary(out, "Volume Moved (%)"), json.number("summary.volume_moved_percent"), 1e-6);
  EXPECT_GT(summary(out, "Volume Moved (%)"), 0);
  EXPECT_NEAR(summary(out, "Min Edge Len (cells)"), summary(out, "Min Edge Len"), 1e-9);
  EXPECT_NE(out.find("\n  From Contour (cells)  max "), std::string::npos);
  EXPECT_NE(out.find("\n  From Target (cells)   max "), std::string::npos);
  EXPECT_NE(out.find("\n  Worst valid hexes below 0.9:\n    hex "), std::string::npos);
  // Half of what the table of volumes says.
  const Words lines = lines_of(out);
  const auto table = std::find(lines.begin(), lines.end(), "VOLUME COMPARISON");
  ASSERT_NE(table, lines.end());
  double moved = 0;
  for (int row = 2; row < 8; ++row) {
    std::istringstream cells(*(table + row));
    double material = 0, before = 0, after = 0;
    cells >> material >> before >> after;
    moved += std::fabs(after - before) / 2;
  }
  EXPECT_NEAR(summary(out, "Volume Moved (%)"), 100 * moved / 512, 1e-5);
  EXPECT_TRUE((table + 8)->find("Total") != std::string::npos) << *(table + 8);
}

}  // namespace
}  // namespace sculpt::cli
