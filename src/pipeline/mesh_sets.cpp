#include "pipeline/mesh_sets.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "pipeline/periodicity.hpp"
#include "pipeline/void_regions.hpp"
#include "sculpt/deck/options.hpp"
#include "sculpt/exo/rank_mesh.hpp"
#include "sculpt/write/boundary_faces.hpp"
#include "sculpt/write/node_sets.hpp"

namespace sculpt {
namespace {

using Ids = std::set<std::int64_t>;

std::string_view value_name(std::string_view option, int number) {
  for (const EnumValue& value : find_option(option)->values)
    if (value.number == number) return value.name;
  return "";
}

// Which option makes the set with an id.
class Makers {
 public:
  explicit Makers(const char* kind) : kind_(kind) {}
  void add(std::int64_t id, const std::string& maker) {
    const auto [found, is_new] = maker_.try_emplace(id, maker);
    if (!is_new && found->second != maker)
      throw Error(fmt::format("{} {} is made by {} and by {}; expected another id in one of them", kind_, id,
                              found->second, maker));
  }

 private:
  const char* kind_;
  std::map<std::int64_t, std::string> maker_;
};

std::string option_at(const Deck& deck, std::string_view option) {
  return fmt::format("{} ({})", option, deck.given_options.place(option));
}

std::map<std::int64_t, std::vector<Box>> boxes_by_id(const std::vector<IdBox>& lines, const Vec3& cell_size) {
  std::map<std::int64_t, std::vector<Box>> boxes;
  for (const IdBox& line : lines) boxes[line.id].push_back(widened(line.box, cell_size));
  return boxes;
}

void check_length(std::string_view kind, const std::map<std::int64_t, std::string>& names) {
  for (const auto& [id, name] : names)
    if (name.size() > kLongestExodusName)
      throw Error(fmt::format("the name of {} {} has {} characters; Exodus files hold at most {}: {}...",
                              kind, id, name.size(), kLongestExodusName, name.substr(0, 40)));
}

class SetMaker {
 public:
  SetMaker(const Comm& comm, const Deck& deck, const HexMesh& mesh, std::span<const std::int64_t> generated,
           std::vector<SideFace>& faces, WriteOptions& options, const Log& log)
      : comm_(comm),
        deck_(deck),
        mesh_(mesh),
        faces_(faces),
        options_(options),
        log_(log),
        side_ids_(generated.begin(), generated.end()) {
    side_ids_.insert(options.side_sets.begin(), options.side_sets.end());
    for (const NodeSet& set : options.node_sets) node_ids_.insert(set.id);
    if (deck.sideset.empty() && deck.nodeset.empty() && !deck.rve_sets) return;
    neighbours_ = face_neighbours_of_any(mesh);
    boundary_ = boundary_faces(mesh, neighbours_);
  }

  void add_periodic() {
    const auto ids = periodic_node_sets(deck_);
    for (std::size_t d = 0; d < 3; ++d)
      for (const int side : {0, 1})
        if (const std::int64_t id = ids[d][static_cast<std::size_t>(side)]; id != 0) {
          BoxPlace place{0, 0, 0};
          place[d] = side == 0 ? -1 : 1;
          add_nodes(id, places().at_place(place));
        }
  }

  void add_boxes() {
    for (const auto& [id, boxes] : boxes_by_id(deck_.sideset, mesh_.cell_size)) {
      std::vector<SideFace> found;
      for (const Box& box : boxes) {
        const std::vector<SideFace> more = faces_in(mesh_, boundary_, box, id);
        found.insert(found.end(), more.begin(), more.end());
      }
      const auto key = [](const SideFace& f) { return std::tuple(f.hex, f.face); };
      std::sort(found.begin(), found.end(), [&](auto& a, auto& b) { return key(a) < key(b); });
      found.erase(std::unique(found.begin(), found.end(), [&](auto& a, auto& b) { return key(a) == key(b); }),
                  found.end());
      warn_if_empty("sideset", "face", id, found.empty());
      faces_.insert(faces_.end(), found.begin(), found.end());
      options_.side_sets.push_back(id);
      side_ids_.insert(id);
    }
    for (const auto& [id, boxes] : boxes_by_id(deck_.nodeset, mesh_.cell_size)) {
      std::vector<LocalId> found;
      for (const Box& box : boxes) {
        const std::vector<LocalId> more = nodes_in(mesh_, boundary_, box);
        found.insert(found.end(), more.begin(), more.end());
      }
      std::sort(found.begin(), found.end());
      found.erase(std::unique(found.begin(), found.end()), found.end());
      warn_if_empty("nodeset", "node", id, found.empty());
      add_nodes(id, std::move(found));
    }
  }

  // After all others: ids follow theirs.
  void add_rve() {
    std::int64_t id = node_ids_.empty() ? 0 : *node_ids_.rbegin();
    for (const BoxPlace& place : box_places()) {
      options_.node_set_names.emplace(++id, place_name(place));
      add_nodes(id, places().at_place(place));
    }
    const Contacts contacts = find_contacts(comm_, mesh_, neighbours_, boundary_);
    const std::int64_t first = (side_ids_.empty() ? 0 : *side_ids_.rbegin()) + 1;
    for (SideFace f : contacts.faces) {
      f.set += first;
      faces_.push_back(f);
    }
    for (std::size_t i = 0; i < contacts.pairs.size(); ++i)
      options_.side_set_names.emplace(first + static_cast<std::int64_t>(i), name_of(contacts.pairs[i]));
  }

