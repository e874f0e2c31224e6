#include "sculpt/distribute/unstructured.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "distribute/id_index.hpp"
#include "distribute/node_ranks.hpp"
#include "sculpt/base/fixed_point.hpp"
#include "sculpt/mesh/colour.hpp"
#include "sculpt/mesh/node_directory.hpp"

namespace sculpt {
namespace {

// An element on its way to the ranks that have it as a ghost.
struct Ghost {
  GlobalId element;
  std::array<GlobalId, 8> corner;
  std::int32_t block, owner, layer;
};

void make_distinct(std::vector<GlobalId>& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

class GhostCollector {
 public:
  GhostCollector(const Comm& comm, const ElementShare& share, const IdIndex& nodes,
                 const NodeRanks& directory)
      : comm_(comm),
        share_(share),
        nodes_(nodes),
        directory_(directory),
        sent_(static_cast<std::size_t>(comm.size())),
        last_(nodes.ids()) {}

  // Collective. All elements at nodes of the last layer that are not there yet.
  void add_layer(int layer) {
    std::vector<std::vector<GlobalId>> wanted(static_cast<std::size_t>(comm_.size()));
    for (const NodeHolder& holder : directory_.others(last_))
      wanted[static_cast<std::size_t>(holder.rank)].push_back(last_[at(holder.item)]);
    const auto asked = comm_.all_to_all(wanted);
    std::vector<std::vector<Ghost>> out(asked.size());
    collectively(comm_, "collecting ghost elements", [&] { answer(asked, layer, out); });
    std::vector<GlobalId> reached;
    for (const auto& from : comm_.all_to_all(out))
      for (const Ghost& ghost : from) {
        ghosts_.push_back(ghost);
        for (const GlobalId node : ghost.corner)
          if (nodes_.index(node) == kNone) reached.push_back(node);
      }
    make_distinct(reached);
    last_.clear();
    std::set_difference(reached.begin(), reached.end(), beyond_.begin(), beyond_.end(),
                        std::back_inserter(last_));
    std::vector<GlobalId> joined;
    std::merge(beyond_.begin(), beyond_.end(), last_.begin(), last_.end(), std::back_inserter(joined));
    beyond_.swap(joined);
  }

  [[nodiscard]] std::vector<Ghost> take() {
    std::sort(ghosts_.begin(), ghosts_.end(),
              [](const Ghost& a, const Ghost& b) { return a.element < b.element; });
    return std::move(ghosts_);
  }

 private:
  // What others want: this rank's elements at those nodes, each once.
  void answer(const std::vector<std::vector<GlobalId>>& asked, int layer,
              std::vector<std::vector<Ghost>>& out) {
    std::vector<std::int32_t> first(nodes_.ids().size() + 1, 0), elements;  // of each wanted node
    std::vector<std::uint8_t> wanted(nodes_.ids().size(), 0);
    for (const auto& from : asked)
      for (const GlobalId node : from) wanted[at(nodes_.index(node))] = 1;
    const auto for_wanted = [&](const auto& visit) {
      for (std::size_t e = 0; e < share_.corner.size(); ++e)
        for (const GlobalId node : share_.corner[e]) {
          const std::size_t n = at(nodes_.index(node));
          if (wanted[n] != 0) visit(n, e);
        }
    };
    for_wanted([&](std::size_t n, std::size_t) { ++first[n + 1]; });
    for (std::size_t n = 1; n < first.size(); ++n) first[n] += first[n - 1];
    elements.resize(static_cast<std::size_t>(first.back()));
    std::vector<std::int32_t> next(first.begin(), first.end() - 1);
    for_wanted([&](std::size_t n, std::size_t e) {
      elements[static_cast<std::size_t>(next[n]++)] = static_cast<std::int32_t>(e);
    });
    std::vector<std::int32_t> found, fresh, joined;
    for (std::size_t r = 0; r < asked.size(); ++r) {
      found.clear();
      for (const GlobalId node : asked[r]) {
        const std::size_t n = at(nodes_.index(node));
        found.insert(found.end(), elements.begin() + first[n], elements.begin() + first[n + 1]);
      }
      std::sort(found.begin(), found.end());
      found.erase(std::unique(found.begin(), found.end()), found.end());
      fresh.clear();
      std::set_difference(found.begin(), found.end(), sent_[r].begin(), sent_[r].end(),
                          std::back_inserter(fresh));
      for (const std::int32_t e : fresh)
        out[r].push_back(
            {share_.element[at(e)], share_.corner[at(e)], share_.block[at(e)], comm_.rank(), layer});
      joined.clear();
      std::merge(sent_[r].begin(), sent_[r].end(), fresh.begin(), fresh.end(), std::back_inserter(joined));
      sent_[r] = joined;
    }
  }

  const Comm& comm_;
  const ElementShare& share_;
  const IdIndex& nodes_;  // of this rank's elements
  const NodeRanks& directory_;
  std::vector<std::vector<std::int32_t>> sent_;  // per rank: local elements that it has, ascending
  std::vector<GlobalId> last_;                   // nodes that the last layer came to first
  std::vector<GlobalId> beyond_;                 // nodes of ghosts that are not of own elements
  std::vector<Ghost> ghosts_;
};

// Own elements and ghosts in one list, ascending. Answers with the corners.
std::vector<std::array<GlobalId, 8>> merge_cells(const Comm& comm, const ElementShare& share,
                                                 const std::vector<Ghost>& ghosts, UnstructuredMesh& mesh) {
  HexMesh& cells = mesh.cells;
  const std::size_t count = share.element.size() + ghosts.size();
  if (count > static_cast<std::size_t>(std::numeric_limits<LocalId>::max() / 8))
    throw Error(fmt::format("{} cells on one rank: at most {} fit; use more ranks", count,
                            std::numeric_limits<LocalId>::max() / 8));
  std::vector<std::array<GlobalId, 8>> corners;
  corners.reserve(count);
  cells.hex_id.reserve(count);
  cells.hex_owner.reserve(count);
  cells.layer.reserve(count);
  mesh.block.reserve(count);
  const auto add = [&](GlobalId id, const std::array<GlobalId, 8>& corner, std::int32_t block, int owner,
                       int layer) {
    corners.push_back(corner);
    cells.hex_id.push_back(id);
    cells.hex_owner.push_back(owner);
    cells.layer.push_back(static_cast<std::uint8_t>(layer));
    mesh.block.push_back(block);
  };
  std::size_t g = 0;
  const auto add_ghosts_before = [&](GlobalId id) {
    for (; g < ghosts.size() && ghosts[g].element < id; ++g)
      add(ghosts[g].element, ghosts[g].corner, ghosts[g].block, ghosts[g].owner, ghosts[g].layer);
  };
  for (std::size_t e = 0; e < share.element.size(); ++e) {
    add_ghosts_before(share.element[e]);
    add(share.element[e], share.corner[e], share.block[e], comm.rank(), 0);
  }
  add_ghosts_before(std::numeric_limits<GlobalId>::max());
  return corners;
}

// Collective. Mean volume of the hexes of all ranks; sums are relative to the largest, then to the mean that
// this gives, so that the units of fixed point are small whatever the range of sizes. 0 when none has any.
double mean_volume(const Comm& comm, const HexMesh& mesh, GlobalId elements) {
  std::vector<double> volume;
  double reference = 0;
  for (LocalId h = 0; h < mesh.size(); ++h) {
    if (mesh.layer[at(h)] != 0) continue;
    const double v = hex_volume(mesh.corners(h));
    volume.push_back(v > 0 ? v : 0);
    reference = std::max(reference, volume.back());
  }
  reference = comm.max(reference);
  for (int pass = 0; pass < 2 && reference > 0; ++pass) {
    std::int64_t sum = 0;
    for (const double v : volume) sum += to_units(v / reference);
    reference *= from_units(comm.sum(sum)) / static_cast<double>(elements);
  }
  return reference;
}

}  // namespace

UnstructuredMesh unstructured_mesh(const Comm& comm, const ElementShare& share, int layers) {
  UnstructuredMesh mesh;
  HexMesh& cells = mesh.cells;
  std::vector<std::array<GlobalId, 8>> corners;
  std::vector<std::int32_t> owners;
  {
    const IdIndex own(share.corner);
    const NodeRanks directory(comm, share, own);
    GhostCollector collector(comm, share, own, directory);
    for (int layer = 1; layer <= layers; ++layer) collector.add_layer(layer);
    collectively(comm, "building the mesh of a rank", [&] {
      check(layers >= 1 && layers <= 255, "a number of ghost layers");
      corners = merge_cells(comm, share, collector.take(), mesh);
      const IdIndex nodes(corners);
      cells.node_id = nodes.ids();
      cells.hexes.resize(corners.size());
      for (std::size_t h = 0; h < corners.size(); ++h)
        for (std::size_t c = 0; c < 8; ++c) cells.hexes[h][c] = nodes.index(corners[h][c]);
      corners = {};
    });
    cells.node_owner = directory.owners(cells.node_id);
  }
  cells.position = positions_of(comm, share, cells.node_id);
  cells.box_sides.assign(cells.node_id.size(), 0);
  cells.colour.assign(cells.node_id.size(), kNoColour);
  cells.ghost_layers = layers;
  mesh.value = share.value;
  if (const double volume = mean_volume(comm, cells, share.elements); volume > 0) {
    const double edge = std::cbrt(volume);
    cells.cell_size = {edge, edge, edge};
  }
  connect_ranks(comm, cells);
  colour_nodes(cells, cells.colour);
  return mesh;
}

}  // namespace sculpt
