#include "sculpt/write/side_sets.hpp"

#include <algorithm>
#include <compare>
#include <map>
#include <tuple>

#include "sculpt/deck/deck.hpp"
#include "sculpt/mesh/edge_walk.hpp"

namespace sculpt {
namespace {

constexpr int kTop = 5;  // the face of a buffer hex that lies where the old face was
constexpr std::int64_t kGridBoundary = 1, kExterior = 2, kInterfaces = 3;  // sets of `fixed`

constexpr std::int64_t kBoxSides = 6, kNoSurface = -1;

// Where a surface is met first.
struct Place {
  std::int64_t axis, plane;
  GlobalId cell;  // the one before the plane, or the one at the lower side of the box
  auto operator<=>(const Place&) const = default;
};

class Planner {
 public:
  Planner(const Comm& comm, const HexMesh& cells, const FaceNeighbours& neighbours, const Interfaces& faces,
          const Brep& brep, std::span<const std::uint8_t> drop, const SideSetWish& wish)
      : comm_(comm),
        cells_(cells),
        neighbours_(neighbours),
        faces_(faces),
        brep_(brep),
        drop_(drop),
        wish_(wish),
        grid_(wish.grid) {}

  SidePlan fixed() {
    add_inner(
        [](const InterfaceQuad&, std::size_t, bool exterior) { return exterior ? kExterior : kInterfaces; });
    for (const BoxFaces::Face& f : box_faces())
      add_boundary(f, towards_kept(f.cell, f.face) ? kInterfaces : kGridBoundary);
    return std::move(plan_);
  }

  SidePlan rve() {
    add_box_sides();
    return std::move(plan_);
  }

  SidePlan rve_variable() {
    add_surfaces([](bool) { return true; });
    renumber(kBoxSides);
    add_box_sides();
    return std::move(plan_);
  }

  SidePlan told() {
    add_inner([&](const InterfaceQuad& q, std::size_t, bool) { return wish_.set_of(q); });
    std::erase_if(plan_.inner, [](const SidePlan::Item& item) { return item.set == 0; });
    return std::move(plan_);
  }

  SidePlan free_surfaces() {
    add_surfaces([](bool exterior) { return exterior; });
    if (wish_.kept != nullptr) add_kept();
    renumber(wish_.after);
    return std::move(plan_);
  }

  // Surfaces between cells have the numbers of the brep, those on the box follow, then all get new ones.
  SidePlan variable() {
    const BoxFaces box = trace_box_faces(comm_, cells_, neighbours_, brep_.volume);
    add_surfaces([](bool) { return true; });
    for (std::size_t i = 0; i < box.faces.size(); ++i) {
      const BoxFaces::Face& f = box.faces[i];
      if (!meshed_here(f.cell)) continue;
      const std::int64_t surface = brep_.surfaces + box.surface[i];
      note(surface, place(f.cell, f.face, cells_.hex_id[at(f.cell)]));
      add_boundary(f, surface);
    }
    renumber(0);
    return std::move(plan_);
  }

 private:
  struct First {
    std::int64_t surface;
    Place place;
    auto operator<=>(const First&) const = default;
  };

  [[nodiscard]] bool meshed_here(LocalId cell) const {
    return cells_.layer[at(cell)] == 0 && !drop_[at(cell)];
  }

  void add_box_sides() {
    for (const BoxFaces::Face& f : box_faces())
      plan_.box.push_back({cells_.hex_id[at(f.cell)], f.side, f.side + 1});
  }

  // The surfaces of the brep that are wanted(whether they are exterior), under the numbers of the brep.
  template <class Wanted>
  void add_surfaces(Wanted&& wanted) {
    add_inner([&](const InterfaceQuad& q, std::size_t i, bool exterior) {
      const std::int64_t surface = brep_.surface[i];
      if (!wanted(exterior)) return kNoSurface;
      // The cell before the plane: on a lattice always the first; elsewhere nothing is before.
      const bool upward = grid_[0] == 0 || kFaceSign[static_cast<std::size_t>(q.face)] > 0;
      note(surface, place(q.cell[0], q.face, cells_.hex_id[at(q.cell[upward ? 0 : 1])]));
      return surface;
    });
    std::erase_if(plan_.inner, [](const SidePlan::Item& item) { return item.set == kNoSurface; });
  }