  // All ids that the files will have.
  void list_side_sets() {
    std::vector<std::int64_t> ids;
    for (const SideFace& f : faces_) ids.push_back(f.set);
    const Ids mine(ids.begin(), ids.end());
    ids = comm_.concatenate(std::vector<std::int64_t>(mine.begin(), mine.end()));
    Ids all(ids.begin(), ids.end());
    all.insert(options_.side_sets.begin(), options_.side_sets.end());
    options_.side_sets.assign(all.begin(), all.end());
  }

  [[nodiscard]] const Ids& node_ids() const { return node_ids_; }

 private:
  void add_nodes(std::int64_t id, std::vector<LocalId> nodes) {
    options_.node_sets.push_back({id, std::move(nodes)});
    node_ids_.insert(id);
  }
  [[nodiscard]] const NodesOfBox& places() {
    if (!places_) places_.emplace(mesh_);
    return *places_;
  }
  void warn_if_empty(const char* option, const char* item, std::int64_t id, bool empty) const {
    if (comm_.min(std::int64_t{empty}) == 1)
      log_.line("WARNING: {} {}: no {} on the boundary of the mesh lies in its box; the set is empty", option,
                id, item);
  }
  [[nodiscard]] std::string block_name(std::int32_t material) const {
    const std::int64_t id = options_.block_id[at(material)];
    const auto found = options_.block_names.find(id);
    return found != options_.block_names.end() ? found->second : fmt::format("{}", id);
  }
  [[nodiscard]] std::string name_of(const BlockPair& pair) const {
    return fmt::format("{}_{}", block_name(pair.first),
                       pair.second == BlockPair::kNothing ? "free" : block_name(pair.second));
  }

  const Comm& comm_;
  const Deck& deck_;
  const HexMesh& mesh_;
  std::vector<SideFace>& faces_;
  WriteOptions& options_;
  const Log& log_;
  Ids side_ids_, node_ids_;
  FaceNeighbours neighbours_;
  std::vector<BoundaryFace> boundary_;
  std::optional<NodesOfBox> places_;
};

void warn_of_names(const Log& log, const char* option, const std::vector<IdName>& names, const Ids& known) {
  for (const IdName& n : names)
    if (!known.contains(n.id))
      log.line("WARNING: {} = {} {}: the mesh has nothing with this id; no effect", option, n.id, n.name);
}

}  // namespace

std::vector<std::string> idle_set_options(const Deck& deck, const MaterialTable& materials) {
  std::vector<std::string> told;
  if (deck.separate_void_blocks && !deck.mesh_void)
    told.push_back("the void is not meshed; no effect: separate_void_blocks");
  else if (deck.separate_void_blocks && !void_block(deck, materials))
    told.push_back(
        "no material of the input is void, and void_mat names none of them; no effect: separate_void_blocks");
  if (deck.compute_ss_stats && deck.gen_sidesets == kSidesetsOff && deck.sideset.empty() && !deck.rve_sets)
    told.push_back("the mesh has no sidesets; no effect: compute_ss_stats");
  return told;
}

void check_set_ids(const Deck& deck, std::span<const std::int64_t> generated, const InputSets& carried) {
  Makers sides("side set"), nodes("node set");
  const std::string by_generator =
      fmt::format("gen_sidesets = {}", value_name("gen_sidesets", deck.gen_sidesets));
  for (const std::int64_t id : generated) sides.add(id, by_generator);
  for (const InputSets::Set& set : carried.side_sets) sides.add(set.id, by_generator);
  for (const IdBox& line : deck.sideset) sides.add(line.id, option_at(deck, "sideset"));
  for (const InputSets::Set& set : carried.node_sets) nodes.add(set.id, by_generator);
  for (const std::int64_t id : deck.periodic_nodesets) nodes.add(id, option_at(deck, "periodic_nodesets"));
  for (const IdBox& line : deck.nodeset) nodes.add(line.id, option_at(deck, "nodeset"));
}

void add_mesh_sets(const Comm& comm, const Deck& deck, const HexMesh& mesh,
                   std::span<const std::int64_t> generated, std::span<const std::int64_t> blocks,
                   std::vector<SideFace>& faces, WriteOptions& options, const Log& log) {
  SetMaker maker(comm, deck, mesh, generated, faces, options, log);
  maker.add_periodic();
  maker.add_boxes();
  if (deck.rve_sets) maker.add_rve();
  maker.list_side_sets();
  warn_of_names(log, "material_name", deck.material_name, Ids(blocks.begin(), blocks.end()));
  warn_of_names(log, "sideset_name", deck.sideset_name,
                Ids(options.side_sets.begin(), options.side_sets.end()));
  warn_of_names(log, "nodeset_name", deck.nodeset_name, maker.node_ids());
  check_length("side set", options.side_set_names);
  check_length("node set", options.node_set_names);
}

}  // namespace sculpt
