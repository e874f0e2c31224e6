#include "sculpt/brep/exterior.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sculpt/mesh/edge_walk.hpp"
#include "sculpt/par/components.hpp"

namespace sculpt {
namespace {

constexpr double kStraight = 1e-9;    // sine of the angle between two edges that count as one line
constexpr double kTurn = 45;          // degrees: a curve that turns by more has a vertex there (when sliding)
constexpr int kSides = 8;             // bits of box_sides
constexpr std::int32_t kInside = -1;  // stands for the surface of a facet that is not on the boundary

// A face of the mesh that is a facet, and an edge of one.
struct FacetNodes {
  LocalId cell;
  int face;
  std::array<LocalId, 4> node;
  std::int64_t label;
};
struct FacetEdge {
  LocalId a, b, facet;  // a < b
  auto operator<=>(const FacetEdge&) const = default;
};

class ExteriorFinder {
 public:
  ExteriorFinder(const Comm& comm, HexMesh& cells, const FaceNeighbours& neighbours,
                 std::span<const std::uint8_t> kept, const ExteriorOptions& options)
      : comm_(comm),
        cells_(cells),
        neighbours_(neighbours),
        kept_(kept),
        options_(options),
        least_cosine_(std::cos((180 - options.feature_angle) * std::numbers::pi / 180)) {}

  void run() {
    out_.slides = options_.slides;
    find_complete_nodes();
    find_facets();
    find_edges();
    for_each_edge([&](std::span<const FacetEdge> edge) {
      if (edge.size() > 2 && out_.pinched < 0) out_.pinched = cells_.node_id[at(edge[0].a)];
    });
    find_surfaces();
    number_sides();
    out_.holds.assign(2, {});  // points: Exterior::kKept, Exterior::kVertex
    out_.hold_of.assign(cells_.position.size(), kNone);
    hold_nodes([](LocalId) { return true; });
    cells_.exterior = std::move(out_);
  }

  // Holds anew the nodes of faces between cells that is_held picks.
  void hold_inside(const std::function<bool(LocalId cell, LocalId other)>& is_held) {
    out_ = std::move(cells_.exterior);
    find_complete_nodes();
    for (const ExteriorFace& f : out_.faces) {
      FacetNodes nodes = nodes_of(f.hex, f.face, 0);
      if (at(f.facet) >= facets_.size()) facets_.resize(at(f.facet) + 1);
      facets_[at(f.facet)] = nodes;
    }
    const std::size_t outside = facets_.size();
    check(outside == out_.facets.size(), "every facet has its face");
    for (LocalId c = 0; c < cells_.size(); ++c)
      for (int f = 0; f < 6; ++f) {
        const LocalId other = neighbours_[at(c)][static_cast<std::size_t>(f)];
        if (other > c && is_held(c, other))
          add_facet(nodes_of(c, f, std::int64_t{cells_.material[at(c)]} << 32 | cells_.material[at(other)]),
                    true);
      }
    find_edges();
    std::vector<std::uint8_t> again(cells_.position.size(), 0);
    for (std::size_t f = outside; f < facets_.size(); ++f)
      for (const LocalId n : facets_[f].node) again[at(n)] = 1;
    hold_nodes([&](LocalId n) { return again[at(n)] != 0; });
    cells_.exterior = std::move(out_);
  }

 private:
  [[nodiscard]] bool kept(LocalId cell) const { return !kept_.empty() && kept_[at(cell)] != 0; }

  // Nodes all of whose cells are here.
  void find_complete_nodes() {
    complete_.assign(cells_.position.size(), 0);
    for (LocalId c = 0; c < cells_.size(); ++c)
      if (cells_.layer[at(c)] < cells_.ghost_layers)
        for (const LocalId n : cells_.hexes[at(c)]) complete_[at(n)] = 1;
  }

