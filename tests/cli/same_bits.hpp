#pragma once
// The fixture of tests that compare the meshes of several numbers of ranks with that of one.
#include <cstring>
#include <string>
#include <vector>

#include "cases.hpp"
#include "scratch.hpp"

namespace sculpt::cli {

using Ranks = std::vector<int>;
inline const Ranks kMany{2, 3, 4, 5, 7, 8, 16};
inline const Ranks kFew{2, 3, 5, 8};

inline bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

class SameBits : public Scratch {
 protected:
  // Returns the mesh of one rank.
  RankMesh expect_same(const std::string& deck, const Ranks& ranks) {
    const RankMesh alone = mesh(deck, 1);
    const std::string console_alone = console();
    EXPECT_GT(hexes_of(alone), 0);
    for (const int n : ranks) {
      SCOPED_TRACE("ranks: " + std::to_string(n));
      const RankMesh together = mesh(deck, n);
      EXPECT_TRUE(same_bits(together.x, alone.x) && same_bits(together.y, alone.y) &&
                  same_bits(together.z, alone.z))
          << "coordinates differ";
      EXPECT_EQ(together.node_id, alone.node_id);
      EXPECT_EQ(together.hex_id, alone.hex_id);
      EXPECT_TRUE(together == alone) << "blocks, connectivity or sets differ";
      for (const char* label :
           {"Num Nodes", "Num Elements", "Num Blocks", "Min Quality", "Avg Quality", "Min Edge Len"})
        EXPECT_EQ(summary(console(), label), summary(console_alone, label)) << label;
    }
    first_console_ = console_alone;
    return alone;
  }
  RankMesh expect_same(const Voxels& voxels, const std::string& more, const Ranks& ranks) {
    write("v.spn", spn_text(voxels));
    return expect_same(spn_deck(voxels, "v.spn") + more, ranks);
  }
  [[nodiscard]] const std::string& first_console() const { return first_console_; }

 private:
  std::string first_console_;
};

}  // namespace sculpt::cli
