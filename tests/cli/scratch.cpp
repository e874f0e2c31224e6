#include "scratch.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "sculpt/exo/read_exodus.hpp"

namespace sculpt::cli {
namespace {

std::string program(const std::string& name) {
  if (name == "sculpt") return SCULPT_PROGRAM;
  if (name == "psculpt") return PSCULPT_PROGRAM;
  if (name == "eputool") return EPUTOOL_PROGRAM;
  if (name == "mpiexec") return MPIEXEC_PROGRAM;
  return name;
}

std::string content(const std::filesystem::path& path) {
  std::ostringstream all;
  all << std::ifstream(path, std::ios::binary).rdbuf();
  return all.str();
}

}  // namespace

Scratch::Scratch() {
  folder_ = (std::filesystem::temp_directory_path() / "sculpt_cli_XXXXXX").string();
  if (::mkdtemp(folder_.data()) == nullptr) throw std::runtime_error("cannot make " + folder_);
}

Scratch::~Scratch() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

void Scratch::write(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
}

std::string Scratch::read(const std::string& name) const { return content(path(name)); }

bool Scratch::exists(const std::string& name) const { return std::filesystem::exists(path(name)); }

std::map<std::string, std::string> Scratch::snapshot() const {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_)) {
    const std::string name = std::filesystem::relative(entry.path(), folder_).string();
    if (entry.is_directory())
      files[name + "/"];
    else
      files[name] = content(entry.path());
  }
  return files;
}

RunResult Scratch::run(Words words, RunOptions options) const {
  for (std::size_t n = 0; n < words.size(); ++n)
    if (n == 0 || words[0] == MPIEXEC_PROGRAM) words[n] = program(words[n]);
  if (options.folder.empty()) options.folder = folder_;
  return run_program(words, options);
}

RunResult Scratch::succeed(const Words& words, const RunOptions& options) const {
  RunResult result = run(words, options);
  EXPECT_FALSE(result.timed_out);
  EXPECT_EQ(result.status, 0) << result.out;
  EXPECT_EQ(result.error, "");
  return result;
}

RankMesh Scratch::mesh(const std::string& deck, int ranks) {
  const std::string count = std::to_string(ranks), base = "mesh" + count;
  write(base + ".i", "BEGIN SCULPT\n" + deck + "exodus_file = " + base + "\nEND SCULPT\n");
  console_ = succeed({"sculpt", "-j", count, "-i", base + ".i"}, {.seconds = 120}).out;
  succeed({"eputool", "-p", count, base});
  return exists(base + ".e") ? read_exodus(path(base + ".e")) : RankMesh{};
}

double summary(const std::string& console, const std::string& label) {
  for (const std::string& line : lines_of(console)) {
    const std::size_t at = line.find_first_not_of(' ');
    if (at == std::string::npos || line.compare(at, label.size() + 1, label + " ") != 0) continue;
    std::size_t used = 0;
    const std::string value = line.substr(line.find_first_not_of(' ', at + label.size()));
    const double number = std::stod(value, &used);
    return used == value.size() ? number : std::nan("");
  }
  return std::nan("");
}

std::int64_t hexes_of(const RankMesh& mesh) {
  std::int64_t hexes = 0;
  for (const auto& [id, count] : hexes_by_block(mesh)) hexes += count;
  return hexes;
}

std::map<std::int64_t, std::int64_t> hexes_by_block(const RankMesh& mesh) {
  std::map<std::int64_t, std::int64_t> hexes;
  for (const RankMesh::Block& block : mesh.blocks)
    if (!block.nodes.empty()) hexes[block.id] += static_cast<std::int64_t>(block.nodes.size()) / 8;
  return hexes;
}

}  // namespace sculpt::cli
