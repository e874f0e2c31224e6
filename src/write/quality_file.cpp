#include "sculpt/write/quality_file.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <utility>
#include <vector>

#include "sculpt/exo/write_rank_file.hpp"

namespace sculpt {
namespace {

using Rows = std::vector<std::pair<std::string, std::string>>;

// Name and value of every number that stands for the whole mesh.
Rows totals(const QualityReport& report) {
  const QualitySummary& s = report.summary;
  const Displacement& d = report.displacement;
  double input = 0, meshed = 0;
  for (const auto& block : report.blocks) {
    input += block.input_volume;
    meshed += report.of(block).volume;
  }
  const auto text = [](auto value) { return fmt::format("{}", value); };
  return {{"hexes", text(s.hexes)},
          {"scaled_jacobian_min", text(s.least)},
          {"scaled_jacobian_mean", text(s.average)},
          {"scaled_jacobian_not_positive", text(s.not_positive)},
          {"scaled_jacobian_below_0.1", text(s.below_01)},
          {"scaled_jacobian_below_0.2", text(s.below_02)},
          {"scaled_jacobian_below_0.3", text(s.below_03)},
          {"scaled_jacobian_below_0.5", text(s.below_05)},
          {"jacobian_not_positive_inside", text(s.not_positive_inside)},
          {"shortest_edge", text(s.shortest_edge)},
          {"shortest_edge_cells", text(s.shortest_edge_cells)},
          {"interface_quads", text(report.kink.quads)},
          {"interface_edges", text(report.kink.edges)},
          {"interface_kink_degrees", text(report.kink.mean)},
          {"interface_nodes", text(d.nodes)},
          {"from_contour_max_cells", text(d.largest_from_contour)},
          {"from_contour_mean_cells", text(d.mean_from_contour)},
          {"from_target_max_cells", text(d.largest_from_target)},
          {"from_target_mean_cells", text(d.mean_from_target)},
          {"input_volume", text(input * report.cell_volume)},
          {"mesh_volume", text(meshed * report.cell_volume)},
          {"volume_moved_percent", text(report.volume_moved)}};
}

// Wrapped in quotes, with quotes inside doubled.
std::string csv_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string json_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      (quoted += '\\') += c;
    else if (static_cast<unsigned char>(c) < 0x20)
      quoted += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      quoted += c;
  }
  return quoted + '"';
}

// A value that blocks without hexes do not have.
std::string if_any(const MaterialQuality& quality, double value, const char* otherwise) {
  return quality.hexes > 0 ? fmt::format("{}", value) : otherwise;
}

std::int64_t block_id(const QualityReport& report, std::int32_t material) {
  const auto block = std::find_if(report.blocks.begin(), report.blocks.end(),
                                  [material](const auto& b) { return b.material == material; });
  check(block != report.blocks.end(), "a hex of a material that is not meshed");
  return block->id;
}

void write_text(const std::string& path, const std::string& text) {
  std::FILE* file = std::fopen(path.c_str(), "w");
  const bool good = file != nullptr && std::fwrite(text.data(), 1, text.size(), file) == text.size() &&
                    std::fflush(file) == 0;
  const int cause = errno;
  if (file != nullptr) std::fclose(file);
  if (!good)
    throw Error(fmt::format("quality: cannot write '{}': {}", shown_name(path), std::strerror(cause)));
}

}  // namespace

std::string quality_file_name(const Deck& deck) {
  if (deck.quality == "false") return {};
  return deck.quality == "true" ? deck.exodus_file + ".quality.csv" : deck.quality;
}