  // Faces of kept hexes towards cells that are no part of the mesh, one surface per volume and surface of the
  // exterior.
  void add_kept() {
    const HexMesh& kept = *wish_.kept;
    const BoxFaces box = trace_box_faces(comm_, cells_, neighbours_, brep_.volume);
    std::map<std::array<GlobalId, 4>, std::int64_t> surface_at;  // by the nodes of the face
    for (std::size_t i = 0; i < box.faces.size(); ++i) {
      const BoxFaces::Face& f = box.faces[i];
      if (drop_[at(f.cell)] && towards_kept(f.cell, f.face))
        surface_at[node_ids(cells_, f.cell, f.face)] = brep_.surfaces + box.surface[i];
    }
    for (LocalId h = 0; h < kept.size(); ++h)
      for (int f = 0; f < 6 && kept.layer[at(h)] == 0; ++f) {
        const auto found = surface_at.find(node_ids(kept, h, f));
        if (found == surface_at.end()) continue;
        note(found->second, {kept.hex_id[at(h)], f, 0});
        plan_.inner.push_back({kept.hex_id[at(h)], f, found->second});
      }
  }
  static std::array<GlobalId, 4> node_ids(const HexMesh& mesh, LocalId hex, int face) {
    std::array<GlobalId, 4> ids{};
    const auto nodes = face_nodes(mesh, {hex, face});
    std::transform(nodes.begin(), nodes.end(), ids.begin(), [&](LocalId n) { return mesh.node_id[at(n)]; });
    std::sort(ids.begin(), ids.end());
    return ids;
  }

  // A face on the boundary: of a box it is told by the side, of an exterior by the face itself.
  void add_boundary(const BoxFaces::Face& f, std::int64_t set) {
    if (cells_.exterior.empty())
      plan_.box.push_back({cells_.hex_id[at(f.cell)], f.side, set});
    else
      plan_.inner.push_back({cells_.hex_id[at(f.cell)], f.face, set});
  }
  [[nodiscard]] bool towards_kept(LocalId cell, int face) const {
    if (cells_.exterior.empty()) return false;
    const LocalId facet = cells_.exterior.facet_at(cell, face);
    return facet != kNone && cells_.exterior.facets[at(facet)].kept != 0;
  }

  // set_of(quad, its index, whether it is exterior), for quads whose listed cell is owned; but those between
  // two meshed cells are no quads of the files where one of them is an image.
  template <class SetOf>
  void add_inner(SetOf&& set_of) {
    for (std::size_t i = 0; i < faces_.quads.size(); ++i) {
      const InterfaceQuad& q = faces_.quads[i];
      const bool first_out = drop_[at(q.cell[0])] != 0, second_out = drop_[at(q.cell[1])] != 0;
      if (first_out && second_out) continue;
      const bool by_second =
          first_out || (!second_out && cells_.material[at(q.cell[1])] > cells_.material[at(q.cell[0])]);
      const LocalId cell = q.cell[by_second];
      const bool exterior = first_out || second_out;
      const bool across_period = side_towards(cells_.image_of(q.cell[!by_second])) >= 0;
      if (cells_.layer[at(cell)] != 0 || (across_period && !exterior)) continue;
      plan_.inner.push_back(
          {cells_.hex_id[at(cell)], by_second ? face_of_second(q) : q.face, set_of(q, i, exterior)});
    }
  }
  [[nodiscard]] int face_of_second(const InterfaceQuad& q) const {
    const auto& back = neighbours_[at(q.cell[1])];
    return static_cast<int>(std::find(back.begin(), back.end(), q.cell[0]) - back.begin());
  }

  [[nodiscard]] std::vector<BoxFaces::Face> box_faces() const {
    std::vector<BoxFaces::Face> out;
    for (LocalId c = 0; c < cells_.size(); ++c) {
      if (!meshed_here(c)) continue;
      for (int f = 0; f < 6; ++f)
        if (const int side = side_of_box(cells_, neighbours_, c, f); side >= 0) out.push_back({c, f, side});
    }
    return out;
  }