  // A face without a neighbour is known to be on the boundary when one of its nodes is complete.
  void find_facets() {
    for (LocalId c = 0; c < cells_.size(); ++c) {
      if (kept(c)) continue;
      for (int f = 0; f < 6; ++f) {
        const LocalId other = neighbours_[at(c)][static_cast<std::size_t>(f)];
        if (other != kNone && !kept(other)) continue;
        const FacetNodes nodes = nodes_of(c, f, options_.label ? options_.label(c, f) : 0);
        if (!add_facet(nodes)) continue;
        Facet& facet = out_.facets.back();
        facet.kept = facet.whole = other != kNone;
        out_.faces.push_back({c, f, static_cast<LocalId>(facets_.size()) - 1});
      }
    }
  }
  [[nodiscard]] FacetNodes nodes_of(LocalId cell, int face, std::int64_t label) const {
    FacetNodes nodes{cell, face, face_nodes(cells_, {cell, face}), label};
    std::rotate(nodes.node.begin(), std::min_element(nodes.node.begin(), nodes.node.end()), nodes.node.end());
    return nodes;
  }
  // Nothing happens, and the answer is false, when no node of the face is complete.
  bool add_facet(const FacetNodes& nodes, bool inside = false) {
    if (std::none_of(nodes.node.begin(), nodes.node.end(), [&](LocalId n) { return complete_[at(n)] != 0; }))
      return false;
    Facet facet;
    for (std::size_t v = 0; v < 4; ++v) {
      facet.corner[v] = cells_.position[at(nodes.node[v])];
      facet.node[v] = cells_.node_id[at(nodes.node[v])];
    }
    facet.cell = cells_.hex_id[at(nodes.cell)];
    facet.face = nodes.face;
    facet.surface = inside ? kInside : 0;
    out_.facets.push_back(facet);
    facets_.push_back(nodes);
    return true;
  }

  void find_edges() {
    edges_.reserve(4 * facets_.size());
    for (std::size_t f = 0; f < facets_.size(); ++f)
      for (std::size_t v = 0; v < 4; ++v) {
        const LocalId a = facets_[f].node[v], b = facets_[f].node[(v + 1) % 4];
        if (complete_[at(a)] || complete_[at(b)])
          edges_.push_back({std::min(a, b), std::max(a, b), static_cast<LocalId>(f)});
      }
    std::sort(edges_.begin(), edges_.end());
  }
  // visit(the facets' edges that are one edge), for all edges.
  template <class Visit>
  void for_each_edge(Visit&& visit) const {
    for (std::size_t first = 0; first < edges_.size();) {
      std::size_t last = first;
      while (last < edges_.size() && edges_[last].a == edges_[first].a && edges_[last].b == edges_[first].b)
        ++last;
      visit(std::span(edges_).subspan(first, last - first));
      first = last;
    }
  }

  [[nodiscard]] bool is_feature(std::span<const FacetEdge> edge) const {
    if (edge.size() != 2) return true;
    const Facet &f = facet(edge[0]), &g = facet(edge[1]);
    return f.surface != g.surface || f.kept != g.kept ||
           facets_[at(edge[0].facet)].label != facets_[at(edge[1].facet)].label ||
           dot(facet_normal(f), facet_normal(g)) < least_cosine_;
  }
  // Whether a node that leaves the edge changes the shape.
  [[nodiscard]] bool is_crease(std::span<const FacetEdge> edge) const {
    return is_feature(edge) || (!options_.slides && !coplanar(facet(edge[0]), facet(edge[1])));
  }
  [[nodiscard]] const Facet& facet(const FacetEdge& edge) const { return out_.facets[at(edge.facet)]; }

  void find_surfaces() {
    DisjointSets sets(facets_.size());
    for_each_edge([&](std::span<const FacetEdge> edge) {
      if (!is_feature(edge)) sets.join(edge[0].facet, edge[1].facet);
    });
    std::vector<GlobalId> ids;
    std::vector<std::int32_t> owner;
    for (const FacetNodes& f : facets_) {
      ids.push_back(8 * cells_.hex_id[at(f.cell)] + f.face);
      owner.push_back(cells_.hex_owner[at(f.cell)]);
    }
    Components parts = connected_components(comm_, std::move(sets), ids, GhostExchange(comm_, ids, owner));
    surfaces_ = number_components(comm_, parts, ids);
    for (std::size_t f = 0; f < facets_.size(); ++f) out_.facets[f].surface = parts.of[f];
    find_curved();
  }
  void find_curved() {
    std::vector<std::uint64_t> curved((static_cast<std::size_t>(surfaces_) + 63) / 64, 0);
    const auto mark = [&](const Facet& f) {
      const auto s = static_cast<std::size_t>(f.surface);
      curved[s / 64] |= std::uint64_t{1} << (s % 64);
    };
    for (const Facet& f : out_.facets)
      if (!is_flat(f)) mark(f);
    for_each_edge([&](std::span<const FacetEdge> edge) {
      if (!is_feature(edge) && !coplanar(facet(edge[0]), facet(edge[1]))) mark(facet(edge[0]));
    });
    comm_.bit_or(curved);
    for (std::size_t s = 0; s < static_cast<std::size_t>(surfaces_); ++s)
      out_.curved.push_back(static_cast<std::uint8_t>(curved[s / 64] >> (s % 64) & 1));
  }

