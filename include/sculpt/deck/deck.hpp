#pragma once
// Deck: every option of a run, typed. One field per Sculpt 16.14 option and per option of our own, named as
// its long option name and holding its default. The option table (options.hpp) says what each one means; the
// parser (parse.hpp) fills it. Lengths are in the units of the input; enumerations hold Sculpt's numbers,
// named below.
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace sculpt {

enum SpnOrder : int { kSpnXyz = 0, kSpnXzy, kSpnYxz, kSpnYzx, kSpnZxy, kSpnZyx };  // outermost loop first

enum Stair : int { kStairOff = 0, kStairFull = 1, kStairInterior = 2, kStairFast = 3 };

enum GenSidesets : int {
  kSidesetsOff = 0,
  kSidesetsFixed = 1,
  kSidesetsVariable = 2,
  kSidesetsGeometricSurfaces = 3,
  kSidesetsGeometricSidesets = 4,
  kSidesetsRve = 5,
  kSidesetsInputMeshAndStl = 6,
  kSidesetsInputMeshAndFreeSurfaces = 7,
  kSidesetsRveVariable = 8,
  kSidesetsInputMesh = 9,
};

enum AdaptType : int {
  kAdaptOff = 0,
  kAdaptFacetToSurface = 1,
  kAdaptSurfaceToFacet = 2,
  kAdaptSurfaceToSurface = 3,
  kAdaptVfracAverage = 4,
  kAdaptCoarsen = 5,
  kAdaptResample = 6,
  kAdaptMaterial = 7,
};

// What becomes of cells of dense data beyond a multiple of 2^adapt_levels.
enum AdaptRemainder : int {
  kRemainderDrop = 0,
  kRemainderKeep = 1,
};

enum Smooth : int {
  kSmoothOff = 0,
  kSmoothOn = 1,
  kSmoothFixedBbox = 2,
  kSmoothNoSurfaceProjections = 3,
  kSmoothToGeometry = 4,
  kSmoothGeoSmooth = 5,
};

enum Csmooth : int {
  kCsmoothOff = 0,
  kCsmoothCircle = 1,
  kCsmoothHermite = 2,
  kCsmoothAverageTangent = 3,
  kCsmoothNeighborSurfaceNormal = 4,
  kCsmoothVfrac = 5,
  kCsmoothLinear = 6,
};

enum VfracMethod : int { kVfracLines = 0, kVfracPoints = 1 };

// Options of ours, not Sculpt's.
enum SurfaceProjectionChoice : int {
  kProjectionAutomatic = 0,
  kProjectionNone = 1,
  kProjectionQuadric = 2,
  kProjectionInterface = 3,
};
enum OptMethod : int { kOptNewton = 0, kOptJacobi = 1 };
enum OptMetric : int { kOptShape = 0, kOptShapeAndSize = 1 };

enum Pillow : int {
  kPillowOff = 0,
  kPillowSurfaces = 1,
  kPillowCurves = 2,
  kPillowDomainBoundaries = 3,
  kPillowSurfacesNoSmoothing = 100,
  kPillowCurvesNoSmoothing = 200,  // + number of layers
  kPillowCurvesSmoothed = 210,     // + number of layers
};

// An option of ours, not Sculpt's.
enum VolumeCorrectionMode : int { kVolumesAutomatic = 0, kVolumesOff = 1, kVolumesOn = 2 };

enum CaptureMode : int { kCaptureOff = 0, kCaptureCurves = 5 };  // 1 to 4: surfaces only

enum Defeature : int { kDefeatureOff = 0, kDefeatureFilter = 1, kDefeatureCollapse = 2, kDefeatureAll = 3 };

enum HtetMethod : int { kHtetStructured = 0, kHtetUnstructured = 1 };
enum HtetTransition : int { kHtetNone = 0, kHtetPyramid = 1, kHtetTiedContact = 2 };
enum InputMeshMaterial : int { kMeshMaterialAutomatic = 0, kMeshMaterialGeometryAndBlocks = 1 };
// Options of ours, not Sculpt's.
enum InputMeshPartition : int {
  kPartitionRcb = 0,
  kPartitionRib = 1,
  kPartitionHsfc = 2,
  kPartitionGraph = 3
};
enum ExteriorSliding : int { kSlidingExact = 0, kSlidingSurface = 1 };
enum PeriodicAxis : int { kAxisNone = 0, kAxisX = 1, kAxisY = 2, kAxisZ = 3 };
// An option of ours, not Sculpt's: bit d stands for axis d.
enum PeriodicDirections : int {
  kAlongX = 1,
  kAlongY = 2,
  kAlongXY = 3,
  kAlongZ = 4,
  kAlongXZ = 5,
  kAlongYZ = 6,
  kAlongXYZ = 7
};

// `thicken_material = 3 0.2`, `thicken_material = 1 auto`
struct MaterialValue {
  static constexpr double kAuto = -1;  // the program finds the value
  std::int64_t id = 0;
  double value = 0;
  bool operator==(const MaterialValue&) const = default;
};

// `material_name = 3 copper`, and the same for sidesets and nodesets
struct IdName {
  std::int64_t id = 0;
  std::string name;
  bool operator==(const IdName&) const = default;
};

// `sideset = 7 0 0 0 1 1 0`: the set with this id holds what lies in the box xmin ymin zmin xmax ymax zmax
struct IdBox {
  std::int64_t id = 0;
  std::array<double, 6> box{};
  bool operator==(const IdBox&) const = default;
};

// `adapt_material = 10000 2 0.0001 0 0`
struct NumberRecord {
  std::vector<double> numbers;
  bool operator==(const NumberRecord&) const = default;
};

// The options that the user gave, each with the place of its last mention. Equality looks at the names alone.
class GivenOptions {
 public:
  void add(std::string_view option, std::string_view place) {
    places_.insert_or_assign(std::string(option), std::string(place));
  }
  void remove(std::string_view option) {
    if (const auto found = places_.find(option); found != places_.end()) places_.erase(found);
  }
  [[nodiscard]] bool has(std::string_view option) const { return places_.find(option) != places_.end(); }
  // "line 7 of deck.i" or "command line"; empty when the option was not given.
  [[nodiscard]] std::string place(std::string_view option) const {
    const auto found = places_.find(option);
    return found == places_.end() ? std::string() : found->second;
  }
  bool operator==(const GivenOptions& other) const {
    if (places_.size() != other.places_.size()) return false;
    auto mine = places_.begin();
    for (const auto& [name, place] : other.places_)
      if ((mine++)->first != name) return false;
    return true;
  }

 private:
  std::map<std::string, std::string, std::less<>> places_;
};

struct Deck {
  // Process Control
  int num_procs = 1;
  std::string mpi;  // the launcher's mpiexec; empty: the one on PATH
  std::string input_file;
  int debug_processor = -1;  // -1: none
  int debug_flag = 0;
  bool quiet = false;
  bool print_input = false;
  bool version = false;
  int threads_process = 1;
  int iproc = 0, jproc = 0, kproc = 0;  // 0: chosen by the program
  bool build_ghosts = false;
  int vfrac_method = kVfracLines;
  bool cubit_launch = false;

  // Input Data Files; an empty name means not used
  std::string stl_file;
  std::string diatom_file;
  std::string input_vfrac;
  std::string input_micro;
  std::string input_cart_exo;
  std::string input_spn;
  int spn_xyz_order = kSpnXyz;
  bool compress_spn_ids = false;
  std::string input_stitch;
  double stitch_timestep = -1;           // -1: the last one
  std::int64_t stitch_timestep_id = -1;  // -1: the last one
  std::string stitch_field;
  bool stitch_info = false;
  std::string lattice;

  // Output
  std::string exodus_file;
  bool large_exodus = false;
  std::string volfrac_file;
  std::string quality;            // file name; "true": named after the mesh
  bool quality_variable = false;  // ours
  double require_quality = -1;    // ours; -1: nothing is required
  bool export_comm_maps = false;
  bool write_geom = false;
  bool write_mbg = false;
  bool compare_volume = false;
  bool compute_ss_stats = false;

  // Overlay Grid Specification
  std::int64_t nelx = 0, nely = 0, nelz = 0;  // 0: not given
  double xmin = 0, ymin = 0, zmin = 0;        // meaningful when given() or set from the input
  double xmax = 0, ymax = 0, zmax = 0;
  double cell_size = 0;  // 0: not used
  bool align = false;
  double bbox_expand = 0;  // percent
  std::string input_mesh;
  std::vector<std::int64_t> input_mesh_blocks;  // empty: all
  int input_mesh_material = kMeshMaterialAutomatic;
  std::string input_mesh_pamgen;
  int input_mesh_partition = kPartitionRcb;  // ours
  double feature_angle = 135;                // ours; degrees
  int exterior_sliding = kSlidingExact;      // ours
  bool join_parallel = false;

  // Mesh Type; thresholds of -1 never apply, as no scaled Jacobian is smaller
  int stair = kStairOff;
  bool mesh_void = false;
  bool trimesh = false;
  bool tetmesh = false;
  double deg_threshold = -1;
  int max_deg_iters = 0;
  double htet = -1;
  int htet_method = kHtetStructured;
  std::vector<std::int64_t> htet_material;
  int htet_transition = kHtetNone;
  std::vector<std::int64_t> htet_pyramid, htet_tied_contact, htet_no_interface;
  bool periodic = false;
  int periodic_directions = kAlongXYZ;
  bool check_periodic = true;
  double check_periodic_tol = 0.01;
  int periodic_axis = kAxisNone;
  std::vector<std::int64_t> periodic_nodesets;  // pairs, one after the other

  // Boundary Conditions
  std::int64_t void_mat = 0;  // 0: largest material id + 1
  bool separate_void_blocks = false;
  std::vector<IdName> material_name, sideset_name, nodeset_name;
  std::vector<IdBox> sideset, nodeset;
  int gen_sidesets = kSidesetsOff;
  bool rve_sets = false;                     // ours
  std::int64_t free_surface_sideset = 0;     // 0: none
  std::vector<std::int64_t> match_sidesets;  // pairs, one after the other
  std::int64_t match_sidesets_nodeset = 0;   // 0: none

  // Adaptive Meshing
  int adapt_type = kAdaptOff;
  double adapt_threshold = -1;  // -1: depends on adapt_type
  int adapt_levels = 2;
  std::vector<NumberRecord> adapt_material;
  int adapt_remainder = kRemainderDrop;
  bool adapt_export = false;
  bool adapt_non_manifold = false;
  bool adapt_load_balance = false;
  bool adapt_memory_stats = false;

  // Smoothing; smooth, csmooth and laplacian_iters also depend on the input, see apply_input_defaults
  int smooth = kSmoothOn;
  int csmooth = kCsmoothVfrac;
  int laplacian_iters = 2;
  int max_opt_iters = 5;
  double opt_threshold = 0.6;
  double curve_opt_thresh = 0.1;
  int max_pcol_iters = 100;
  double pcol_threshold = 0.3;
  int max_gq_iters = 0;
  double gq_threshold = 0.2;
  double geo_smooth_max_deviation = 0;  // 0: half a cell
  int surface_projection = kProjectionAutomatic;
  int opt_method = kOptNewton;
  bool opt_damping = true;
  int opt_metric = kOptShape;

  // Mesh Improvement
  int pillow = kPillowOff;
  bool pillow_surfaces = false;
  bool pillow_curves = false;
  bool pillow_boundaries = false;
  int pillow_curve_layers = 3;
  double pillow_curve_thresh = 0.3;
  bool pillow_smooth_off = false;
  int pillow_boundary_layers = 0;
  int volume_correction = kVolumesAutomatic;  // ours
  int capture = 0;
  double capture_angle = 30;      // degrees
  std::int64_t capture_side = 0;  // 0: all
  int defeature = kDefeatureOff;
  int min_vol_cells = 5;
  bool defeature_bbox = false;
  int defeature_iters = 10;
  std::vector<MaterialValue> thicken_material;
  double thicken_void = 0;
  int micro_expand = 0;
  bool micro_shave = false;
  bool resolve_reversals = false;  // ours
  bool keep_materials = false;     // ours
  double remove_bad = -1;          // -1: nothing is removed
  int wear_method = 0;
  double crack_min_elem_thickness = 0;
  int min_num_layers = 0;

  // Mesh Transformation: written coordinate = coordinate * scale * [xyz]scale + [xyz]translate
  double xtranslate = 0, ytranslate = 0, ztranslate = 0;
  double xscale = 1, yscale = 1, zscale = 1;
  double scale = 1;

  GivenOptions given_options;
  std::set<std::string, std::less<>> redefaulted;  // set by apply_input_defaults, not by the user

  // Was the option (long name) set by the user, in the deck or on the command line?
  [[nodiscard]] bool given(std::string_view option) const { return given_options.has(option); }
  bool operator==(const Deck&) const = default;
};

// Whether the materials are known as shapes, everywhere.
[[nodiscard]] inline bool has_shapes(const Deck& deck) {
  return !deck.stl_file.empty() || !deck.diatom_file.empty();
}

}  // namespace sculpt