  [[nodiscard]] Place place(LocalId cell, int face, GlobalId before) const {
    if (!cells_.exterior.empty()) return {before, face, 0};
    const auto axis = static_cast<std::size_t>(kFaceAxis[static_cast<std::size_t>(face)]);
    if (grid_[0] == 0) return {kFaceAxis[static_cast<std::size_t>(face)], 0, before};
    GlobalId stride = 1;
    for (std::size_t d = 0; d < axis; ++d) stride *= grid_[d];
    const GlobalId index = cells_.hex_id[at(cell)] / stride % grid_[axis];
    return {static_cast<std::int64_t>(axis), index + (kFaceSign[static_cast<std::size_t>(face)] > 0 ? 1 : 0),
            before};
  }

  void note(std::int64_t surface, const Place& where) { firsts_.push_back({surface, where}); }

  // Ids after `last` in the order of the first places of the surfaces.
  void renumber(std::int64_t last) {
    keep_least();
    firsts_ = comm_.concatenate(firsts_);
    keep_least();
    std::vector<First> order = firsts_;
    std::sort(order.begin(), order.end(), [](const First& a, const First& b) { return a.place < b.place; });
    std::vector<std::int64_t> id(static_cast<std::size_t>(firsts_.empty() ? 0 : firsts_.back().surface + 1),
                                 0);
    for (std::size_t i = 0; i < order.size(); ++i)
      id[static_cast<std::size_t>(order[i].surface)] = last + static_cast<std::int64_t>(i) + 1;
    for (auto* items : {&plan_.inner, &plan_.box})
      for (SidePlan::Item& item : *items) item.set = id[static_cast<std::size_t>(item.set)];
  }
  void keep_least() {
    std::sort(firsts_.begin(), firsts_.end());
    firsts_.erase(std::unique(firsts_.begin(), firsts_.end(),
                              [](const First& a, const First& b) { return a.surface == b.surface; }),
                  firsts_.end());
  }

  const Comm& comm_;
  const HexMesh& cells_;
  const FaceNeighbours& neighbours_;
  const Interfaces& faces_;
  const Brep& brep_;
  std::span<const std::uint8_t> drop_;
  const SideSetWish& wish_;
  std::array<GlobalId, 3> grid_;
  SidePlan plan_;
  std::vector<First> firsts_;
};

// A face of an owned hex on a side of the box (bit number of the BoxSide).
struct FaceOnSide {
  LocalId hex;
  std::int32_t face, side;
  auto operator<=>(const FaceOnSide&) const = default;
};

// The faces of owned hexes whose other side is an image, ascending: the periodic sides of the mesh. At edges
// of the domain the other side may be a period away in two directions at once.
std::vector<FaceOnSide> faces_towards_images(const HexMesh& mesh) {
  std::vector<FaceOnSide> out;
  std::vector<std::uint8_t> of_image(mesh.position.size(), 0);
  for (LocalId h = 0; h < mesh.size(); ++h)
    if (side_towards(mesh.image_of(h)) >= 0)
      for (const LocalId n : mesh.hexes[at(h)]) of_image[at(n)] = 1;
  struct Face {
    std::array<LocalId, 4> nodes;
    LocalId hex;
    std::int32_t face, side;  // side -1: of an owned hex
  };
  std::vector<Face> faces;
  for (LocalId h = 0; h < mesh.size(); ++h) {
    const int side = side_towards(mesh.image_of(h));
    for (std::size_t f = 0; f < 6 && (side >= 0 || mesh.layer[at(h)] == 0); ++f) {
      Face face{{}, h, static_cast<std::int32_t>(f), side};
      for (std::size_t v = 0; v < 4; ++v)
        face.nodes[v] = mesh.hexes[at(h)][static_cast<std::size_t>(kFaces[f][v])];
      if (std::any_of(face.nodes.begin(), face.nodes.end(), [&](LocalId n) { return !of_image[at(n)]; }))
        continue;
      std::sort(face.nodes.begin(), face.nodes.end());
      faces.push_back(face);
    }
  }
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
    return std::tie(a.nodes, a.side) < std::tie(b.nodes, b.side);
  });
  for (std::size_t i = 0; i + 1 < faces.size(); ++i)
    if (faces[i].nodes == faces[i + 1].nodes && faces[i].side < 0 && faces[i + 1].side >= 0)
      out.push_back({faces[i].hex, faces[i].face, faces[i + 1].side});
  std::sort(out.begin(), out.end());
  return out;
}

