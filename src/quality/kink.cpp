#include <algorithm>
#include <cmath>
#include <numbers>

#include "sculpt/base/fixed_point.hpp"
#include "sculpt/quality/fidelity.hpp"

namespace sculpt {
namespace {

// Records in the order of their node, in one counting pass.
template <class Record>
class ByNode {
 public:
  ByNode(std::vector<Record> records, std::size_t nodes) : begin_(nodes + 1, 0), sorted_(records.size()) {
    for (const Record& r : records) ++begin_[at(r.node) + 1];
    for (std::size_t n = 1; n < begin_.size(); ++n) begin_[n] += begin_[n - 1];
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (const Record& r : records) sorted_[next[at(r.node)]++] = r;
  }
  [[nodiscard]] std::size_t nodes() const { return begin_.size() - 1; }
  [[nodiscard]] std::span<Record> operator[](std::size_t node) {
    return {sorted_.data() + begin_[node], sorted_.data() + begin_[node + 1]};
  }

 private:
  std::vector<std::uint32_t> begin_;
  std::vector<Record> sorted_;
};

// A face of a hex; node is the least of its four, rest are the others, ascending.
struct Face {
  LocalId node;
  std::array<LocalId, 3> rest;
  LocalId hex;
  std::int32_t face;
};

// A quad between two materials. Its nodes circulate so that the normal points to the larger one.
struct Quad {
  std::array<LocalId, 4> node;
  std::array<std::int32_t, 2> materials;
  Vec3 normal;
};

// An edge of a quad; node < other.
struct Edge {
  LocalId node, other;
  std::int32_t quad;
};

// 1 for nodes of hexes of several materials.
std::vector<std::uint8_t> interface_nodes(const HexMesh& mesh) {
  std::vector<std::int32_t> first(mesh.position.size(), -1);
  std::vector<std::uint8_t> mixed(mesh.position.size(), 0);
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h)
    for (const LocalId n : mesh.hexes[h]) {
      if (first[at(n)] < 0) first[at(n)] = mesh.material[h];
      mixed[at(n)] |= first[at(n)] != mesh.material[h];
    }
  return mixed;
}

// Faces with interface nodes only: all faces between materials are among them.
std::vector<Face> candidates(const HexMesh& mesh) {
  const std::vector<std::uint8_t> mixed = interface_nodes(mesh);
  std::vector<Face> faces;
  for (LocalId h = 0; h < mesh.size(); ++h) {
    const Hex& hex = mesh.hexes[at(h)];
    std::array<bool, 8> on{};
    int count = 0;
    for (std::size_t c = 0; c < 8; ++c) count += on[c] = mixed[at(hex[c])] != 0;
    if (count < 4) continue;
    for (std::int32_t f = 0; f < 6; ++f) {
      std::array<LocalId, 4> nodes;
      bool all = true;
      for (std::size_t v = 0; v < 4; ++v) {
        const auto c = static_cast<std::size_t>(kFaces[at(f)][v]);
        nodes[v] = hex[c];
        all = all && on[c];
      }
      if (!all) continue;
      std::sort(nodes.begin(), nodes.end());
      faces.push_back({nodes[0], {nodes[1], nodes[2], nodes[3]}, h, f});
    }
  }
  return faces;
}

Quad quad_of(const HexMesh& mesh, const Face& face, std::int32_t towards) {
  Quad quad;
  std::array<Vec3, 4> p;
  for (std::size_t v = 0; v < 4; ++v) {
    quad.node[v] = mesh.hexes[at(face.hex)][static_cast<std::size_t>(kFaces[at(face.face)][v])];
    p[v] = mesh.position[at(quad.node[v])];
  }
  quad.materials = {mesh.material[at(face.hex)], towards};
  quad.normal = unit(cross(p[2] - p[0], p[3] - p[1]));
  return quad;
}

// Local quads, and how many of them belong to this rank: those whose hex of the smaller material it owns.
std::vector<Quad> interface_quads(const HexMesh& mesh, std::int64_t& owned) {
  std::vector<Quad> quads;
  ByNode<Face> faces(candidates(mesh), mesh.position.size());
  for (std::size_t n = 0; n < faces.nodes(); ++n) {
    const std::span<Face> here = faces[n];
    for (std::size_t i = 0; i < here.size(); ++i)
      for (std::size_t j = i + 1; j < here.size(); ++j) {
        if (here[i].rest != here[j].rest) continue;
        const std::int32_t a = mesh.material[at(here[i].hex)], b = mesh.material[at(here[j].hex)];
        if (a == b) continue;
        const Face& lower = a < b ? here[i] : here[j];
        quads.push_back(quad_of(mesh, lower, std::max(a, b)));
        owned += mesh.layer[at(lower.hex)] == 0;
      }
  }
  return quads;
}

double angle_between(const Vec3& a, const Vec3& b) { return std::acos(std::clamp(dot(a, b), -1.0, 1.0)); }

}  // namespace

Kink measure_kink(const Comm& comm, const HexMesh& mesh) {
  std::array<std::int64_t, 3> sums{};  // quads, edges, radians in fixed point
  const std::vector<Quad> quads = interface_quads(mesh, sums[0]);
  std::vector<Edge> list;
  list.reserve(4 * quads.size());
  for (std::size_t q = 0; q < quads.size(); ++q)
    for (std::size_t v = 0; v < 4; ++v) {
      const auto [a, b] = std::minmax(quads[q].node[v], quads[q].node[(v + 1) % 4]);
      if (mesh.node_owner[at(a)] == comm.rank()) list.push_back({a, b, static_cast<std::int32_t>(q)});
    }
  ByNode<Edge> edges(std::move(list), mesh.position.size());
  for (std::size_t n = 0; n < edges.nodes(); ++n) {
    const std::span<Edge> here = edges[n];
    std::sort(here.begin(), here.end(), [](const Edge& a, const Edge& b) { return a.other < b.other; });
    for (std::size_t i = 0, end; i < here.size(); i = end) {
      for (end = i + 1; end < here.size() && here[end].other == here[i].other;) ++end;
      if (end - i != 2) continue;
      const Quad &a = quads[at(here[i].quad)], &b = quads[at(here[i + 1].quad)];
      if (a.materials != b.materials) continue;
      ++sums[1];
      sums[2] += to_units(angle_between(a.normal, b.normal));
    }
  }
  comm.sum(sums);
  Kink kink{sums[0], sums[1], 0};
  if (kink.edges > 0)
    kink.mean = from_units(sums[2]) / static_cast<double>(kink.edges) * 180 / std::numbers::pi;
  return kink;
}

}  // namespace sculpt
