#include "mesh.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "random.hpp"

namespace hexmesh {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// new_number[old] of a random order; `group` never mixes: numbers stay within runs of equal groups.
std::vector<std::int32_t> random_numbers(std::size_t n, const std::vector<std::int32_t>& group,
                                         microstructure::Random& random) {
  std::vector<std::int32_t> number(n);
  std::iota(number.begin(), number.end(), 0);
  for (std::size_t begin = 0, end = 0; begin < n; begin = end) {
    while (end < n && (group.empty() || group[end] == group[begin])) ++end;
    for (std::size_t i = begin + 1; i < end; ++i) {
      const std::int64_t pick = random.below(static_cast<std::int64_t>(i - begin) + 1);
      std::swap(number[i], number[begin + static_cast<std::size_t>(pick)]);
    }
  }
  return number;
}

template <class T>
void renumber(std::vector<T>& items, const std::vector<std::int32_t>& number) {
  std::vector<T> moved(items.size());
  for (std::size_t i = 0; i < items.size(); ++i) moved[at(number[i])] = items[i];
  items = std::move(moved);
}

}  // namespace

sculpt::HexCorners Mesh::corners(std::size_t h) const {
  sculpt::HexCorners p;
  for (std::size_t c = 0; c < 8; ++c) p[c] = node[at(hex[h][c])];
  return p;
}

void sort_by_block(Mesh& mesh) {
  std::vector<std::int32_t> order(mesh.hex.size()), number(mesh.hex.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::int32_t a, std::int32_t b) { return mesh.block[at(a)] < mesh.block[at(b)]; });
  for (std::size_t i = 0; i < order.size(); ++i) number[at(order[i])] = static_cast<std::int32_t>(i);
  renumber(mesh.hex, number);
  renumber(mesh.block, number);
}

std::vector<Face> faces_of(const Mesh& mesh) {
  std::vector<Face> faces;
  std::map<Quad, std::size_t> seen;  // sorted nodes -> place in faces
  for (std::size_t h = 0; h < mesh.hex.size(); ++h)
    for (std::int32_t side = 0; side < 6; ++side) {
      Quad nodes;
      for (std::size_t c = 0; c < 4; ++c) nodes[c] = mesh.hex[h][at(sculpt::kFaces[at(side)][c])];
      Quad key = nodes;
      std::sort(key.begin(), key.end());
      const auto number = static_cast<std::int32_t>(h);
      const auto [place, is_new] = seen.try_emplace(key, faces.size());
      if (is_new)
        faces.push_back({number, side, -1, nodes});
      else
        faces[place->second].across = number;
    }
  return faces;
}

void add_side_set(Mesh& mesh, std::int64_t id, const std::string& name,
                  const std::function<bool(const Vec3&)>& on_it) {
  Mesh::SideSet set{id, name, {}, {}};
  for (const Face& f : faces_of(mesh)) {
    if (f.across >= 0) continue;
    if (!std::all_of(f.nodes.begin(), f.nodes.end(), [&](std::int32_t n) { return on_it(mesh.node[at(n)]); }))
      continue;
    set.element.push_back(f.hex);
    set.side.push_back(f.side);
  }
  mesh.side_sets.push_back(std::move(set));
}

void add_interface(Mesh& mesh, std::int64_t id, const std::string& name, std::int32_t a, std::int32_t b) {
  Mesh::SideSet set{id, name, {}, {}};
  const auto is_between = [&](std::int32_t hex, std::int32_t across) {
    return across >= 0 && mesh.block[at(hex)] == a && mesh.block[at(across)] == b;
  };
  for (const Face& f : faces_of(mesh)) {
    if (is_between(f.hex, f.across)) {
      set.element.push_back(f.hex);
      set.side.push_back(f.side);
    } else if (f.across >= 0 && is_between(f.across, f.hex)) {
      Quad key = f.nodes;
      std::sort(key.begin(), key.end());
      for (std::int32_t side = 0; side < 6; ++side) {
        Quad nodes;
        for (std::size_t c = 0; c < 4; ++c)
          nodes[c] = mesh.hex[at(f.across)][at(sculpt::kFaces[at(side)][c])];
        std::sort(nodes.begin(), nodes.end());
        if (nodes != key) continue;
        set.element.push_back(f.across);
        set.side.push_back(side);
      }
    }
  }
  mesh.side_sets.push_back(std::move(set));
}

void add_node_set(Mesh& mesh, std::int64_t id, const std::string& name,
                  const std::function<bool(const Vec3&)>& in_it) {
  Mesh::NodeSet set{id, name, {}};
  for (std::size_t n = 0; n < mesh.node.size(); ++n)
    if (in_it(mesh.node[n])) set.node.push_back(static_cast<std::int32_t>(n));
  mesh.node_sets.push_back(std::move(set));
}

void shuffle(Mesh& mesh, std::uint64_t seed) {
  microstructure::Random random(seed);
  const auto hex_number = random_numbers(mesh.hex.size(), mesh.block, random);
  const auto node_number = random_numbers(mesh.node.size(), {}, random);
  renumber(mesh.node, node_number);
  renumber(mesh.hex, hex_number);
  for (Hex& h : mesh.hex)
    for (std::int32_t& n : h) n = node_number[at(n)];
  for (Mesh::SideSet& s : mesh.side_sets)
    for (std::int32_t& e : s.element) e = hex_number[at(e)];
  for (Mesh::NodeSet& s : mesh.node_sets) {
    for (std::int32_t& n : s.node) n = node_number[at(n)];
    std::sort(s.node.begin(), s.node.end());
  }
  for (Mesh::Variable& v : mesh.variables) renumber(v.value, hex_number);
}

}  // namespace hexmesh
