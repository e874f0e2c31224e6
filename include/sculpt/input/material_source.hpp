#pragma once
// Where materials come from: a file or a geometry that can say, for any box of cells, which materials they
// hold. One class per format; the rest of the program knows only this face.
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sculpt/base/log.hpp"
#include "sculpt/base/types.hpp"
#include "sculpt/deck/deck.hpp"
#include "sculpt/geom/features.hpp"
#include "sculpt/geom/hex.hpp"
#include "sculpt/geom/shape.hpp"
#include "sculpt/grid/grid.hpp"
#include "sculpt/par/comm.hpp"

namespace sculpt {

// Sparse volume fractions of a list of cells, CSR: cell c holds material[offset[c] .. offset[c+1]) (dense
// index, ascending) with the fractions in `value`, each in (0,1], their sum 1.
struct Fractions {
  std::vector<std::int64_t> offset{0};
  std::vector<std::int32_t> material;
  std::vector<double> value;

  [[nodiscard]] std::int64_t cells() const { return static_cast<std::int64_t>(offset.size()) - 1; }
  void reserve(std::size_t cells, std::size_t entries) {
    offset.reserve(cells + 1);
    material.reserve(entries);
    value.reserve(entries);
  }
  // Appends one entry to the cell being built; end_cell() closes it.
  void add(std::int32_t m, double fraction) {
    material.push_back(m);
    value.push_back(fraction);
  }
  void end_cell() { offset.push_back(static_cast<std::int64_t>(material.size())); }
};

// Fraction of material m in a cell; 0 when it is not listed.
[[nodiscard]] inline double fraction_of(const Fractions& f, LocalId cell, std::int32_t m) {
  const auto c = static_cast<std::size_t>(cell);
  for (auto e = static_cast<std::size_t>(f.offset[c]); e < static_cast<std::size_t>(f.offset[c + 1]); ++e)
    if (f.material[e] == m) return f.value[e];
  return 0;
}

// The materials of a run, the same on every rank. Dense index = position in block_id, which ascends, except
// that the void that has no id of the user's (`diatom` space outside every shape) may get the id by the rules
// of void_mat.
struct MaterialTable {
  std::vector<std::int64_t> block_id;         // Exodus block id of each material, ascending
  std::optional<std::int32_t> void_material;  // dense index of the material that is the void, if there is one
};

// What the source says once it has been opened.
struct MaterialData {
  MaterialTable table;
  Fractions fractions;  // of the cells of this rank's wanted box, x fastest
};

// The nearest point to p on the surface of a shape of material a or b (dense indices); nothing when no such
// surface is near. Empty where the input is data and not shapes.
using ExactSurface = std::function<std::optional<Vec3>(const Vec3& p, std::int32_t a, std::int32_t b)>;

// The surfaces that the geometry itself is made of, the same on every rank; none where the input is data. A
// part is what the input gives a name: a package of shapes, a solid of an STL file. Names are not empty;
// those of surfaces are all different, and so are those of parts.
struct GeometrySurfaces {
  std::vector<std::string> surface_name, part_name;
  std::vector<std::int32_t> part_of_surface;  // per surface: index into part_name
  // Local. The surface that the interface between materials a and b (dense indices, -1: not known) near p
  // lies on; nothing when none is near. Depends on p, a and b only. Stays usable when the source is gone.
  std::function<std::optional<std::int32_t>(const Vec3& p, std::int32_t a, std::int32_t b)> nearest;

