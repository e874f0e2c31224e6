#pragma once
// Pillowing: layers of buffer hexes around sets of hexes (the report, section 2.11.2). One operator serves
// volume pillows (label = material), surface pillows (label = interface the hex touches), curve pillows
// (label = 0 near poor curves) and boundary pillows (label = 0 everywhere, faces on the box are wrapped).
#include <span>
#include <vector>

#include "sculpt/mesh/adjacency.hpp"
#include "sculpt/mesh/hex_mesh.hpp"

namespace sculpt {

struct PillowRules {
  double offset = 0.3;           // of the way from a node to the middle of its hexes, for copies
  bool along_edges = false;      // to the middle of the edges into the set instead: for sets of thin layers
  std::uint8_t box_sides = 0;    // sides of the box (BoxSide) whose faces are wrapped as well; of an
                                 // exterior all faces are, unless 0
  bool with_neighbours = false;  // of the result
};

// A copy that lies on an interface, because the interface runs through its set.
struct InterfaceCopy {
  LocalId node;        // of the result
  std::int32_t label;  // of its set
  bool on_curve;       // where at least three materials meet; what is left out of the mesh counts as one
  Vec3 direction;      // unit normal of the surface or tangent of the curve; 0 at a vertex
};

struct Pillowed {
  HexMesh mesh;
  GlobalId node_factor = 1;     // an old node that is still there has this times its old id
  std::vector<LocalId> source;  // per node of mesh: the node of the old mesh that it is or was copied from
  std::vector<std::uint8_t> copied;         // per node of mesh: 1 for a copy
  std::vector<InterfaceCopy> on_interface;  // ascending in node
  FaceNeighbours neighbours;                // as face_neighbours(mesh); empty unless asked for
};

// Collective. neighbours: of the mesh; label: per hex the set it belongs to, below 0 = none; drop: per hex,
// not part of the result (the sets see it all the same); may be empty. Every hex of a set receives one new
// hex on each face towards a hex outside its set and on each face on one of rules.box_sides; other faces
// without a neighbour receive none: the layers end there. Facets that must not
// be cut (Facet::whole) are wrapped as well. The new hexes lie between copies of the old nodes,
// moved towards the inside, and the old nodes, which stay. A copy stays on the sides of the box on which the
// hexes that take it keep a face, and on the interfaces that run through their set. Uses up one ghost layer
// of the old mesh.
//
// Ids: node n and its copies become 64 n + 0, 1, ... (2 n + 0, 1 where the box is wrapped); hex h and its new
// neighbours 8 h + 0 and 8 h + face + 1.
[[nodiscard]] Pillowed pillow(const Comm& comm, const HexMesh& mesh, const FaceNeighbours& neighbours,
                              std::span<const std::int32_t> label, std::span<const std::uint8_t> drop,
                              const PillowRules& rules);

// Local. Labels for a surface pillow of a mesh that has a volume pillow: hexes with a face on an interface
// are labelled by the pair of materials there, on both sides alike, all others -1. Each interface surface is
// wrapped as a whole, so that the nodes of its curves receive copies that lie on the surface.
[[nodiscard]] std::vector<std::int32_t> surface_labels(const HexMesh& mesh, const FaceNeighbours& neighbours);

// Collective. The sides of the box on which a hex of any rank has two faces or more: no position of the nodes
// makes such a hex good, a layer on that side does. Only refined grids have them.
[[nodiscard]] std::uint8_t sides_with_flat_hexes(const Comm& comm, const HexMesh& mesh);

// The set of hexes around poor curves.
struct CurveSet {
  std::int64_t poor = 0;            // hexes at curves with a scaled Jacobian below the threshold, all ranks
  std::int64_t wrapped = 0;         // hexes of the set, all ranks
  std::vector<std::int32_t> label;  // per hex: 0 in the set, else -1; empty when no hex is poor
};

// Collective. Curves: edges inside the box where at least three materials meet (what is left out of the mesh
// counts as one); curve_node: per node, 1 where they may run. The set begins with the hexes at the edges that
// have a poor hex and grows until it has `layers` layers of hexes around them. Then it is completed so that
// it holds both sides of every interface face, and so that its boundary is a surface that meets interfaces as
// a cut does: no pillow of it is pinched or brings materials together that did not touch.
[[nodiscard]] CurveSet poor_curves(const Comm& comm, const HexMesh& mesh,
                                   std::span<const std::uint8_t> curve_node, double threshold, int layers);

}  // namespace sculpt
