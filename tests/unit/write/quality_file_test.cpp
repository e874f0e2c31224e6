#include "sculpt/write/quality_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace sculpt {
namespace {

// Two blocks of which the second lost all its hexes; one hex of three is folded.
QualityReport report() {
  QualityReport r;
  QualitySummary& s = r.summary;
  s.hexes = 3;
  s.not_positive = s.below_01 = s.below_02 = s.below_03 = s.below_05 = s.not_positive_inside = 1;
  s.histogram[19] = 2;
  s.histogram[9] = 1;
  s.least = -0.0625;
  s.average = 0.625;
  s.shortest_edge = 0.25;
  s.shortest_edge_cells = 0.125;
  s.materials = {{3, -0.0625, 0.625, 2.5}};
  ListedHex h;
  h.hex = 77;
  h.element = 2;
  h.scaled_jacobian = -0.0625;
  h.corner = 8;
  h.least_determinant = -0.5;
  h.shortest_edge = 0.25;
  h.centre = {1.5, -2, 0.1};
  h.valid = 0;
  s.worst = s.invalid = {h};
  r.kink = {6, 4, 12.5};
  r.displacement = {9, 0.5, 0.25, 0.375, 0.0625};
  r.blocks = {{0, 5, "say \"hi\", you", 2}, {1, 9, "", 0.5}};
  r.volume_moved = 20;
  r.cell_volume = 8;
  return r;
}

std::vector<std::string> lines_with(const std::string& text, const std::string& begin) {
  std::vector<std::string> found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(begin)) found.push_back(line);
  return found;
}

using Lines = std::vector<std::string>;

TEST(QualityFileName, IsTheUsersOrTheMeshs) {
  Deck deck;
  deck.exodus_file = "out/mesh";
  EXPECT_EQ(quality_file_name(deck), "");
  deck.quality = "q.json";
  EXPECT_EQ(quality_file_name(deck), "q.json");
  deck.quality = "true";
  EXPECT_EQ(quality_file_name(deck), "out/mesh.quality.csv");
  deck.quality = "false";
  EXPECT_EQ(quality_file_name(deck), "");
}

TEST(QualityCsv, HasATableForEveryKindOfRow) {
  const std::string text = quality_csv(report(), "mesh");
  EXPECT_EQ(lines_with(text, "block,"),
            (Lines{"block,id,name,hexes,scaled_jacobian_min,scaled_jacobian_mean,volume,input_volume",
                   "block,5,\"say \"\"hi\"\", you\",3,-0.0625,0.625,20,16", "block,9,\"\",0,,,0,4"}));
  EXPECT_EQ(lines_with(text, "worst,"),
            (Lines{"worst,element,block,x,y,z,scaled_jacobian,corner,corner_determinant,shortest_edge,valid",
                   "worst,2,5,1.5,-2,0.1,-0.0625,8,-0.5,0.25,0"}));
  EXPECT_EQ(lines_with(text, "invalid,").size(), 2U);
  const Lines histogram = lines_with(text, "histogram,");
  ASSERT_EQ(histogram.size(), 21U);
  EXPECT_EQ(histogram[0], "histogram,from,to,hexes");
  EXPECT_EQ(histogram[1], "histogram,-1,-0.9,0");
  EXPECT_EQ(histogram[10], "histogram,-0.1,0,1");
  EXPECT_EQ(histogram[20], "histogram,0.9,1,2");
  const Lines summary = lines_with(text, "summary,");
  for (const char* line : {"summary,name,value", "summary,mesh,\"mesh\"", "summary,hexes,3",
                           "summary,scaled_jacobian_min,-0.0625", "summary,scaled_jacobian_not_positive,1",
                           "summary,interface_kink_degrees,12.5", "summary,from_contour_max_cells,0.5",
                           "summary,from_target_mean_cells,0.0625", "summary,volume_moved_percent,20",
                           "summary,input_volume,20", "summary,mesh_volume,20"})
    EXPECT_EQ(std::count(summary.begin(), summary.end(), line), 1) << line;
}

TEST(QualityJson, SaysTheSame) {
  const std::string text = quality_json(report(), "a \\ \n b");
  EXPECT_TRUE(
      text.starts_with("{\n  \"mesh\": \"a \\\\ \\u000a b\",\n  \"summary\": {\n    \"hexes\": 3,\n"));
  for (const char* part :
       {"\"volume_moved_percent\": 20\n  },\n  \"histogram\": [\n    {\"from\": -1, \"to\": -0.9, \"hexes\": "
        "0},",
        "{\"id\": 5, \"name\": \"say \\\"hi\\\", you\", \"hexes\": 3, \"scaled_jacobian_min\": -0.0625, "
        "\"scaled_jacobian_mean\": 0.625, \"volume\": 20, \"input_volume\": 16},",
        "{\"id\": 9, \"name\": \"\", \"hexes\": 0, \"scaled_jacobian_min\": null, "
        "\"scaled_jacobian_mean\": null, \"volume\": 0, \"input_volume\": 4}\n  ],",
        "\"worst\": [\n    {\"element\": 2, \"block\": 5, \"x\": 1.5, \"y\": -2, \"z\": 0.1, "
        "\"scaled_jacobian\": -0.0625, \"corner\": 8, \"corner_determinant\": -0.5, "
        "\"shortest_edge\": 0.25, \"valid\": 0}\n  ],\n  \"invalid\": [\n    {\"element\": 2,"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nnot in\n" << text;
  EXPECT_TRUE(text.ends_with("\n  ]\n}\n"));
}

}  // namespace
}  // namespace sculpt
