// What the options of smoothing mean for the stages, and the banner that tells them.
#include <algorithm>

#include "pipeline/console.hpp"

namespace sculpt {
namespace {

constexpr int kVolumePasses =
    5;  // of the Laplacian on volume nodes; more change nothing that the optimisation keeps

// Where surfaces are let go: more pairs with a little less growth between them. Voxel noise goes, and some
// volume.
constexpr int kLeastFreePairs = 20;
constexpr double kFreeGrowth = -0.45;

constexpr double kTrueSurfaces = 2.5;  // the interface is known better than from voxels, so it is held better
constexpr double kHeldSurfaces = 10;   // interface nodes that are to end on the geometry

// Whether surfaces are smoothed without regard to where the interface was reconstructed.
bool lets_surfaces_go(const Deck& deck) {
  return deck.smooth == kSmoothNoSurfaceProjections || deck.smooth == kSmoothGeoSmooth;
}

SurfaceProjection surface_projection(const Deck& deck, bool pure_cells) {
  if (goes_to_geometry(deck)) return SurfaceProjection::kInterface;
  switch (deck.surface_projection) {
    case kProjectionNone:
      return SurfaceProjection::kOff;
    case kProjectionQuadric:
      return SurfaceProjection::kQuadric;
    case kProjectionInterface:
      return SurfaceProjection::kInterface;
    default:
      return pure_cells || lets_surfaces_go(deck) ? SurfaceProjection::kOff : SurfaceProjection::kInterface;
  }
}

}  // namespace

bool goes_to_geometry(const Deck& deck) {
  return deck.smooth == kSmoothToGeometry || deck.capture != kCaptureOff;
}

InterfaceSmoothing interface_smoothing(const Deck& deck, bool pure_cells, const ExactSurface& exact) {
  InterfaceSmoothing s;
  s.curve = static_cast<CurveRule>(deck.csmooth);
  s.pairs = deck.laplacian_iters;
  s.projection = surface_projection(deck, pure_cells);
  if (goes_to_geometry(deck)) s.exact = exact;
  if (lets_surfaces_go(deck)) {  // smoother, at the price of some volume
    s.grow = kFreeGrowth;
    if (s.pairs > 0) s.pairs = std::max(2 * s.pairs, kLeastFreePairs);
  }
  return s;
}

SmoothOptions smooth_options(const Deck& deck, bool pure_cells, const Vec3& cell_size) {
  SmoothOptions s;
  s.laplacian_passes = std::min(deck.laplacian_iters, kVolumePasses);
  s.improve_sweeps = deck.max_opt_iters;
  s.fidelity = pure_cells || lets_surfaces_go(deck) ? 1 : kTrueSurfaces;
  s.improve_below = deck.opt_threshold;
  s.target = deck.pcol_threshold;
  s.target_rounds = deck.max_pcol_iters;
  s.release_curves_below = deck.curve_opt_thresh;
  s.guarantee_rounds = deck.max_gq_iters;
  s.guarantee = deck.gq_threshold;
  if (goes_to_geometry(deck)) {
    s.hold_on_geometry = true;
    s.fidelity = kHeldSurfaces;
  }
  s.captured = deck.capture == kCaptureCurves;
  if (deck.smooth == kSmoothGeoSmooth) {
    s.deviation_by_level = !(deck.geo_smooth_max_deviation > 0);
    s.max_deviation = s.deviation_by_level ? 0.5 * std::min({cell_size.x, cell_size.y, cell_size.z})
                                           : deck.geo_smooth_max_deviation;
  }
  if (deck.opt_method == kOptJacobi) {
    s.method = OptimisationMethod::kPublished;
    s.laplacian_passes = deck.laplacian_iters;
    s.damping = deck.opt_damping;
    s.size_aware = deck.opt_metric == kOptShapeAndSize;
  }
  return s;
}

void print_smoothing_banner(const Log& log, const Deck& deck) {
  constexpr const char* kCurve[] = {
      "OFF", "CIRCLE", "HERMITE", "AVERAGE_TANGENT", "NEIGHBOR_SURFACE_NORMAL", "VFRAC", "LINEAR"};
  constexpr const char* kSurface[] = {"SMOOTH_OFF",
                                      "SMOOTH_SURF_HYBRID",
                                      "SMOOTH_SURF_FIXED_BBOX",
                                      "SMOOTH_SURF_NO_PROJECTIONS",
                                      "SMOOTH_SURF_TO_GEOMETRY",
                                      "SMOOTH_SURF_GEO_SMOOTH"};
  log.line("Begin smoothing hexes using:");
  log.line("  Curve Smoothing              = SMOOTH_CURV_{}", kCurve[deck.csmooth]);
  log.line("  Surface Smoothing            = {}", kSurface[deck.smooth]);
  log.line("  Volume Smoothing             = {}",
           deck.opt_method == kOptJacobi ? "SMOOTH_VOL_JACOBI" : "SMOOTH_VOL_HYBRID");
  log.line("  Laplacian Iterations         = {}", deck.laplacian_iters);
  log.line("  Maximum Optimization Iters   = {}", deck.max_opt_iters);
  log.line("  Optimization Threshold       = {:f}", deck.opt_threshold);
  log.line("  Curve Opt. Threshold         = {:f}", deck.curve_opt_thresh);
  log.line("  Max Parallel Coloring Iters  = {}", deck.max_pcol_iters);
  log.line("  Parallel Coloring Threshold  = {:f}", deck.pcol_threshold);
  if (deck.max_gq_iters > 0) {
    log.line("  Max Guaranteed Quality Iters = {}", deck.max_gq_iters);
    log.line("  Guaranteed Quality Threshold = {:f}", deck.gq_threshold);
  }
}

}  // namespace sculpt