  // Bits for surfaces, such that two with a node in common differ, as long as there are enough.
  void number_sides() {
    std::vector<std::vector<std::int32_t>> at_node(cells_.position.size());
    for (std::size_t f = 0; f < facets_.size(); ++f)
      for (const LocalId n : facets_[f].node) at_node[at(n)].push_back(out_.facets[f].surface);
    struct Pair {
      std::int32_t later, earlier;
      auto operator<=>(const Pair&) const = default;
    };
    std::vector<Pair> pairs;
    const auto tidy = [](auto& list) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    };
    for (auto& list : at_node) {
      tidy(list);
      for (const std::int32_t a : list)
        for (const std::int32_t b : list)
          if (b < a) pairs.push_back({a, b});
    }
    tidy(pairs);
    pairs = comm_.concatenate(pairs);
    tidy(pairs);
    std::vector<int> bit(static_cast<std::size_t>(surfaces_), 0);
    std::size_t next = 0;
    for (std::size_t s = 0; s < bit.size(); ++s) {
      std::array<int, kSides> used{};
      for (; next < pairs.size() && static_cast<std::size_t>(pairs[next].later) == s; ++next)
        ++used[static_cast<std::size_t>(bit[static_cast<std::size_t>(pairs[next].earlier)])];
      bit[s] = static_cast<int>(std::min_element(used.begin(), used.end()) - used.begin());
    }
    for (std::size_t n = 0; n < at_node.size(); ++n) {
      unsigned sides = 0;
      for (const std::int32_t s : at_node[n]) sides |= 1U << bit[static_cast<std::size_t>(s)];
      cells_.box_sides[n] = static_cast<std::uint8_t>(sides);
    }
    cells_.node_exchange.copy_to_ghosts(cells_.box_sides);
  }

  template <class Wanted>
  void hold_nodes(const Wanted& wanted) {
    std::vector<std::vector<LocalId>> facets_at(cells_.position.size());
    for (std::size_t f = 0; f < facets_.size(); ++f)
      for (const LocalId n : facets_[f].node) facets_at[at(n)].push_back(static_cast<LocalId>(f));
    std::vector<std::vector<LocalId>> creases(cells_.position.size());
    for_each_edge([&](std::span<const FacetEdge> edge) {
      if (!is_crease(edge)) return;
      creases[at(edge[0].a)].push_back(edge[0].b);
      creases[at(edge[0].b)].push_back(edge[0].a);
    });
    std::vector<std::uint8_t> fixed(cells_.position.size(), 0);
    for (LocalId c = 0; c < cells_.size(); ++c)
      if (kept(c))
        for (const LocalId n : cells_.hexes[at(c)]) fixed[at(n)] = 1;
    for (LocalId n = 0; n < cells_.nodes(); ++n) {
      if (!wanted(n) || out_.hold_of[at(n)] == Exterior::kKept) continue;
      if (fixed[at(n)])
        out_.hold_of[at(n)] = Exterior::kKept;
      else if (!facets_at[at(n)].empty())
        out_.hold_of[at(n)] = hold_for(n, facets_at[at(n)], creases[at(n)]);
    }
  }
  LocalId hold_for(LocalId n, const std::vector<LocalId>& on, const std::vector<LocalId>& creases) {
    const bool flat = options_.slides || std::all_of(on.begin(), on.end(),
                                                     [&](LocalId f) { return is_flat(out_.facets[at(f)]); });
    if (creases.empty()) return flat ? out_.add_surface(on) : Exterior::kVertex;
    if (creases.size() != 2) return Exterior::kVertex;
    const std::array<Vec3, 3> line{cells_.position[at(creases[0])], cells_.position[at(n)],
                                   cells_.position[at(creases[1])]};
    const Vec3 one = unit(line[1] - line[0]), two = unit(line[2] - line[1]);
    const double most = options_.slides ? std::sin(kTurn * std::numbers::pi / 180) : kStraight;
    return dot(one, two) > 0 && norm(cross(one, two)) <= most ? out_.add_line(line) : Exterior::kVertex;
  }

  const Comm& comm_;
  HexMesh& cells_;
  const FaceNeighbours& neighbours_;
  std::span<const std::uint8_t> kept_;
  const ExteriorOptions& options_;
  double least_cosine_;  // between the normals of faces of one surface
  std::vector<std::uint8_t> complete_;
  std::vector<FacetNodes> facets_;
  std::vector<FacetEdge> edges_;
  std::int64_t surfaces_ = 0;
  Exterior out_;
};

}  // namespace