std::string quality_csv(const QualityReport& report, const std::string& mesh) {
  std::string out = fmt::format("summary,name,value\nsummary,mesh,{}\n", csv_text(mesh));
  const auto to = std::back_inserter(out);
  for (const auto& [name, value] : totals(report)) fmt::format_to(to, "summary,{},{}\n", name, value);
  out += "histogram,from,to,hexes\n";
  for (int b = 0; b < QualitySummary::kBins; ++b)
    fmt::format_to(to, "histogram,{},{},{}\n", QualitySummary::bin_begin(b), QualitySummary::bin_begin(b + 1),
                   report.summary.histogram[at(b)]);
  out += "block,id,name,hexes,scaled_jacobian_min,scaled_jacobian_mean,volume,input_volume\n";
  for (const auto& block : report.blocks) {
    const MaterialQuality q = report.of(block);
    fmt::format_to(to, "block,{},{},{},{},{},{},{}\n", block.id, csv_text(block.name), q.hexes,
                   if_any(q, q.least, ""), if_any(q, q.mean, ""), q.volume * report.cell_volume,
                   block.input_volume * report.cell_volume);
  }
  for (const auto& [kind, list] :
       {std::pair("worst", &report.summary.worst), std::pair("invalid", &report.summary.invalid)}) {
    fmt::format_to(
        to, "{},element,block,x,y,z,scaled_jacobian,corner,corner_determinant,shortest_edge,valid\n", kind);
    for (const ListedHex& h : *list)
      fmt::format_to(to, "{},{},{},{},{},{},{},{},{},{},{}\n", kind, h.element, block_id(report, h.material),
                     h.centre.x, h.centre.y, h.centre.z, h.scaled_jacobian, h.corner, h.least_determinant,
                     h.shortest_edge, h.valid);
  }
  return out;
}

std::string quality_json(const QualityReport& report, const std::string& mesh) {
  std::string out = fmt::format("{{\n  \"mesh\": {},\n  \"summary\": {{", json_text(mesh));
  const auto to = std::back_inserter(out);
  const char* before = "";
  // The next item of a list or an object, on a line of its own.
  const auto item = [&](const std::string& text) {
    fmt::format_to(to, "{}\n    {}", before, text);
    before = ",";
  };
  const auto begin = [&](const char* end, const char* name) {
    fmt::format_to(to, "\n  {},\n  \"{}\": [", end, name);
    before = "";
  };
  for (const auto& [name, value] : totals(report)) item(fmt::format("\"{}\": {}", name, value));
  begin("}", "histogram");
  for (int b = 0; b < QualitySummary::kBins; ++b)
    item(fmt::format("{{\"from\": {}, \"to\": {}, \"hexes\": {}}}", QualitySummary::bin_begin(b),
                     QualitySummary::bin_begin(b + 1), report.summary.histogram[at(b)]));
  begin("]", "blocks");
  for (const auto& block : report.blocks) {
    const MaterialQuality q = report.of(block);
    item(fmt::format(
        "{{\"id\": {}, \"name\": {}, \"hexes\": {}, \"scaled_jacobian_min\": {}, "
        "\"scaled_jacobian_mean\": {}, \"volume\": {}, \"input_volume\": {}}}",
        block.id, json_text(block.name), q.hexes, if_any(q, q.least, "null"), if_any(q, q.mean, "null"),
        q.volume * report.cell_volume, block.input_volume * report.cell_volume));
  }
  for (const auto& [kind, list] :
       {std::pair("worst", &report.summary.worst), std::pair("invalid", &report.summary.invalid)}) {
    begin("]", kind);
    for (const ListedHex& h : *list)
      item(
          fmt::format("{{\"element\": {}, \"block\": {}, \"x\": {}, \"y\": {}, \"z\": {}, "
                      "\"scaled_jacobian\": {}, \"corner\": {}, \"corner_determinant\": {}, "
                      "\"shortest_edge\": {}, \"valid\": {}}}",
                      h.element, block_id(report, h.material), h.centre.x, h.centre.y, h.centre.z,
                      h.scaled_jacobian, h.corner, h.least_determinant, h.shortest_edge, h.valid));
  }
  out += "\n  ]\n}\n";
  return out;
}

void write_quality_file(const Comm& comm, const QualityReport& report, const std::string& mesh,
                        const std::string& file_name) {
  collectively(comm, "writing " + file_name, [&] {
    if (comm.rank() != 0) return;
    const std::string temporary = temporary_name(file_name);
    try {
      write_text(temporary,
                 file_name.ends_with(".json") ? quality_json(report, mesh) : quality_csv(report, mesh));
      publish(temporary, file_name);
    } catch (...) {
      discard(temporary);
      throw;
    }
  });
}

}  // namespace sculpt
