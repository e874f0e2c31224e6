#pragma once
// The fixture of all tests of the programs: a fresh folder, files in it, runs in it, meshes out of it.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "run_program.hpp"
#include "sculpt/exo/rank_mesh.hpp"

namespace sculpt::cli {

class Scratch : public ::testing::Test {
 protected:
  Scratch();
  ~Scratch() override;

  [[nodiscard]] const std::string& folder() const { return folder_; }
  [[nodiscard]] std::string path(const std::string& name) const { return folder_ + "/" + name; }
  void write(const std::string& name, const std::string& text) const;
  [[nodiscard]] std::string read(const std::string& name) const;
  [[nodiscard]] bool exists(const std::string& name) const;
  // Every file below the folder with its content; folders end in "/".
  [[nodiscard]] std::map<std::string, std::string> snapshot() const;

  // words[0] may be "sculpt", "psculpt", "eputool" or "mpiexec".
  [[nodiscard]] RunResult run(Words words, RunOptions options = {}) const;
  // The same; a test failure when the status is not 0 or stderr is not empty.
  RunResult succeed(const Words& words, const RunOptions& options = {}) const;

  // Meshes `deck` (lines between BEGIN and END, without exodus_file) on `ranks` ranks, joins the files and
  // reads the result. The output is base.e.N.r with base = "mesh<ranks>".
  [[nodiscard]] RankMesh mesh(const std::string& deck, int ranks);
  // The console output of the last mesh().
  [[nodiscard]] const std::string& console() const { return console_; }

 private:
  std::string folder_;
  std::string console_;
};

// The number behind a label of the MESH SUMMARY ("Num Nodes"), or NaN.
[[nodiscard]] double summary(const std::string& console, const std::string& label);

[[nodiscard]] std::int64_t hexes_of(const RankMesh& mesh);
// Block id -> hexes; blocks without hexes are left out.
[[nodiscard]] std::map<std::int64_t, std::int64_t> hexes_by_block(const RankMesh& mesh);

}  // namespace sculpt::cli
