#include "pipeline/adapted_overlay.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "pipeline/console.hpp"
#include "pipeline/idle_options.hpp"
#include "pipeline/layers.hpp"
#include "pipeline/periodicity.hpp"
#include "sculpt/adapt/criteria.hpp"
#include "sculpt/adapt/leaf_fractions.hpp"
#include "sculpt/adapt/leaf_mesh.hpp"
#include "sculpt/vfrac/fractions.hpp"

namespace sculpt {
namespace {

constexpr double kFractionThreshold = 1e-4;  // of vfrac_average, coarsen and material: any interface
constexpr double kMostBytes = 0x1p31;        // per rank, to keep track of the blocks
constexpr double kLengthThreshold = 0.25;  // of the types that measure distances: of the cell size / levels^2

bool coarsens(const Deck& deck) {
  return deck.adapt_type == kAdaptCoarsen || deck.adapt_type == kAdaptResample;
}

std::string place_of(const Deck& deck, const char* option) {
  return deck.given(option) ? deck.given_options.place(option) : "not given";
}

// The grid whose cells hold 2^levels cells of the data per axis, and how many cells of the data its last
// cells lack.
struct CoarseGrid {
  Grid grid;
  Index3 missing{0, 0, 0};
  Vec3 high;  // corner of the domain
};
CoarseGrid coarse_grid(const Deck& deck, const Grid& dense, const Log& log) {
  const std::int64_t step = std::int64_t{1} << deck.adapt_levels;
  const bool keep = deck.adapt_remainder == kRemainderKeep;
  CoarseGrid coarse;
  std::string rest;
  for (std::size_t d = 0; d < 3; ++d) {
    const std::int64_t n = dense.cells[d], over = n % step;
    std::int64_t& cells = coarse.grid.cells[d];
    cells = n / step + (keep && over > 0 ? 1 : 0);
    if (cells == 0)
      throw Error(fmt::format(
          "option 'adapt_levels' ({}): {} cells along {} cannot be halved {} times; give fewer levels or "
          "adapt_remainder = keep",
          place_of(deck, "adapt_levels"), n, "xyz"[d], deck.adapt_levels));
    if (over > 0)
      rest += fmt::format("{}{} of {} cells along {}", rest.empty() ? "" : ", ", over, n, "xyz"[d]);
    std::vector<double>& planes = coarse.grid.planes[d];
    for (std::int64_t i = 0; i <= n / step; ++i)
      planes.push_back(dense.planes[d][static_cast<std::size_t>(i * step)]);
    coarse.high[d] = planes.back();
    if (!keep || over == 0) continue;
    coarse.high[d] = dense.planes[d].back();
    const double size = dense.cell_size()[d];
    const bool thinner = deck.adapt_type == kAdaptResample;
    planes.push_back(thinner ? dense.planes[d].back() : planes.back() + static_cast<double>(step) * size);
    coarse.missing[d] = thinner ? 0 : step - over;
  }
  if (!rest.empty())
    log.line("{}{}: the grid is not a multiple of {} cells; {} at the high sides: {}{}",
             keep ? "" : "WARNING: ", adapt_type_name(deck), step, keep ? "kept" : "dropped", rest,
             keep ? "" : " (adapt_remainder = keep keeps them)");
  return coarse;
}

// What a rank must know of the source for a box of cells of the grid and `margin` cells around it.
IndexBox wanted_of(const Grid& grid, const Grid& source, const IndexBox& cells, std::int64_t margin,
                   const std::array<bool, 3>& periodic) {
  if (cells.empty()) return {};
  IndexBox box;
  for (std::size_t d = 0; d < 3; ++d) {
    std::int64_t lo = cells.lo[d] - margin, hi = cells.hi[d] + margin;
    if (periodic[d] && (lo < 0 || hi > grid.cells[d])) {  // both ends are near
      lo = 0;
      hi = grid.cells[d];
    }
    lo = std::max<std::int64_t>(lo, 0);
    hi = std::min(hi, grid.cells[d]);
    // Cells of the source that overlap it, and one more for rounding; beyond its ends the outermost count.
    const std::vector<double>& planes = source.planes[d];
    const double from = grid.planes[d][static_cast<std::size_t>(lo)],
                 to = grid.planes[d][static_cast<std::size_t>(hi)];
    const auto first = std::upper_bound(planes.begin(), planes.end(), from) - planes.begin() - 2;
    const auto last = std::lower_bound(planes.begin(), planes.end(), to) - planes.begin() + 1;
    box.lo[d] = std::clamp<std::int64_t>(first, 0, source.cells[d] - 1);
    box.hi[d] = std::clamp<std::int64_t>(last, box.lo[d] + 1, source.cells[d]);
  }
  return box;
}

// The cells of a box of blocks.
IndexBox cells_of(const IndexBox& blocks, const Index3& cells) {
  IndexBox box;
  for (std::size_t d = 0; d < 3; ++d) {
    box.lo[d] = std::min(2 * blocks.lo[d], cells[d]);
    box.hi[d] = std::min(2 * blocks.hi[d], cells[d]);
  }
  return box;
}

// The input in the boxes of the ranks.
struct Material {
  std::unique_ptr<MaterialField> field;
  MaterialTable table;
  bool pure = true;
};

class Adapter {
 public:
  Adapter(const Comm& comm, const Deck& deck, MaterialSource& source, CoarseGrid grid, const Log& log,
          Stages& stages)
      : comm_(comm),
        deck_(deck),
        source_(source),
        grid_(std::move(grid.grid)),
        missing_(grid.missing),
        high_(grid.high),
        log_(log),
        stages_(stages),
        layers_(layer_plan(deck).ghost_layers()) {
    periodic_ = periodic_axes(deck, grid_.cells);
  }

