#pragma once
// What the tests of the readers share: files that vanish, decks, and looking into the fractions of a box.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "sculpt/input/material_source.hpp"

namespace sculpt {

// A file in the temporary directory, written by rank 0 and removed at the end; collective.
class TemporaryFile {
 public:
  TemporaryFile(const Comm& comm, const std::string& text) : comm_(comm) {
    static int count = 0;
    std::string name = "sculpt_input_" + std::to_string(::getpid()) + "_" + std::to_string(count++);
    path_ = comm_.broadcast((std::filesystem::temp_directory_path() / name).string(), 0);
    if (comm_.rank() == 0) std::ofstream(path_, std::ios::binary) << text;
    comm_.barrier();
  }
  explicit TemporaryFile(const std::string& text) : TemporaryFile(Comm::self(), text) {}
  ~TemporaryFile() {
    comm_.barrier();
    std::error_code ignored;
    if (comm_.rank() == 0) std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  Comm comm_;
  std::string path_;
};

inline Deck spn_deck(const std::string& path, const Index3& cells, int order = kSpnXyz) {
  Deck deck;
  deck.input_spn = path;
  deck.nelx = cells[0];
  deck.nely = cells[1];
  deck.nelz = cells[2];
  for (const char* name : {"nelx", "nely", "nelz"}) deck.given_options.add(name, "test");
  deck.spn_xyz_order = order;
  return deck;
}

inline Deck diatom_deck(const std::string& path, std::int64_t cells, double half_width) {
  Deck deck;
  deck.diatom_file = path;
  deck.nelx = deck.nely = deck.nelz = cells;
  deck.xmin = deck.ymin = deck.zmin = -half_width;
  deck.xmax = deck.ymax = deck.zmax = half_width;
  for (const char* name : {"nelx", "nely", "nelz", "xmin", "ymin", "zmin", "xmax", "ymax", "zmax"})
    deck.given_options.add(name, "test");
  return deck;
}

// Opens the source and reads the same box on every rank; the whole grid unless a box is given.
inline MaterialData read_box(const Comm& comm, const Deck& deck, std::optional<IndexBox> box = std::nullopt) {
  const auto source = open_source(comm, deck, Log());
  const std::vector<IndexBox> wanted(static_cast<std::size_t>(comm.size()),
                                     box ? *box : whole(source->grid().cells));
  return source->read(comm, wanted);
}

// Fraction of the material (dense index) in a cell given by its position in the box.
inline double fraction_of(const Fractions& fractions, std::int64_t cell, std::int32_t material) {
  const auto at = static_cast<std::size_t>(cell);
  for (auto e = fractions.offset[at]; e < fractions.offset[at + 1]; ++e)
    if (fractions.material[static_cast<std::size_t>(e)] == material)
      return fractions.value[static_cast<std::size_t>(e)];
  return 0;
}

// Block id of each cell of a pure source.
inline std::vector<std::int64_t> block_ids(const MaterialData& data) {
  std::vector<std::int64_t> ids;
  for (const std::int32_t m : data.fractions.material)
    ids.push_back(data.table.block_id[static_cast<std::size_t>(m)]);
  return ids;
}

// The promise of MaterialSource: materials ascend within a cell, fractions lie in (0,1] and add up to 1.
inline void expect_valid(const MaterialData& data) {
  const Fractions& f = data.fractions;
  for (std::size_t c = 0; c + 1 < f.offset.size(); ++c) {
    double sum = 0;
    for (auto e = static_cast<std::size_t>(f.offset[c]); e < static_cast<std::size_t>(f.offset[c + 1]); ++e) {
      sum += f.value[e];
      EXPECT_GT(f.value[e], 0);
      EXPECT_LE(f.value[e], 1);
      const bool ascends = e == static_cast<std::size_t>(f.offset[c]) || f.material[e] > f.material[e - 1];
      EXPECT_TRUE(ascends) << "cell " << c;
    }
    EXPECT_NEAR(sum, 1, 1e-14) << "cell " << c;
  }
}

// The text of the AgreedError that the action throws; empty when it throws none.
inline std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const AgreedError& e) {
    return e.what();
  }
  return {};
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace sculpt