class Finder {
 public:
  Finder(const HexMesh& mesh, int stages, std::span<const ExteriorPart> parts)
      : mesh_(mesh), stages_(stages), parts_(parts), periodic_faces_(faces_towards_images(mesh)) {
    for (int s = 0; s < stages; ++s) family_ *= kHexFactor;
  }

  // The parts of a cell's face on the exterior; false when this rank has none.
  bool add_parts(const SidePlan::Item& item) {
    const auto [first, last] =
        std::equal_range(parts_.begin(), parts_.end(), ExteriorPart{item.cell, item.at, 0, 0},
                         [](const ExteriorPart& a, const ExteriorPart& b) {
                           return std::pair(a.cell, a.at) < std::pair(b.cell, b.at);
                         });
    for (auto part = first; part != last; ++part) add(item.set, part->hex, part->face);
    return first != last;
  }

  // The hexes in which the face of a cell ended up.
  void add_inner(const SidePlan::Item& item) {
    if (add_parts(item)) return;
    faces_.assign(1, {item.cell, item.at});
    GlobalId family = family_;
    for (int s = 0; s < stages_; ++s) {
      family /= kHexFactor;
      next_.clear();
      for (const auto& [hex, face] : faces_) follow(hex, face, family);
      faces_.swap(next_);
    }
    for (const auto& [id, face] : faces_) add(item.set, id, face);
  }

  // Faces of all hexes of a cell on one side of the box.
  void add_box(const SidePlan::Item& item) {
    const auto begin = std::lower_bound(mesh_.hex_id.begin(), mesh_.hex_id.end(), family_ * item.cell);
    for (auto it = begin; it != mesh_.hex_id.end() && *it < family_ * (item.cell + 1); ++it)
      for (int f = 0; f < 6; ++f) {
        const auto hex = static_cast<LocalId>(it - mesh_.hex_id.begin());
        const bool on_side =
            (face_sides(mesh_, hex, f) >> item.at & 1) != 0 ||
            std::binary_search(periodic_faces_.begin(), periodic_faces_.end(), FaceOnSide{hex, f, item.at});
        if (on_side) out_.push_back({item.set, hex, f});
      }
  }

  std::vector<SideFace> done() { return std::move(out_); }

 private:
  void add(std::int64_t set, GlobalId id, int face) {
    const LocalId hex = find(id);
    check(hex != kNone, "a hex of a side set is missing");
    out_.push_back({set, hex, face});
  }
  [[nodiscard]] LocalId find(GlobalId id) const {
    const auto it = std::lower_bound(mesh_.hex_id.begin(), mesh_.hex_id.end(), id);
    return it == mesh_.hex_id.end() || *it != id ? kNone : static_cast<LocalId>(it - mesh_.hex_id.begin());
  }
  // What one pillow makes of a face: the far side of the buffer hex on it. A face without one lies within the
  // set that was wrapped; it draws back from wrapped faces beside it, and the sides of the buffer hexes on
  // those take the strips that it leaves. family: ids per hex that the later pillows leave.
  void follow(GlobalId hex, int face, GlobalId family) {
    const auto exists = [&](GlobalId id) { return find(family * id) != kNone; };
    const GlobalId old = kHexFactor * hex;
    if (exists(old + face + 1)) {
      next_.push_back({old + face + 1, kTop});
      return;
    }
    next_.push_back({old, face});
    for (int g = 0; g < 6; ++g)
      if (const int side = side_over(g, face); side >= 0 && exists(old + g + 1))
        next_.push_back({old + g + 1, side});
  }

  const HexMesh& mesh_;
  int stages_;
  std::span<const ExteriorPart> parts_;
  std::vector<FaceOnSide> periodic_faces_;
  GlobalId family_ = 1;  // ids per cell
  struct HexFace {
    GlobalId hex;
    int face;
  };
  std::vector<HexFace> faces_, next_;  // of one item, at this stage and the next
  std::vector<SideFace> out_;
};

