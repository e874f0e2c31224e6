#include "sculpt/mesh/colour.hpp"

#include <algorithm>
#include <bitset>
#include <utility>
#include <vector>

#include "sculpt/base/lot.hpp"

namespace sculpt {
namespace {

// Of turns drawn by lot. Few enough that the nodes of one turn, which are visited in the order of memory, lie
// close; so many that few of them share a hex and wait for each other.
constexpr std::uint64_t kTurns = 64;

// Jones and Plassmann (1993): a node takes its colour once all nodes of its hexes that come before it, by
// their turns and by their ids, have theirs.
class Colouring {
 public:
  Colouring(HexMesh& mesh, std::span<const std::uint8_t> preset, std::span<const std::uint8_t> turns)
      : mesh_(mesh), comm_(mesh.node_exchange.comm()), news_(mesh.position.size(), 0) {
    collectively(comm_, "colouring nodes", [&] {
      check(preset.size() == mesh.position.size(), "one preset colour per node");
      check(turns.empty() || turns.size() == mesh.position.size(), "one turn per node");
    });
    if (preset.data() != mesh.colour.data()) mesh.colour.assign(preset.begin(), preset.end());
    turn_.assign(mesh.position.size(), 0);
    for (LocalId n = 0; n < mesh.nodes(); ++n) {
      if (mesh.colour[at(n)] != kNoColour) continue;
      turn_[at(n)] =
          turns.empty() ? static_cast<std::uint8_t>(lot_of(mesh.node_homes()[at(n)]) % kTurns) : turns[at(n)];
      if (mesh.node_owner[at(n)] == comm_.rank()) waiting_.push_back(n);
    }
    std::stable_sort(waiting_.begin(), waiting_.end(),
                     [this](LocalId a, LocalId b) { return turn_[at(a)] < turn_[at(b)]; });
    find_hexes();
  }

  void run() {
    std::int64_t left = comm_.sum(static_cast<std::int64_t>(waiting_.size()));
    while (left > 0) {
      collectively(comm_, "colouring nodes", [this] { colour_ready(); });
      mesh_.node_exchange.copy_changed(std::span<std::uint8_t>(mesh_.colour), std::span<std::uint8_t>(news_),
                                       [](LocalId) {});
      const std::int64_t before = left;
      left = comm_.sum(static_cast<std::int64_t>(waiting_.size()));
      collectively(comm_, "colouring nodes",
                   [&] { check(left < before, "nodes wait for each other's colours"); });
    }
    std::int64_t last = kFirstFreeColour - 1;
    for (const std::uint8_t c : mesh_.colour) last = std::max<std::int64_t>(last, c);
    mesh_.colours = static_cast<int>(comm_.max(last)) + 1;
  }

 private:
  [[nodiscard]] bool before(LocalId a, LocalId b) const {
    const std::span<const GlobalId> home =
        mesh_.node_homes();  // around a torus everybody has somebody on his left
    return std::pair(turn_[at(a)], home[at(a)]) < std::pair(turn_[at(b)], home[at(b)]);
  }

  // The hexes around the waiting nodes.
  void find_hexes() {
    place_.assign(mesh_.position.size(), kNone);
    for (std::size_t i = 0; i < waiting_.size(); ++i) place_[at(waiting_[i])] = static_cast<LocalId>(i);
    first_.assign(waiting_.size() + 1, 0);
    const auto visit = [this](auto&& found) {
      for (LocalId h = 0; h < mesh_.size(); ++h)
        for (const LocalId n : mesh_.hexes[at(h)])
          if (place_[at(n)] != kNone) found(at(place_[at(n)]), h);
    };
    visit([this](std::size_t i, LocalId) { ++first_[i + 1]; });
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    around_.resize(static_cast<std::size_t>(first_.back()));
    std::vector<std::int64_t> next(first_.begin(), first_.end() - 1);
    visit([&](std::size_t i, LocalId h) { around_[static_cast<std::size_t>(next[i]++)] = h; });
  }

  // In the order of the turns, so that chains within a rank take one round.
  void colour_ready() {
    std::erase_if(waiting_, [this](LocalId n) {
      std::bitset<kNoColour> taken;
      const std::size_t i = at(place_[at(n)]);
      for (auto e = first_[i]; e < first_[i + 1]; ++e)
        for (const LocalId other : mesh_.hexes[at(around_[static_cast<std::size_t>(e)])]) {
          const std::uint8_t c = mesh_.colour[at(other)];
          if (c != kNoColour)
            taken.set(c);
          else if (other != n && before(other, n))
            return false;
        }
      std::size_t colour = kFirstFreeColour;
      while (colour < kNoColour && taken.test(colour)) ++colour;
      check(colour < kNoColour, "a mesh needs more than 255 colours");
      mesh_.colour[at(n)] = static_cast<std::uint8_t>(colour);
      news_[at(n)] = 1;
      return true;
    });
  }

  HexMesh& mesh_;
  const Comm& comm_;
  std::vector<std::uint8_t> turn_;   // per node without a preset colour
  std::vector<std::uint8_t> news_;   // per node: coloured in this round
  std::vector<LocalId> waiting_;     // owned nodes without a colour, in the order of their turns
  std::vector<LocalId> place_;       // per node: its first place among the waiting ones, kNone for others
  std::vector<std::int64_t> first_;  // per place: its hexes in around_
  std::vector<LocalId> around_;
};

}  // namespace

void colour_nodes(HexMesh& mesh, std::span<const std::uint8_t> preset, std::span<const std::uint8_t> turns) {
  Colouring(mesh, preset, turns).run();
}

}  // namespace sculpt
