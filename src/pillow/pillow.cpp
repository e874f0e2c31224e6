#include "sculpt/pillow/pillow.hpp"

#include <algorithm>
#include <map>

#include "sculpt/mesh/adjacency.hpp"

namespace sculpt {
namespace {

constexpr GlobalId kNodeFactor = 64, kHexFactor = 8;

// The faces of a hex that hold a corner.
constexpr std::array<std::array<int, 3>, 8> kCornerFaces = [] {
  std::array<std::array<int, 3>, 8> faces{};
  for (int c = 0; c < 8; ++c) {
    std::size_t k = 0;
    for (int f = 0; f < 6; ++f)
      for (const int v : kFaces[static_cast<std::size_t>(f)])
        if (v == c) faces[static_cast<std::size_t>(c)][k++] = f;
  }
  return faces;
}();

class Pillower {
 public:
  Pillower(const HexMesh& mesh, std::span<const std::int32_t> label, std::span<const std::uint8_t> drop,
           double offset)
      : mesh_(mesh),
        label_(label),
        drop_(drop),
        offset_(offset),
        neighbours_(face_neighbours(mesh)),
        kept_layers_(mesh.ghost_layers - 1) {}

  Pillowed run(const Comm& comm) {
    mark_nodes();
    number_nodes();
    make_hexes();
    drop_unused_nodes();
    HexMesh& out = result_.mesh;
    out.colours = mesh_.colours;
    out.ghost_layers = kept_layers_;
    out.cell_size = mesh_.cell_size;
    out.node_exchange = GhostExchange(comm, out.node_id, out.node_owner);
    out.hex_exchange = GhostExchange(comm, out.hex_id, out.hex_owner);
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool kept(LocalId h) const { return mesh_.layer[at(h)] <= kept_layers_; }
  // Whether a new hex goes on this face.
  [[nodiscard]] bool pillowed(LocalId h, int face) const {
    const LocalId other = neighbours_[at(h)][static_cast<std::size_t>(face)];
    return other != kNone && label_[at(h)] >= 0 && label_[at(other)] != label_[at(h)];
  }

  void mark_nodes() {
    on_boundary_.assign(mesh_.position.size(), 0);
    for (LocalId h = 0; h < mesh_.size(); ++h)
      for (int f = 0; f < 6; ++f)
        if (pillowed(h, f))
          for (const int c : kFaces[static_cast<std::size_t>(f)])
            on_boundary_[at(mesh_.hexes[at(h)][static_cast<std::size_t>(c)])] = 1;
  }

  void add_node(LocalId from, GlobalId copy, const Vec3& position) {
    HexMesh& out = result_.mesh;
    out.position.push_back(position);
    out.node_id.push_back(kNodeFactor * mesh_.node_id[at(from)] + copy);
    out.node_owner.push_back(mesh_.node_owner[at(from)]);
    out.box_sides.push_back(mesh_.box_sides[at(from)]);
    out.colour.push_back(mesh_.colour[at(from)]);
    result_.source.push_back(from);
    result_.copied.push_back(copy != 0);
  }

  // Gives every old node, followed by its copies, a new number; corner_ tells which one a hex takes at a
  // corner.
  void number_nodes() {
    const NodeHexes around(mesh_);
    corner_.resize(mesh_.hexes.size());
    first_.resize(mesh_.position.size());
    result_.mesh.position.reserve(mesh_.position.size());
    for (LocalId n = 0; n < mesh_.nodes(); ++n) {
      first_[at(n)] = static_cast<LocalId>(result_.mesh.position.size());
      add_node(n, 0, mesh_.position[at(n)]);
      const auto items = around[n];
      for (const std::int32_t item : items)
        corner_[at(item / 8)][static_cast<std::size_t>(item % 8)] = first_[at(n)];
      if (on_boundary_[at(n)]) copy_node(n, items);
    }
  }

  // One copy for every face-connected group of equally labelled hexes at the node that has a pillowed face
  // there.
  void copy_node(LocalId node, std::span<const std::int32_t> items) {
    done_.assign(items.size(), 0);
    GlobalId copies = 0;
    for (std::size_t first = 0; first < items.size(); ++first) {
      if (done_[first] || label_[at(items[first] / 8)] < 0) continue;
      done_[first] = 1;
      group_.assign(1, items[first]);
      bool wanted = false;
      for (std::size_t g = 0; g < group_.size(); ++g) {
        const LocalId h = group_[g] / 8;
        for (const int f : kCornerFaces[static_cast<std::size_t>(group_[g] % 8)]) {
          wanted = wanted || pillowed(h, f);
          const LocalId other = neighbours_[at(h)][static_cast<std::size_t>(f)];
          if (other == kNone || label_[at(other)] != label_[at(h)]) continue;
          for (std::size_t i = 0; i < items.size(); ++i)
            if (!done_[i] && items[i] / 8 == other) {
              done_[i] = 1;
              group_.push_back(items[i]);
            }
        }
      }
      if (!wanted) continue;
      check(++copies < kNodeFactor, "a node needs more than 63 pillow copies");
      std::sort(group_.begin(), group_.end());
      add_node(node, copies, inside_of(node));
      for (const std::int32_t item : group_)
        corner_[at(item / 8)][static_cast<std::size_t>(item % 8)] = result_.mesh.nodes() - 1;
    }
  }

  // From the node towards the mean centroid of the group, on its box sides.
  [[nodiscard]] Vec3 inside_of(LocalId node) const {
    Vec3 sum;
    for (const std::int32_t item : group_)
      for (const LocalId n : mesh_.hexes[at(item / 8)]) sum += mesh_.position[at(n)];
    const Vec3 centre = (1.0 / (8.0 * static_cast<double>(group_.size()))) * sum;
    const Vec3 p = mesh_.position[at(node)];
    return p + held_on_box(offset_ * (centre - p), mesh_.box_sides[at(node)]);
  }

  void make_hexes() {
    std::size_t count = 0;
    for (LocalId h = 0; h < mesh_.size(); ++h)
      if (kept(h) && !drop_[at(h)]) {
        ++count;
        for (int f = 0; f < 6; ++f) count += pillowed(h, f);
      }
    HexMesh& out = result_.mesh;
    out.hexes.reserve(count);
    out.hex_id.reserve(count);
    out.hex_owner.reserve(count);
    out.layer.reserve(count);
    out.material.reserve(count);
    for (LocalId h = 0; h < mesh_.size(); ++h) {
      if (!kept(h) || drop_[at(h)]) continue;
      add_hex(h, 0, corner_[at(h)]);
      for (int f = 0; f < 6; ++f) {
        if (!pillowed(h, f)) continue;
        Hex hex;  // bottom: the copies; top: the old quad
        for (std::size_t v = 0; v < 4; ++v) {
          const auto c = static_cast<std::size_t>(kFaces[static_cast<std::size_t>(f)][v]);
          hex[v] = corner_[at(h)][c];
          hex[v + 4] = first_[at(mesh_.hexes[at(h)][c])];
        }
        add_hex(h, f + 1, hex);
      }
    }
  }
  void add_hex(LocalId from, GlobalId which, const Hex& hex) {
    HexMesh& out = result_.mesh;
    out.hexes.push_back(hex);
    out.hex_id.push_back(kHexFactor * mesh_.hex_id[at(from)] + which);
    out.hex_owner.push_back(mesh_.hex_owner[at(from)]);
    out.layer.push_back(mesh_.layer[at(from)]);
    out.material.push_back(mesh_.material[at(from)]);
  }

  void drop_unused_nodes() {
    HexMesh& out = result_.mesh;
    std::vector<LocalId> renumbered(out.position.size(), kNone);
    for (const Hex& hex : out.hexes)
      for (const LocalId n : hex) renumbered[at(n)] = 0;
    LocalId next = 0;
    for (std::size_t n = 0; n < renumbered.size(); ++n) {
      if (renumbered[n] == kNone) continue;
      const std::size_t to = at(next);
      out.position[to] = out.position[n];
      out.node_id[to] = out.node_id[n];
      out.node_owner[to] = out.node_owner[n];
      out.box_sides[to] = out.box_sides[n];
      out.colour[to] = out.colour[n];
      result_.source[to] = result_.source[n];
      result_.copied[to] = result_.copied[n];
      renumbered[n] = next++;
    }
    out.position.resize(at(next));
    out.node_id.resize(at(next));
    out.node_owner.resize(at(next));
    out.box_sides.resize(at(next));
    out.colour.resize(at(next));
    result_.source.resize(at(next));
    result_.copied.resize(at(next));
    for (Hex& hex : out.hexes)
      for (LocalId& n : hex) n = renumbered[at(n)];
  }

  const HexMesh& mesh_;
  std::span<const std::int32_t> label_;
  std::span<const std::uint8_t> drop_;
  double offset_;
  FaceNeighbours neighbours_;
  int kept_layers_;
  std::vector<std::uint8_t> on_boundary_;  // per old node: on a pillowed face
  std::vector<LocalId> first_;             // per old node: its new number
  std::vector<Hex> corner_;                // per old hex: new node at each corner
  std::vector<std::int32_t> group_;
  std::vector<std::uint8_t> done_;
  Pillowed result_;
};

}  // namespace

Pillowed pillow(const Comm& comm, const HexMesh& mesh, std::span<const std::int32_t> label,
                std::span<const std::uint8_t> drop, double offset) {
  return Pillower(mesh, label, drop, offset).run(comm);
}

std::vector<std::int32_t> surface_labels(const HexMesh& mesh) {
  const FaceNeighbours neighbours = face_neighbours(mesh);
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> pairs;
  std::vector<std::int32_t> label(mesh.hexes.size(), -1);
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h)
    for (const LocalId other : neighbours[h]) {
      if (other == kNone || mesh.material[at(other)] == mesh.material[h]) continue;
      const auto materials = std::minmax(mesh.material[h], mesh.material[at(other)]);
      label[h] = pairs.try_emplace(materials, static_cast<std::int32_t>(pairs.size())).first->second;
    }
  return label;
}

}  // namespace sculpt
