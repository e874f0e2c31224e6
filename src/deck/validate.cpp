// Defaults that depend on the input, unsupported options, and the rules between options.
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>

#include "deck/value.hpp"
#include "sculpt/base/error.hpp"
#include "sculpt/deck/options.hpp"
#include "sculpt/deck/parse.hpp"

namespace sculpt {

namespace {

using Names = std::vector<std::string_view>;

constexpr std::string_view kSources[] = {"stl_file",       "diatom_file", "input_vfrac", "input_micro",
                                         "input_cart_exo", "input_spn",   "input_stitch"};

enum class Tell {
  kGiven,    // the options that were given
  kMissing,  // also the names of those that were not
  kAll,      // the values of all of them
};

// A rule between options: when `broken`, the sentence is shown together with the options and their places.
struct Rule {
  bool (*broken)(const Deck&);
  Names options;
  std::string_view sentence;
  Tell tell = Tell::kGiven;
};

bool all_given(const Deck& deck, std::initializer_list<std::string_view> options) {
  for (const std::string_view option : options)
    if (!deck.given(option)) return false;
  return true;
}

int count_sources(const Deck& deck) {
  int count = 0;
  for (const std::string_view source : kSources) count += deck.given(source) ? 1 : 0;
  return count;
}

// The overlay grid is a mesh.
bool has_mesh(const Deck& deck) { return deck.given("input_mesh") || deck.given("input_mesh_pamgen"); }

bool has_counts(const Deck& deck) { return all_given(deck, {"nelx", "nely", "nelz"}); }

// More cells than a 64-bit id can number with room to spare. The counts are at least 1 where they are given.
bool too_many_cells(const Deck& deck) {
  constexpr std::int64_t kLimit = std::int64_t{1} << 62;
  return deck.nelx > kLimit / deck.nely / deck.nelz;
}

bool wrong_parts(const Deck& deck) {
  const std::int64_t plane = static_cast<std::int64_t>(deck.iproc) * deck.jproc;  // at most 1e12
  return plane > deck.num_procs || plane * deck.kproc != deck.num_procs;
}

// Some but not all of the three: the missing ones are chosen, so the product must divide the number of ranks.
bool wrong_part(const Deck& deck) {
  std::int64_t product = 1;
  for (const int parts : {deck.iproc, deck.jproc, deck.kproc})
    if (parts > 0 && product <= deck.num_procs) product *= parts;
  return product > deck.num_procs || deck.num_procs % product != 0;
}

bool carries_sets(const Deck& deck) {
  return deck.gen_sidesets == kSidesetsInputMesh || deck.gen_sidesets == kSidesetsInputMeshAndStl ||
         deck.gen_sidesets == kSidesetsInputMeshAndFreeSurfaces;
}

bool wants_surfaces(const Deck& deck) {
  return deck.gen_sidesets == kSidesetsGeometricSurfaces || deck.gen_sidesets == kSidesetsGeometricSidesets ||
         deck.gen_sidesets == kSidesetsInputMeshAndStl;
}

bool coarsens(const Deck& deck) {
  return deck.adapt_type == kAdaptCoarsen || deck.adapt_type == kAdaptResample;
}

bool empty_x(const Deck& deck) { return all_given(deck, {"xmin", "xmax"}) && deck.xmin >= deck.xmax; }
bool empty_y(const Deck& deck) { return all_given(deck, {"ymin", "ymax"}) && deck.ymin >= deck.ymax; }
bool empty_z(const Deck& deck) { return all_given(deck, {"zmin", "zmax"}) && deck.zmin >= deck.zmax; }

int periodic_directions(const Deck& deck) {
  return std::popcount(static_cast<unsigned>(deck.periodic_directions));
}
bool wrong_nodesets(const Deck& deck) {
  std::vector<std::int64_t> ids = deck.periodic_nodesets;
  std::sort(ids.begin(), ids.end());
  return ids.size() != static_cast<std::size_t>(2 * periodic_directions(deck)) ||
         std::adjacent_find(ids.begin(), ids.end()) != ids.end();
}

const std::vector<Rule>& rules() {
  static const Names counts = {"nelx", "nely", "nelz"};
  static const std::vector<Rule> table = {
      {[](const Deck& d) { return count_sources(d) == 0 && !has_mesh(d); },
       {},
       "no input geometry; give one of stl_file, diatom_file, input_vfrac, input_micro, input_cart_exo, "
       "input_spn or input_stitch"},
      {[](const Deck& d) { return count_sources(d) > 1; }, Names(std::begin(kSources), std::end(kSources)),
       "only one input geometry is allowed"},
      {[](const Deck& d) {
         return all_given(d, {"input_mesh", "input_mesh_pamgen"});
       },
       {"input_mesh", "input_mesh_pamgen"},
       "only one mesh can be the overlay grid"},
      {[](const Deck& d) {
         return has_mesh(d) && (d.given("input_micro") || d.given("input_cart_exo") ||
                                d.given("input_vfrac") || d.given("input_stitch"));
       },
       {"input_mesh", "input_mesh_pamgen", "input_micro", "input_cart_exo", "input_vfrac", "input_stitch"},
       "input_mesh takes its materials from its element variables, stl_file, diatom_file or input_spn"},
      {[](const Deck& d) { return d.given("input_mesh_pamgen") && count_sources(d) == 0; },
       {"input_mesh_pamgen"},
       "input_mesh_pamgen has no element variables; give one of stl_file, diatom_file or input_spn"},
      {[](const Deck& d) { return d.given("input_mesh_blocks") && !has_mesh(d); },
       {"input_mesh_blocks"},
       "input_mesh_blocks needs input_mesh or input_mesh_pamgen"},
      {[](const Deck& d) { return carries_sets(d) && !has_mesh(d); },
       {"gen_sidesets"},
       "gen_sidesets = input_mesh, input_mesh_and_stl and input_mesh_and_free_surfaces carry the sets of an "
       "input mesh over; give input_mesh or input_mesh_pamgen"},
      {[](const Deck& d) { return wants_surfaces(d) && !d.given("diatom_file") && !d.given("stl_file"); },
       {"gen_sidesets"},
       "gen_sidesets = geometric_surfaces, geometric_sidesets and input_mesh_and_stl need a geometry that "
       "has "
       "surfaces, not fractions or voxels; give diatom_file or stl_file"},
      {[](const Deck& d) { return d.given("input_spn") && !has_counts(d); }, counts,
       "input_spn needs the number of cells nelx, nely and nelz", Tell::kMissing},
      {[](const Deck& d) {
         return (d.given("diatom_file") || d.given("stl_file")) && !has_mesh(d) && !d.given("cell_size") &&
                !has_counts(d);
       },
       counts, "diatom_file and stl_file need cell_size, or the number of cells nelx, nely and nelz",
       Tell::kMissing},
      {[](const Deck& d) { return d.align && d.given("volfrac_file"); },
       {"align", "volfrac_file"},
       "volume fractions of a turned grid cannot be written; give one of both"},
      {[](const Deck& d) { return d.capture != kCaptureOff && d.stair != kStairOff; },
       {"capture", "stair"},
       "stair keeps the cells as they are, capture moves their nodes to the facets"},
      {[](const Deck& d) { return d.capture != kCaptureOff && d.smooth == kSmoothOff; },
       {"capture", "smooth"},
       "smooth = off leaves nodes where the contour has them, capture moves them to the facets"},
      {[](const Deck& d) { return d.align && d.periodic; },
       {"align", "periodic"},
       "align turns the grid, periodic = true needs it along the coordinates"},
      {[](const Deck& d) {
         return d.given("input_vfrac") && (d.smooth == kSmoothToGeometry || d.capture != kCaptureOff);
       },
       {"input_vfrac", "smooth", "capture"},
       "smooth = to_geometry and capture need the geometry itself, which volume fractions do not have; give "
       "diatom_file or stl_file"},
      {[](const Deck& d) {
         return d.given("volfrac_file") &&
                (d.volfrac_file == d.exodus_file || d.volfrac_file == d.input_vfrac);
       },
       {"volfrac_file", "exodus_file", "input_vfrac"},
       "volfrac_file would write over other files of the run; its base name must differ",
       Tell::kAll},
      {[](const Deck& d) { return d.given("input_vfrac") && d.input_vfrac == d.exodus_file; },
       {"input_vfrac", "exodus_file"},
       "the mesh would be written over the volume fractions; its base name must differ",
       Tell::kAll},
      {empty_x, {"xmin", "xmax"}, "xmin must be smaller than xmax"},
      {empty_y, {"ymin", "ymax"}, "ymin must be smaller than ymax"},
      {empty_z, {"zmin", "zmax"}, "zmin must be smaller than zmax"},
      {[](const Deck& d) { return has_counts(d) && too_many_cells(d); }, counts,
       "the grid has more cells than can be numbered, nelx * nely * nelz must not exceed 2^62"},
      {[](const Deck& d) {
         return all_given(d, {"iproc", "jproc", "kproc"}) && wrong_parts(d);
       },
       {"iproc", "jproc", "kproc", "num_procs"},
       "iproc * jproc * kproc must be the number of processes",
       Tell::kAll},
      {[](const Deck& d) {
         return !all_given(d, {"iproc", "jproc", "kproc"}) && wrong_part(d);
       },
       {"iproc", "jproc", "kproc", "num_procs"},
       "the product of the given ones of iproc, jproc and kproc must divide the number of processes",
       Tell::kAll},
      {[](const Deck& d) {
         return d.pillow > kPillowCurvesNoSmoothing && d.given("pillow_curve_layers") &&
                d.pillow % 10 != d.pillow_curve_layers;
       },
       {"pillow", "pillow_curve_layers"},
       "pillow and pillow_curve_layers ask for different numbers of layers"},
      {[](const Deck& d) { return coarsens(d) && (d.given("stl_file") || d.given("diatom_file")); },
       {"adapt_type", "stl_file", "diatom_file"},
       "adapt_type = coarsen and resample need data on a dense grid; shapes are refined by vfrac_average"},
      {[](const Deck& d) { return coarsens(d) && d.micro_expand > 0; },
       {"adapt_type", "micro_expand"},
       "micro_expand adds layers to the grid as it was read; adapt_type must not be coarsen or resample"},
      {[](const Deck& d) {
         return !d.adapt_material.empty() && d.adapt_type != kAdaptMaterial && d.adapt_type != kAdaptOff;
       },
       {"adapt_material", "adapt_type"},
       "adapt_material needs adapt_type = material"},
      {[](const Deck& d) { return d.xscale <= 0 || d.yscale <= 0 || d.zscale <= 0 || d.scale <= 0; },
       {"xscale", "yscale", "zscale", "scale"},
       "scale factors must be positive"},
      {[](const Deck& d) {
         return d.smooth == kSmoothToGeometry &&
                (d.surface_projection == kProjectionNone || d.surface_projection == kProjectionQuadric);
       },
       {"smooth", "surface_projection"},
       "smooth = to_geometry holds surfaces on the geometry; surface_projection must be automatic or "
       "interface"},
      {[](const Deck& d) { return d.smooth == kSmoothGeoSmooth && d.opt_method == kOptJacobi; },
       {"smooth", "opt_method"},
       "opt_method = jacobi knows no limit of deviation; smooth must not be geo_smooth"},
      {[](const Deck& d) {
         return d.opt_method != kOptJacobi && (!d.opt_damping || d.opt_metric != kOptShape);
       },
       {"opt_method", "opt_damping", "opt_metric"},
       "opt_damping and opt_metric need opt_method = jacobi"},
      {[](const Deck& d) {
         return !d.periodic && (d.given("periodic_directions") || d.given("periodic_nodesets"));
       },
       {"periodic", "periodic_directions", "periodic_nodesets"},
       "periodic_directions and periodic_nodesets need periodic = true"},
      {[](const Deck& d) { return d.periodic && d.given("periodic_nodesets") && wrong_nodesets(d); },
       {"periodic_directions", "periodic_nodesets"},
       "periodic_nodesets needs two ids for each periodic direction, all of them different",
       Tell::kAll},
      {[](const Deck& d) { return d.periodic && d.micro_expand > 0; },
       {"periodic", "micro_expand"},
       "micro_expand puts cells around the data, but the next period begins where periodic data end"},
      {[](const Deck& d) {
         return d.periodic && d.periodic_directions == kAlongXYZ && d.pillow_boundary_layers > 0;
       },
       {"periodic", "periodic_directions", "pillow_boundary_layers"},
       "pillow_boundary_layers puts layers along flat sides; a mesh that is periodic in x, y and z has none",
       Tell::kAll},
  };
  return table;
}

// "; given: nelx = 3 (line 2 of a.i); not given: nely, nelz"
std::string describe(const Deck& deck, const Names& options, Tell tell) {
  std::vector<std::string> given, missing;
  for (const std::string_view name : options) {
    if (!deck.given(name) && tell != Tell::kAll) {
      missing.emplace_back(name);
      continue;
    }
    const std::vector<std::string> texts = deck_texts(deck, *find_option(name));
    const std::string place = deck.given(name) ? deck.given_options.place(name) : "not given";
    given.push_back(fmt::format("{} = {} ({})", name, texts.empty() ? "" : texts[0], place));
  }
  std::string result;
  if (!given.empty())
    result += fmt::format("; {}: {}", tell == Tell::kAll ? "found" : "given", fmt::join(given, ", "));
  if (tell == Tell::kMissing) result += fmt::format("; not given: {}", fmt::join(missing, ", "));
  return result;
}

void refuse_unsupported(const Deck& deck) {
  for (const OptionSpec& option : option_table()) {
    if (!deck.given(option.name)) continue;
    if (!option.supported) {
      const auto* flag = std::get_if<bool Deck::*>(&option.slot);
      const bool harmless = flag != nullptr ? !(deck.**flag) : equals_default(deck, option);
      if (!harmless)
        throw Error(fmt::format("option '{}' ({}) is not supported yet", option.name,
                                deck.given_options.place(option.name)));
    } else if (!option.values.empty()) {
      const EnumValue* value = find_value(option, deck.*std::get<int Deck::*>(option.slot));
      if (value != nullptr && !value->supported)
        throw Error(fmt::format("option '{}' ({}): value {} ({}) is not supported yet", option.name,
                                deck.given_options.place(option.name), value->name, value->number));
    }
  }
}

// The numbers of a record: id, levels, fraction, distance and one that Sculpt knows alone.
struct RecordNumber {
  std::string_view what;
  double lo, hi;
  bool whole;
  std::string_view expected;
};
constexpr RecordNumber kMaterialRecord[] = {
    {"the id", 0, 2147483647.0, true, "a whole number from 0 to 2147483647"},
    {"the levels", 0, 20, true, "a whole number from 0 to 20"},
    {"the volume fraction", 0, 1, false, "a number from 0 to 1"},
    {"the distance", 0, HUGE_VAL, false, "a length that is not negative"},
};
constexpr std::size_t kMostRecordNumbers = 5;

void check_adapt_materials(const Deck& deck) {
  for (std::size_t r = 0; r < deck.adapt_material.size(); ++r) {
    const std::vector<double>& numbers = deck.adapt_material[r].numbers;
    const std::string begin =
        fmt::format("option 'adapt_material' ({}): record {} ({:g})",
                    deck.given_options.place("adapt_material"), r + 1, fmt::join(numbers, " "));
    if (numbers.size() > kMostRecordNumbers)
      throw Error(
          fmt::format("{} has {} numbers; expected at most 5: id, levels, volume fraction, distance "
                      "and one without effect",
                      begin, numbers.size()));
    for (std::size_t n = 0; n < std::min(numbers.size(), std::size(kMaterialRecord)); ++n) {
      const RecordNumber& must = kMaterialRecord[n];
      const bool whole = !must.whole || numbers[n] == std::floor(numbers[n]);
      if (!(numbers[n] >= must.lo && numbers[n] <= must.hi && whole))
        throw Error(
            fmt::format("{}: {} must be {}, found {:g}", begin, must.what, must.expected, numbers[n]));
    }
  }
}

void redefault(Deck& deck, std::string_view option, auto& field, auto value) {
  if (deck.given(option) || field == value) return;
  field = value;
  deck.redefaulted.emplace(option);
}

// The name of a file without folder and extension; empty when nothing is left.
std::string stem(const std::string& file_name) { return std::filesystem::path(file_name).stem().string(); }

std::string default_base_name(const Deck& deck) {
  std::string base = stem(deck.input_file);
  for (const std::string* name :
       {&deck.stl_file, &deck.diatom_file, &deck.input_micro, &deck.input_cart_exo, &deck.input_spn,
        &deck.input_stitch, &deck.input_mesh, &deck.input_mesh_pamgen})
    if (base.empty()) base = stem(*name);
  return base.empty() ? "sculpt" : base;
}

}  // namespace

void apply_input_defaults(Deck& deck) {
  redefault(deck, "exodus_file", deck.exodus_file, default_base_name(deck));
  if (deck.given("input_spn")) apply_voxel_defaults(deck);
}

void apply_voxel_defaults(Deck& deck) {
  redefault(deck, "smooth", deck.smooth, static_cast<int>(kSmoothNoSurfaceProjections));
  redefault(deck, "csmooth", deck.csmooth, static_cast<int>(kCsmoothHermite));
  redefault(deck, "laplacian_iters", deck.laplacian_iters, 10);
}

void validate(const Deck& deck) {
  refuse_unsupported(deck);
  check_adapt_materials(deck);
  for (const Rule& rule : rules()) {
    if (!rule.broken(deck)) continue;
    throw Error(std::string(rule.sentence) + describe(deck, rule.options, rule.tell));
  }
}

}  // namespace sculpt