void sort_once(std::vector<std::int64_t>& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

SidePlan planned(Planner& planner, int gen_sidesets) {
  switch (gen_sidesets) {
    case kSidesetsFixed:
      return planner.fixed();
    case kSidesetsVariable:
      return planner.variable();
    case kSidesetsRve:
      return planner.rve();
    case kSidesetsRveVariable:
      return planner.rve_variable();
    case kSidesetsGeometricSurfaces:
    case kSidesetsGeometricSidesets:
    case kSidesetsInputMeshAndStl:
      return planner.told();
    case kSidesetsInputMeshAndFreeSurfaces:
      return planner.free_surfaces();
    default:
      return {};
  }
}

}  // namespace

SidePlan plan_side_sets(const Comm& comm, const HexMesh& cells, const FaceNeighbours& neighbours,
                        const Interfaces& faces, const Brep& brep, std::span<const std::uint8_t> drop,
                        const SideSetWish& wish) {
  Planner planner(comm, cells, neighbours, faces, brep, drop, wish);
  SidePlan plan = planned(planner, wish.gen_sidesets);
  std::vector<std::int64_t> mine;
  for (const auto* items : {&plan.inner, &plan.box})
    for (const SidePlan::Item& item : *items) mine.push_back(item.set);
  sort_once(mine);
  plan.ids = comm.concatenate(mine);
  sort_once(plan.ids);
  return plan;
}

void share_exterior_faces(const HexMesh& cells, SidePlan& plan) {
  using G = GhostExchange;
  std::vector<std::vector<SidePlan::Item>> of_cell(cells.hexes.size());
  for (const SidePlan::Item& item : plan.inner) {
    const auto found = std::lower_bound(cells.hex_id.begin(), cells.hex_id.end(), item.cell);
    const auto c = static_cast<LocalId>(found - cells.hex_id.begin());
    if (found != cells.hex_id.end() && *found == item.cell && cells.exterior.facet_at(c, item.at) != kNone)
      of_cell[at(c)].push_back(item);
  }
  cells.hex_exchange.send_records(
      [&](LocalId c, std::vector<char>& bytes) {
        if (of_cell[at(c)].empty()) return;
        G::append(bytes, static_cast<std::int32_t>(of_cell[at(c)].size()));
        for (const SidePlan::Item& item : of_cell[at(c)]) {
          G::append(bytes, item.at);
          G::append(bytes, item.set);
        }
      },
      [&](LocalId ghost, const char* from) {
        std::int32_t count;
        G::take(from, count);
        for (std::int32_t i = 0; i < count; ++i) {
          SidePlan::Item item{cells.hex_id[at(ghost)], 0, 0};
          G::take(from, item.at);
          G::take(from, item.set);
          plan.beside.push_back(item);
        }
        return from;
      });
}

std::vector<ExteriorPart> exterior_parts(const HexMesh& mesh) {
  std::vector<ExteriorPart> parts;
  for (const ExteriorFace& f : mesh.exterior.faces) {
    const Facet& facet = mesh.exterior.facets[at(f.facet)];
    if (mesh.layer[at(f.hex)] == 0) parts.push_back({facet.cell, facet.face, mesh.hex_id[at(f.hex)], f.face});
  }
  std::sort(parts.begin(), parts.end());
  return parts;
}

std::vector<SideFace> side_faces(const SidePlan& plan, const HexMesh& mesh, int stages,
                                 std::span<const ExteriorPart> parts) {
  Finder finder(mesh, stages, parts);
  for (const SidePlan::Item& item : plan.inner) finder.add_inner(item);
  // A cell of a refined grid may have several faces on one side, which are found together.
  std::vector<SidePlan::Item> box = plan.box;
  const auto key = [](const SidePlan::Item& item) { return std::tuple(item.cell, item.at, item.set); };
  std::sort(box.begin(), box.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  const auto last = std::unique(
      box.begin(), box.end(), [](const auto& a, const auto& b) { return a.cell == b.cell && a.at == b.at; });
  box.erase(last, box.end());
  for (const SidePlan::Item& item : box) finder.add_box(item);
  for (const SidePlan::Item& item : plan.beside) finder.add_parts(item);
  return finder.done();
}

}  // namespace sculpt