namespace {

struct SurfacePair {
  std::int32_t one, two;
  auto operator<=>(const SurfacePair&) const = default;
};

// Surfaces that meet at an edge without much of a bend, of all ranks: a layer that ends there would have
// hexes with two faces side by side on the boundary.
std::vector<SurfacePair> flat_pairs(const Comm& comm, const Exterior& exterior, const HexMesh& cells) {
  constexpr double kFlat = 0.7;  // cosine between the normals
  std::vector<FacetEdge> edges;
  for (const ExteriorFace& f : exterior.faces) {
    const auto nodes = face_nodes(cells, {f.hex, f.face});
    for (std::size_t v = 0; v < 4; ++v)
      edges.push_back(
          {std::min(nodes[v], nodes[(v + 1) % 4]), std::max(nodes[v], nodes[(v + 1) % 4]), f.facet});
  }
  std::sort(edges.begin(), edges.end());
  std::vector<SurfacePair> pairs;
  const auto tidy = [&pairs] {
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  };
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (std::size_t o = e + 1; o < edges.size() && edges[o].a == edges[e].a && edges[o].b == edges[e].b;
         ++o) {
      const Facet &f = exterior.facets[at(edges[e].facet)], &g = exterior.facets[at(edges[o].facet)];
      if (f.surface != g.surface && dot(facet_normal(f), facet_normal(g)) > kFlat)
        pairs.push_back({std::min(f.surface, g.surface), std::max(f.surface, g.surface)});
    }
  tidy();
  pairs = comm.concatenate(pairs);
  tidy();
  return pairs;
}

}  // namespace

void hold_inside(const Comm& comm, HexMesh& cells, const FaceNeighbours& neighbours, bool slides,
                 const std::function<bool(LocalId cell, LocalId other)>& is_held) {
  ExteriorOptions options;
  options.slides = slides;
  ExteriorFinder(comm, cells, neighbours, {}, options).hold_inside(is_held);
}

void keep_whole(const Comm& comm, Exterior& exterior, const HexMesh& cells, const Interfaces& faces) {
  std::vector<std::uint64_t> whole((exterior.curved.size() + 63) / 64, 0);
  const auto mark = [&](std::int32_t surface) {
    const auto s = static_cast<std::size_t>(surface);
    whole[s / 64] |= std::uint64_t{1} << (s % 64);
  };
  struct Edge {
    LocalId a, b;
    std::int32_t surface;
    auto operator<=>(const Edge&) const = default;
  };
  std::vector<Edge> edges;  // of the exterior, between interface nodes
  for (const ExteriorFace& f : exterior.faces) {
    const std::int32_t surface = exterior.facets[at(f.facet)].surface;
    const auto nodes = face_nodes(cells, {f.hex, f.face});
    for (std::size_t v = 0; v < 4; ++v) {
      const LocalId a = std::min(nodes[v], nodes[(v + 1) % 4]), b = std::max(nodes[v], nodes[(v + 1) % 4]);
      if (faces.index_of[at(a)] == kNone) continue;
      if (!exterior.slides && exterior.curved[static_cast<std::size_t>(surface)] != 0) mark(surface);
      const auto beside = faces.neighbours[at(faces.index_of[at(a)])];
      if (std::binary_search(beside.begin(), beside.end(), faces.index_of[at(b)]))
        edges.push_back({a, b, surface});
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t e = 0; e + 1 < edges.size(); ++e) {
    const Edge &one = edges[e], &two = edges[e + 1];
    if (one.a != two.a || one.b != two.b || one.surface == two.surface) continue;
    mark(one.surface);
    mark(two.surface);
  }
  for (const Facet& f : exterior.facets)
    if (f.kept != 0) mark(f.surface);
  comm.bit_or(whole);
  const std::vector<SurfacePair> pairs = flat_pairs(comm, exterior, cells);
  const auto is_whole = [&](std::int32_t surface) {
    const auto s = static_cast<std::size_t>(surface);
    return (whole[s / 64] >> (s % 64) & 1) != 0;
  };
  for (bool more = true; more;) {
    more = false;
    for (const SurfacePair& p : pairs) {
      if (is_whole(p.one) == is_whole(p.two)) continue;
      mark(p.one);
      mark(p.two);
      more = true;
    }
  }
  for (Facet& f : exterior.facets) {
    if (f.surface == kInside) continue;
    const auto s = static_cast<std::size_t>(f.surface);
    if ((whole[s / 64] >> (s % 64) & 1) != 0) f.whole = 1;
  }
}

void find_exterior(const Comm& comm, HexMesh& cells, const FaceNeighbours& neighbours,
                   std::span<const std::uint8_t> kept, const ExteriorOptions& options) {
  ExteriorFinder(comm, cells, neighbours, kept, options).run();
}

}  // namespace sculpt