  Overlay refined() {
    refuse_odd_periods();
    AdaptCriterion criterion = criterion_of();
    refuse_many_blocks();
    Forest forest(grid_.cells, levels_, periodic_, missing_);
    const CartesianParts cut =
        cut_grid(forest.blocks(0), comm_.size(), {deck_.iproc, deck_.jproc, deck_.kproc});
    print_decomposition(log_, cut);
    BlockParts parts = block_parts(cut, comm_.size());
    Material material = read(parts);
    check_periods(parts.box[me()], material);
    stages_.end("read input");
    name_materials(criterion, material.table);
    collectively(comm_, "choosing the cells to refine", [&] {
      mark_cells(grid_, cells_of(parts.box[me()], grid_.cells), *material.field, criterion, forest);
    });
    comm_.bit_or(forest.words());
    const std::int64_t asked = count_refined(forest);
    forest.close();
    tell(forest, asked);
    if (deck_.adapt_load_balance && comm_.size() > 1) {
      parts = rebalanced(forest);
      material.field.reset();
      material = read(parts);
    }
    stages_.end("choose cells to refine");
    LeafMesh mesh = leaf_mesh(comm_, grid_, forest, parts, layers_, high_);
    tell(mesh);
    stages_.end("refine");
    return overlay(std::move(mesh), material);
  }

  // The coarse grid as it is, with averages of the data.
  Overlay resampled() {
    CartesianParts cut = cut_grid(grid_.cells, comm_.size(), {deck_.iproc, deck_.jproc, deck_.kproc});
    cut.periodic = periodic_;
    print_decomposition(log_, cut);
    std::vector<IndexBox> wanted;
    for (int r = 0; r < comm_.size(); ++r)
      wanted.push_back(wanted_of(grid_, source_.grid(), cut.owned(r), 0, periodic_));
    Material material = read(wanted);
    stages_.end("read input");
    Overlay out = start(lattice_mesh(comm_, grid_, cut, layers_), material);
    out.numbered = numbered_grid(cut, layers_);
    Fractions owned;
    collectively(comm_, "resampling", [&] {
      for (LocalId c = 0; c < out.cells.size(); ++c) {
        const Hex& hex = out.cells.hexes[at(c)];
        if (out.cells.layer[at(c)] == 0)
          material.field->measure({out.cells.position[at(hex[0])], out.cells.position[at(hex[6])]}, owned);
      }
    });
    out.fractions = with_ghosts(out.cells, owned);
    stages_.end("distribute");
    return out;
  }

 private:
  [[nodiscard]] std::size_t me() const { return static_cast<std::size_t>(comm_.rank()); }

  // Cells are refined in pairs, which must meet across the ends.
  void refuse_odd_periods() const {
    for (std::size_t d = 0; d < 3; ++d)
      if (periodic_[d] && (grid_.cells[d] % 2 != 0 || missing_[d] != 0))
        throw Error(fmt::format("periodic: a refined grid needs an even number of cells along {}, found {}{}",
                                "xyz"[d], grid_.cells[d], coarsens(deck_) ? " coarse ones" : ""));
  }
  void check_periods(const IndexBox& blocks, const Material& material) const {
    if (deck_.periodic && deck_.check_periodic && !source_.is_data())
      check_period(comm_, deck_, grid_, periodic_, cells_of(blocks, grid_.cells), *material.field,
                   material.table, log_);
  }

