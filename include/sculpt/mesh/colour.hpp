#pragma once
// Colours of the nodes of any hex mesh, so that nodes of one colour may move at the same time.
#include <cstdint>
#include <span>

#include "sculpt/mesh/hex_mesh.hpp"

namespace sculpt {

inline constexpr std::uint8_t kFirstFreeColour = 8;  // below: the parities of a lattice
inline constexpr std::uint8_t kNoColour = 255;

// Collective. Sets mesh.colour of all local nodes and mesh.colours. preset: per local node (ghosts as their
// owners have it; may be mesh.colour) a colour that it keeps and no other node of its hexes has, or
// kNoColour. Nodes without one get a colour from kFirstFreeColour upwards that no other node of their hexes
// has; it depends on ids, connectivity, preset colours and turns only. Needs the exchange of nodes and one
// complete ghost layer of hexes. Work: a pass over the hexes, the rest in proportion to the nodes without a
// preset colour. turns: per local node, the same on all ranks: nodes with a smaller one choose first, then
// those with a smaller id; empty: drawn by lot. Every time that nodes of different ranks have to wait for
// each other costs a round of messages, so turns that keep neighbours of one turn on one rank are good.
void colour_nodes(HexMesh& mesh, std::span<const std::uint8_t> preset,
                  std::span<const std::uint8_t> turns = {});

}  // namespace sculpt
