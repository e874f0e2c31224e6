#pragma once
// The fixture of tests of what a user can get wrong.
#include <fmt/core.h>

#include <filesystem>
#include <functional>

#include "cases.hpp"
#include "scratch.hpp"
#include "sculpt/exo/read_exodus.hpp"
#include "sculpt/exo/write_rank_file.hpp"

namespace sculpt::cli {

class BadInput : public Scratch {
 public:
  using Scratch::folder;
  using Scratch::path;
  using Scratch::run;
  using Scratch::snapshot;
  using Scratch::succeed;
  using Scratch::write;

  void write_voxels() const { write("v.spn", spn_text(letter_f())); }
  // A deck of the letter F with more lines.
  void write_deck(const std::string& more = "") const {
    write_voxels();
    write("deck.i", "BEGIN SCULPT\n" + spn_deck(letter_f(), "v.spn") + more + "END SCULPT\n");
  }
  void write_spn(const std::string& text) const {
    write_deck();
    write("v.spn", text);
  }
  void write_tec(const std::string& rows) const {
    write("f.tec", "VARIABLES = x y z a b\nZONE I=2 J=1 K=2\n" + rows);
    write("deck.i", "BEGIN SCULPT\ninput_micro = f.tec\nEND SCULPT\n");
  }
  void write_diatom(const std::string& insert) const {
    write("s.diatom", "diatom\npackage 'a'\nmaterial 1\n" + insert + "endpackage\nenddiatom\n");
    write("deck.i", "BEGIN SCULPT\n" + two_spheres_deck("s.diatom") + "END SCULPT\n");
  }
  void write_stl(const std::string& text) const {
    write("s.stl", text);
    write("deck.i", "BEGIN SCULPT\nstl_file = s.stl\n" + box_deck(4, 1.1) + "END SCULPT\n");
  }
  // A grid of cells in grid.e, changed by `change`, as input.
  void write_cart_exo(const std::function<void(RankMesh&)>& change) {
    write_deck("stair = fast\nexodus_file = grid\n");
    succeed({"sculpt", "-i", "deck.i"});
    succeed({"eputool", "-p", "1", "grid"});
    RankMesh grid = read_exodus(path("grid.e"));
    change(grid);
    write_rank_file(path("grid.e"), grid);
    write("deck.i", "BEGIN SCULPT\ninput_cart_exo = grid.e\nEND SCULPT\n");
  }

  // Runs the deck with output to out.e.N.r, where earlier files lie. Returns the message.
  std::string expect_refused(int ranks, const Words& expected, const RunOptions& options = {},
                             const std::string& base = "out") {
    for (int r = 0; r < ranks; ++r) write(fmt::format("out.e.{}.{}", ranks, r), "an earlier result\n");
    const auto before = snapshot();
    const RunResult result =
        run({"sculpt", "-i", "deck.i", "-j", std::to_string(ranks), "-e", base}, options);
    expect_message(result, expected);
    EXPECT_EQ(names(snapshot()), names(before));
    EXPECT_TRUE(snapshot() == before) << "an earlier file has changed";
    return result.error;
  }

  static void expect_message(const RunResult& result, const Words& expected) {
    EXPECT_FALSE(result.timed_out);
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(lines_of(result.error).size(), 1U) << result.error;
    EXPECT_TRUE(result.error.starts_with("sculpt: error: ")) << result.error;
    for (const std::string& words : expected)
      EXPECT_NE(result.error.find(words), std::string::npos)
          << "expected '" << words << "' in: " << result.error;
    EXPECT_EQ(result.out.find("Done!"), std::string::npos);
  }

 private:
  static Words names(const std::map<std::string, std::string>& files) {
    Words list;
    for (const auto& [name, text] : files) list.push_back(name);
    return list;
  }
};

struct Mistake {
  std::string name;
  std::function<void(BadInput&)> prepare;
  Words expected;
};

inline void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

// A mistake on a number of ranks.
class Refused : public BadInput, public ::testing::WithParamInterface<std::tuple<Mistake, int>> {
 protected:
  void expect_refused_once() {
    const auto& [mistake, ranks] = GetParam();
    mistake.prepare(*this);
    expect_refused(ranks, mistake.expected);
  }
};

inline std::string mistake_name(const ::testing::TestParamInfo<std::tuple<Mistake, int>>& info) {
  return fmt::format("{}_j{}", std::get<0>(info.param).name, std::get<1>(info.param));
}

}  // namespace sculpt::cli