  AdaptCriterion criterion_of() {
    AdaptCriterion c;
    levels_ = deck_.adapt_levels;
    if (deck_.adapt_type == kAdaptMaterial && !deck_.adapt_material.empty() && !deck_.given("adapt_levels")) {
      levels_ = 0;
      for (const NumberRecord& record : deck_.adapt_material)  // each has its own
        levels_ = std::max(
            levels_, record.numbers.size() > 1 ? static_cast<int>(record.numbers[1]) : deck_.adapt_levels);
    }
    const Vec3 h = grid_.cell_size();
    c.threshold = deck_.adapt_threshold >= 0 ? deck_.adapt_threshold : kFractionThreshold;
    c.non_manifold = deck_.adapt_non_manifold;
    switch (deck_.adapt_type) {
      case kAdaptFacetToSurface:
        c.measure = AdaptMeasure::kFacetToSurface;
        break;
      case kAdaptSurfaceToFacet:
        c.measure = AdaptMeasure::kSurfaceToFacet;
        break;
      case kAdaptSurfaceToSurface:
        c.measure = AdaptMeasure::kSurfaceToSurface;
        break;
      case kAdaptMaterial:
        c.measure = AdaptMeasure::kMaterial;
        break;
      default:
        return c;
    }
    if (c.measure == AdaptMeasure::kMaterial) return c;
    if (deck_.adapt_threshold < 0)
      c.threshold = kLengthThreshold * std::min({h.x, h.y, h.z}) / (levels_ * levels_);
    c.exact = source_.exact_surface();
    if (!c.exact && c.measure != AdaptMeasure::kSurfaceToSurface)
      throw Error(fmt::format(
          "option 'adapt_type' ({}): {} measures the distance from facets or shapes, but the input has "
          "none; use surface_to_surface or vfrac_average",
          place_of(deck_, "adapt_type"), adapt_type_name(deck_)));
    if (source_.is_data()) {
      c.threshold = std::numeric_limits<double>::infinity();
      log_.line(
          "WARNING: {}: the input is data on the cells of the grid, which has no finer surface; nothing is "
          "refined but "
          "with vfrac_average or material",
          adapt_type_name(deck_));
    }
    return c;
  }

  // Every rank holds a bit for every block that there could be, and the owner and the weight of those of
  // level 0.
  void refuse_many_blocks() const {
    constexpr double kBytes = 12;
    const double cells = static_cast<double>(grid_.cell_count());
    const double bytes = std::ldexp(cells, 3 * levels_ - 6) / 7 + kBytes * cells / 8;
    if (bytes <= kMostBytes) return;
    throw Error(fmt::format(
        "option 'adapt_levels' ({}): the {} x {} x {} cells of the grid cannot be halved {} times, it would "
        "take {:.3g} GB on every rank to keep track; give fewer levels or a coarser grid",
        place_of(deck_, "adapt_levels"), grid_.cells[0], grid_.cells[1], grid_.cells[2], levels_,
        1e-9 * bytes));
  }

  // The records of adapt_material, now that the materials are known.
  void name_materials(AdaptCriterion& c, const MaterialTable& table) {
    if (c.measure != AdaptMeasure::kMaterial) return;
    for (const NumberRecord& record : deck_.adapt_material) {
      const std::vector<double>& n = record.numbers;
      const auto id = static_cast<std::int64_t>(n[0]);
      const auto found = std::find(table.block_id.begin(), table.block_id.end(), id);
      if (found == table.block_id.end())
        throw Error(fmt::format("option 'adapt_material' ({}): no material with id {} in the input",
                                place_of(deck_, "adapt_material"), n[0]));
      c.materials.push_back({static_cast<std::int32_t>(found - table.block_id.begin()),
                             n.size() > 1 ? static_cast<int>(n[1]) : deck_.adapt_levels,
                             n.size() > 2 ? n[2] : kFractionThreshold, n.size() > 3 ? n[3] : 0.0});
    }
    if (c.materials.empty())
      log_.line("WARNING: adapt_type = material without adapt_material refines nothing");
  }

  // Cells of the grid that the criterion looks at around those of a rank.
  [[nodiscard]] std::int64_t margin() const {
    const Vec3 h = grid_.cell_size();
    double reach = 0;
    if (deck_.adapt_type == kAdaptMaterial)
      for (const NumberRecord& record : deck_.adapt_material)
        if (record.numbers.size() > 3) reach = std::max(reach, record.numbers[3] / std::min({h.x, h.y, h.z}));
    const std::int64_t all = std::max({grid_.cells[0], grid_.cells[1], grid_.cells[2]});
    return 2 + static_cast<std::int64_t>(std::ceil(std::min(reach, static_cast<double>(all))));
  }

  Material read(const BlockParts& parts) {
    std::vector<IndexBox> wanted;
    for (const IndexBox& blocks : parts.box)
      if (!source_.is_data())
        wanted.emplace_back();  // shapes are known everywhere
      else
        wanted.push_back(
            wanted_of(grid_, source_.grid(), cells_of(blocks, grid_.cells), margin(), periodic_));
    return read(wanted);
  }
  Material read(const std::vector<IndexBox>& wanted) {
    MaterialData data = source_.read(comm_, wanted);
    Material m;
    const bool pure = data.fractions.material.size() == static_cast<std::size_t>(data.fractions.cells());
    m.pure = source_.is_data() && comm_.min(std::int64_t{pure}) == 1;
    m.table = std::move(data.table);
    m.field = source_.field(std::move(data.fractions), wanted[me()]);
    return m;
  }

