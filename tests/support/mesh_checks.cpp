#include "support/mesh_checks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <map>

#include "sculpt/mesh/adjacency.hpp"
#include "support/cases.hpp"

namespace sculpt::test {
namespace {

struct Face {
  std::array<LocalId, 4> sorted, around;
  LocalId hex;
  int face;
};

std::vector<Face> sorted_faces(const HexMesh& mesh) {
  std::vector<Face> faces;
  faces.reserve(6 * mesh.hexes.size());
  for (LocalId h = 0; h < mesh.size(); ++h)
    for (int f = 0; f < 6; ++f) {
      Face face{{}, {}, h, f};
      for (std::size_t v = 0; v < 4; ++v)
        face.around[v] = mesh.hexes[at(h)][static_cast<std::size_t>(kFaces[static_cast<std::size_t>(f)][v])];
      face.sorted = face.around;
      std::sort(face.sorted.begin(), face.sorted.end());
      faces.push_back(face);
    }
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.sorted < b.sorted; });
  return faces;
}

// Whether b runs through the nodes of a the other way round.
bool opposite(const std::array<LocalId, 4>& a, const std::array<LocalId, 4>& b) {
  const auto start = static_cast<std::size_t>(std::find(b.begin(), b.end(), a[0]) - b.begin());
  for (std::size_t v = 0; v < 4; ++v)
    if (a[v] != b[(start + 4 - v) % 4]) return false;
  return true;
}

std::string face_text(const HexMesh& mesh, const Face& f) {
  return fmt::format("face {} of hex {}", f.face, mesh.hex_id[at(f.hex)]);
}

std::string node_problem(const HexMesh& mesh, int pillows, int of_the_box) {
  const GlobalId copies = GlobalId{1}
                          << (6 * (pillows - of_the_box) + of_the_box);  // ids of the copies of one grid node
  std::vector<std::uint8_t> used(mesh.position.size(), 0);
  for (const Hex& hex : mesh.hexes) {
    for (const LocalId n : hex) used[at(n)] = 1;
    for (std::size_t a = 0; a < 8; ++a)
      for (std::size_t b = 0; b < a; ++b) {
        if (hex[a] == hex[b]) return fmt::format("a hex has node {} twice", mesh.node_id[at(hex[a])]);
        if (mesh.colour[at(hex[a])] == mesh.colour[at(hex[b])] &&
            mesh.node_id[at(hex[a])] / copies != mesh.node_id[at(hex[b])] / copies)
          return fmt::format("nodes {} and {} of one hex have one colour", mesh.node_id[at(hex[a])],
                             mesh.node_id[at(hex[b])]);
      }
  }
  for (std::size_t n = 0; n < used.size(); ++n)
    if (!used[n]) return fmt::format("node {} is in no hex", mesh.node_id[n]);
  if (std::adjacent_find(mesh.node_id.begin(), mesh.node_id.end(), std::greater_equal<>()) !=
      mesh.node_id.end())
    return "node ids do not ascend";
  if (std::adjacent_find(mesh.hex_id.begin(), mesh.hex_id.end(), std::greater_equal<>()) != mesh.hex_id.end())
    return "hex ids do not ascend";
  return {};
}

}  // namespace

std::string conformity_problem(const HexMesh& mesh, int pillows, int of_the_box) {
  if (std::string problem = node_problem(mesh, pillows, of_the_box); !problem.empty()) return problem;
  const std::vector<Face> faces = sorted_faces(mesh);
  std::map<std::pair<LocalId, LocalId>, int> boundary_edges;  // directed, minus its opposite
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t last = i + 1;
    while (last < faces.size() && faces[last].sorted == faces[i].sorted) ++last;
    if (last - i > 2) return fmt::format("{} hexes share {}", last - i, face_text(mesh, faces[i]));
    if (last - i == 2 && !opposite(faces[i].around, faces[i + 1].around))
      return face_text(mesh, faces[i]) + " is seen from one side by both its hexes";
    if (last - i == 1)
      for (std::size_t v = 0; v < 4; ++v) {
        const LocalId a = faces[i].around[v], b = faces[i].around[(v + 1) % 4];
        boundary_edges[std::minmax(a, b)] += a < b ? 1 : -1;
      }
    i = last;
  }
  for (const auto& [edge, count] : boundary_edges)
    if (count != 0)
      return fmt::format("the boundary is open at the edge {} {}", mesh.node_id[at(edge.first)],
                         mesh.node_id[at(edge.second)]);
  return {};
}

std::string boundary_problem(const HexMesh& mesh) {
  const std::vector<Face> faces = sorted_faces(mesh);
  for (std::size_t i = 0; i < faces.size();) {
    const bool single = i + 1 == faces.size() || faces[i + 1].sorted != faces[i].sorted;
    const bool on_box = face_sides(mesh, faces[i].hex, faces[i].face) != 0;
    if (single && !on_box) return face_text(mesh, faces[i]) + " has one hex inside the box";
    // A hex of an expansion-free one-cell corner may have all nodes of an inner face on one side only if it
    // is flat.
    if (!single && on_box) return face_text(mesh, faces[i]) + " lies on the box and has two hexes";
    i += single ? 1 : 2;
  }
  return {};
}