  [[nodiscard]] bool empty() const { return surface_name.empty(); }
};

// The materials of this rank's part of space, for boxes of any size and place: cells finer or coarser than
// those that were read. Local. A box has a volume. What is said of it depends on the box and the input only,
// not on the rank's part. Calls may use scratch storage of the field: one thread at a time. Stays usable when
// the source is gone.
class MaterialField {
 public:
  virtual ~MaterialField() = default;
  // Appends the box as one cell: materials ascending, fractions in (0,1] whose sum is 1, end_cell() called.
  // A cell that was read gets the fractions that were read, to the last bit.
  virtual void measure(const Box& box, Fractions& out) = 0;
  // The material that certainly fills the whole box; nothing when several do, or when it would take a
  // measurement to know.
  [[nodiscard]] virtual std::optional<std::int32_t> sole_material(const Box& box) = 0;
};

// The materials of general hexes, the cells of an overlay grid that are no boxes. Local. The hexes have a
// positive Jacobian. What is said of a hex depends on its corners and the input only, not on the rank's part.
// One thread at a time. Stays usable when the source is gone.
class HexField {
 public:
  virtual ~HexField() = default;
  // Appends the hex as one cell: materials ascending, fractions in (0,1] whose sum is 1, end_cell() called.
  virtual void measure(const HexCorners& hex, Fractions& out) = 0;
};

class MaterialSource {
 public:
  virtual ~MaterialSource() = default;
  // The grid of the data itself, before expansion layers. Known after opening, the same on every rank.
  [[nodiscard]] virtual const Grid& grid() const = 0;
  // Collective. wanted[r] = the cells rank r needs (known to all ranks; boxes may overlap or be empty). Reads
  // large files once, all ranks together, and leaves on each rank only what it wanted. Throws AgreedError.
  [[nodiscard]] virtual MaterialData read(const Comm& comm, std::span<const IndexBox> wanted) = 0;
  // Whether the materials are known only as values of the cells of grid(); otherwise they are known
  // everywhere.
  [[nodiscard]] virtual bool is_data() const { return true; }
  // Local, after read(): `wanted` is what this rank wanted, `fractions` what it got (move them in to keep one
  // copy only). The field of data takes boxes within the wanted cells (BrokenPromise otherwise) and gives the
  // averages of the cells they overlap, by volume; the outermost cells of the grid extend to infinity. Planes
  // that differ from those of the grid by a millionth of a cell are the same. The field of shapes takes any
  // box and knows what lies beyond the grid.
  [[nodiscard]] virtual std::unique_ptr<MaterialField> field(Fractions fractions,
                                                             const IndexBox& wanted) const;
  // Local, after read(), like field(). The field of data on equal voxels (BrokenPromise otherwise): a hex
  // that is smaller than half a voxel gets the average of the voxels around its centre, weighted by the
  // inverse square of the distance, of those in the grid; any other gets what it overlaps, measured along
  // lines, a box exactly. Space beyond the grid is of the material `outside`; it does not spread inwards. The
  // voxels that hexes need are those of voxels_for(). The field of shapes knows what lies outside: it is
  // given nothing and may be asked anywhere. Box hexes get what field() says of the box, to the last bit
  // (data: within the grid, from half a voxel on).
  [[nodiscard]] virtual std::unique_ptr<HexField> hex_field(Fractions fractions, const IndexBox& wanted,
                                                            std::int32_t outside) const;
  // The directions of the grid's axes in space, where the option align has turned the geometry.
  [[nodiscard]] virtual std::optional<std::array<Vec3, 3>> axes() const { return std::nullopt; }
  // What the input knows exactly of its surfaces. Stays usable when the source is gone.
  [[nodiscard]] virtual ExactSurface exact_surface() const { return {}; }
  // The smooth surfaces, curves and corners of faceted input; null where there are no facets.
  [[nodiscard]] virtual std::shared_ptr<const GeometryFeatures> features() const { return nullptr; }
  [[nodiscard]] virtual GeometrySurfaces geometry_surfaces() const { return {}; }
};

// The voxels of a grid that the hexes of data need, of all hexes within a box; empty when they lie outside.
[[nodiscard]] IndexBox voxels_for(const Grid& grid, const Box& hexes);

// Collective. Opens the one geometry source of the deck, checks what can be checked before reading the data,
// and prints the summary that real Sculpt prints. `overlay`: the bounds of an overlay mesh that is not the
// grid of the source; shapes then need neither counts nor box in the deck, and their grid() is only a means
// of finding them. Throws AgreedError.
[[nodiscard]] std::unique_ptr<MaterialSource> open_source(const Comm& comm, const Deck& deck, const Log& log,
                                                          const std::optional<Box>& overlay = std::nullopt);

}  // namespace sculpt