  [[nodiscard]] static std::int64_t count_refined(Forest& forest) {
    std::int64_t count = 0;
    for (const std::uint64_t word : forest.words()) count += std::popcount(word);
    return count;
  }

  void tell(Forest& forest, std::int64_t asked) const {
    const std::int64_t all = count_refined(forest);
    log_.line(
        "adapting the grid: {} blocks of 2 x 2 x 2 cells to be refined, {} more so that the mesh conforms",
        asked, all - asked);
    if (deck_.adapt_memory_stats)
      log_.line("  memory before refinement: at most {:.1f} MB per rank, {:.1f} MB of it for the levels",
                static_cast<double>(comm_.max(peak_kib())) / 1024,
                static_cast<double>(8 * forest.words().size()) / 1048576);
  }

  // Hexes of each level; transitions count as the coarser one.
  void tell(const LeafMesh& mesh) const {
    std::vector<std::int64_t> plain(static_cast<std::size_t>(levels_) + 1, 0), transition(plain);
    for (const Leaf& leaf : mesh.leaves)
      (leaf.transition ? transition : plain)[static_cast<std::size_t>(leaf.level)] += leaf.end - leaf.first;
    comm_.sum(plain);
    comm_.sum(transition);
    for (std::size_t l = 0; l < plain.size(); ++l)
      log_.line(
          "  level {}: {} cubes{}", l, plain[l],
          transition[l] > 0 ? fmt::format(", {} hexes in transition to level {}", transition[l], l + 1) : "");
    if (deck_.adapt_memory_stats)
      log_.line("  memory after refinement: at most {:.1f} MB per rank, {:.1f} MB in all",
                static_cast<double>(comm_.max(peak_kib())) / 1024,
                static_cast<double>(comm_.sum(peak_kib())) / 1024);
  }

  BlockParts rebalanced(const Forest& forest) const {
    const IndexBox blocks = whole(forest.blocks(0));
    std::vector<std::int64_t> weight(static_cast<std::size_t>(blocks.size()), 0);
    for (std::int64_t b = comm_.rank(); b < blocks.size(); b += comm_.size())
      weight[static_cast<std::size_t>(b)] = hexes_in(forest, blocks.cell(b));
    comm_.sum(weight);
    return balanced_parts(forest.blocks(0), weight, comm_.size());
  }

  Overlay start(HexMesh cells, Material& material) const {
    Overlay out;
    out.cells = std::move(cells);
    out.materials = std::move(material.table);
    out.grid = out.numbered = grid_.cells;
    out.pure = material.pure;
    out.exact = source_.exact_surface();
    out.features = source_.features();
    out.axes = source_.axes();
    out.geometry = wanted_surfaces(deck_, source_);
    return out;
  }
  Overlay overlay(LeafMesh mesh, Material& material) const {
    Fractions owned;
    collectively(comm_, "measuring the refined cells",
                 [&] { owned = leaf_fractions(grid_, mesh, *material.field); });
    Overlay out = start(std::move(mesh.cells), material);
    out.fractions = with_ghosts(out.cells, owned);
    stages_.end("measure refined cells");
    return out;
  }

  const Comm& comm_;
  const Deck& deck_;
  MaterialSource& source_;
  Grid grid_;
  Index3 missing_;  // cells of the finest level that its last cells lack
  Vec3 high_;       // corner of the domain
  const Log& log_;
  Stages& stages_;
  int layers_, levels_ = 0;
  std::array<bool, 3> periodic_;
};

}  // namespace

Overlay read_adapted(const Comm& comm, const Deck& deck, MaterialSource& source, const Grid& grid,
                     const Log& log, Stages& stages) {
  if (!coarsens(deck)) {
    const Vec3 high{grid.planes[0].back(), grid.planes[1].back(), grid.planes[2].back()};
    return Adapter(comm, deck, source, {grid, {0, 0, 0}, high}, log, stages).refined();
  }
  if (!source.is_data())
    throw Error(fmt::format(
        "option 'adapt_type' ({}): {} needs data on a dense grid; shapes are refined by vfrac_average",
        place_of(deck, "adapt_type"), adapt_type_name(deck)));
  Adapter adapter(comm, deck, source, coarse_grid(deck, grid, log), log, stages);
  return deck.adapt_type == kAdaptCoarsen ? adapter.refined() : adapter.resampled();
}

}  // namespace sculpt