std::string box_problem(const HexMesh& mesh, const Grid& grid) {
  for (std::size_t n = 0; n < mesh.position.size(); ++n)
    for (std::size_t d = 0; d < 3; ++d) {
      const double x = mesh.position[n][d], lo = grid.planes[d].front(), hi = grid.planes[d].back();
      const unsigned sides = mesh.box_sides[n] >> (2 * d) & 3U;
      const bool right = sides == 0 ? x > lo && x < hi : x == (sides == 1 ? lo : hi);
      if (!right)
        return fmt::format("node {}: coordinate {} on axis {} with sides {}", mesh.node_id[n], x, d, sides);
    }
  return {};
}

std::string ghost_problem(const HexMesh& mesh) {
  const Comm& comm = mesh.node_exchange.comm();
  std::string problem;
  HexMesh shared = mesh;
  share_positions(shared);
  for (std::size_t n = 0; n < mesh.position.size(); ++n)
    if (shared.position[n] != mesh.position[n])
      problem = fmt::format("rank {}: ghost node {} stands elsewhere", comm.rank(), mesh.node_id[n]);
  std::vector<std::int32_t> material = mesh.material;
  mesh.hex_exchange.copy_to_ghosts(material);
  if (material != mesh.material)
    problem = fmt::format("rank {}: a ghost hex has another material", comm.rank());
  using IdHex = std::array<GlobalId, 8>;
  std::vector<IdHex> nodes(mesh.hexes.size());
  for (std::size_t h = 0; h < nodes.size(); ++h)
    for (std::size_t c = 0; c < 8; ++c) nodes[h][c] = mesh.node_homes()[at(mesh.hexes[h][c])];
  const std::vector<IdHex> mine = nodes;
  mesh.hex_exchange.copy_to_ghosts(nodes);
  std::vector<HexCorners> shape(mesh.hexes.size());
  for (LocalId h = 0; h < mesh.size(); ++h)
    for (std::size_t c = 0; c < 8; ++c) shape[at(h)][c] = mesh.corners(h)[c] - mesh.corners(h)[0];
  const std::vector<HexCorners> my_shape = shape;
  mesh.hex_exchange.copy_to_ghosts(shape);
  if (shape != my_shape) problem = fmt::format("rank {}: a ghost hex has another shape", comm.rank());
  for (std::size_t h = 0; h < nodes.size(); ++h) {
    if (nodes[h] != mine[h])
      problem = fmt::format("rank {}: ghost hex {} of layer {} has other nodes", comm.rank(), mesh.hex_id[h],
                            mesh.layer[h]);
    if ((mesh.layer[h] == 0) != (mesh.hex_owner[h] == comm.rank()) || mesh.layer[h] > mesh.ghost_layers)
      problem = fmt::format("rank {}: hex {} of rank {} in layer {}", comm.rank(), mesh.hex_id[h],
                            mesh.hex_owner[h], mesh.layer[h]);
  }
  const auto first = static_cast<int>(comm.min(std::int64_t{problem.empty() ? comm.size() : comm.rank()}));
  return first == comm.size() ? "" : comm.broadcast(problem, first);
}

double volume(const Grid& grid) {
  double v = 1;
  for (const auto& p : grid.planes) v *= p.back() - p.front();
  return v;
}

std::vector<double> volumes(const HexMesh& mesh, std::int32_t materials) {
  std::vector<double> sum(static_cast<std::size_t>(materials), 0);
  for (LocalId h = 0; h < mesh.size(); ++h)
    if (mesh.layer[at(h)] == 0)
      sum[static_cast<std::size_t>(mesh.material[at(h)])] += hex_volume(mesh.corners(h));
  return sum;
}

double volume(const HexMesh& mesh) {
  double sum = 0;
  for (LocalId h = 0; h < mesh.size(); ++h)
    if (mesh.layer[at(h)] == 0) sum += hex_volume(mesh.corners(h));
  return sum;
}

double least_scaled_jacobian(const HexMesh& mesh) {
  double least = 1;
  for (LocalId h = 0; h < mesh.size(); ++h)
    if (mesh.layer[at(h)] == 0) least = std::min(least, scaled_jacobian(mesh.corners(h)));
  return least;
}

std::int64_t owned_hexes(const HexMesh& mesh) {
  return std::count(mesh.layer.begin(), mesh.layer.end(), std::uint8_t{0});
}

std::int64_t interface_faces(const HexMesh& mesh) {
  const std::vector<Face> faces = sorted_faces(mesh);
  std::int64_t count = 0;
  for (std::size_t i = 0; i + 1 < faces.size(); ++i)
    count += faces[i].sorted == faces[i + 1].sorted &&
             mesh.material[at(faces[i].hex)] != mesh.material[at(faces[i + 1].hex)];
  return count;
}

std::int64_t checksum(const Comm& comm, const HexMesh& mesh) {
  std::int64_t sum = 0;
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
    if (mesh.layer[h] != 0) continue;
    std::uint64_t mix = static_cast<std::uint64_t>(mesh.hex_id[h]);
    const auto add = [&mix](std::uint64_t word) { mix = scatter(mix, word); };
    add(static_cast<std::uint64_t>(mesh.material[h]));
    for (const LocalId n : mesh.hexes[h]) {
      add(static_cast<std::uint64_t>(mesh.node_id[at(n)]));
      add(mesh.box_sides[at(n)]);
      for (std::size_t d = 0; d < 3; ++d) add(std::bit_cast<std::uint64_t>(mesh.position[at(n)][d]));
    }
    sum += static_cast<std::int64_t>(mix >> 24);  // room for a million hexes
  }
  return comm.sum(sum);
}

}  // namespace sculpt::test
