#pragma once
// A hex mesh being made: plain arrays, numbers from 0. The same command gives the same mesh to the last bit
// on every machine: coordinates come from +, -, *, / and sqrt alone, which are rounded alike everywhere.
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "sculpt/base/vec3.hpp"
#include "sculpt/geom/hex.hpp"

namespace hexmesh {

using sculpt::Vec3;
using Quad = std::array<std::int32_t, 4>;
using sculpt::Hex;

struct Mesh {
  struct Block {
    std::int64_t id = 0;
    std::string name;
  };
  struct SideSet {
    std::int64_t id = 0;
    std::string name;
    std::vector<std::int32_t> element, side;  // side: 0..5, index into sculpt::kFaces
  };
  struct NodeSet {
    std::int64_t id = 0;
    std::string name;
    std::vector<std::int32_t> node;  // ascending
  };
  struct Variable {
    std::string name;
    std::vector<double> value;  // per hex
  };

  std::vector<Vec3> node;
  std::vector<Hex> hex;             // Exodus order, right-handed
  std::vector<std::int32_t> block;  // per hex: index into blocks, never descending
  std::vector<Block> blocks;
  std::vector<SideSet> side_sets;
  std::vector<NodeSet> node_sets;
  std::vector<Variable> variables;

  [[nodiscard]] sculpt::HexCorners corners(std::size_t h) const;
};

// Sorts the hexes by block, keeping their order otherwise. To be called before sets and variables are added.
void sort_by_block(Mesh& mesh);

// A face and the hexes on its two sides; across is -1 at the boundary of the mesh.
struct Face {
  std::int32_t hex, side, across;
  Quad nodes;
};
// Every face once, seen from the hex with the smaller number; ascending in (hex, side).
[[nodiscard]] std::vector<Face> faces_of(const Mesh& mesh);

// The faces of the boundary whose four nodes all satisfy a condition.
void add_side_set(Mesh& mesh, std::int64_t id, const std::string& name,
                  const std::function<bool(const Vec3&)>& on_it);
// The faces between blocks[a] and blocks[b], as faces of the hexes of blocks[a].
void add_interface(Mesh& mesh, std::int64_t id, const std::string& name, std::int32_t a, std::int32_t b);
void add_node_set(Mesh& mesh, std::int64_t id, const std::string& name,
                  const std::function<bool(const Vec3&)>& in_it);

// Shuffles nodes and the hexes of each block; sets and variables follow.
void shuffle(Mesh& mesh, std::uint64_t seed);

// Adds a polycrystal as variables vf_1 .. vf_n: Voronoi cells of seeds scattered over the mesh and evened
// out, sampled at 4 x 4 x 4 points of every hex.
void add_grains(Mesh& mesh, std::int32_t grains, std::uint64_t seed);

// An Exodus file. Throws sculpt::Error; there is no file then.
void write_mesh(const std::string& path, const Mesh& mesh, const std::string& title);

}  // namespace hexmesh
