#!/usr/bin/env bash
# What refinement costs: runs of sculpt on a packing of spheres, by levels of refinement.
#
#   refinement_levels.sh [-n RUNS] [-j RANKS] [-b BUILD] [-c FINEST] [-s SPHERES]
#
# Each level halves the number of cells of the grid, so that the finest cells, FINEST (default 96) per axis, are the
# same; then vfrac_average refines every interface. Below, grids of FINEST / 8 cells with more and more levels.
# The void between the spheres is meshed. BUILD (default: build beside the sources) needs the targets sculpt and
# microstructure. Medians over RUNS (default 3) on RANKS (default 1) ranks; the columns are
#   wall      seconds of the whole command, start of the ranks included
#   adapt     seconds of choosing, refining and measuring the refined cells (read input without refinement)
#   smooth    seconds of smoothing the volume
#   us/hex    microseconds of `wall` per hex and rank; bytes/hex: peak resident memory of all ranks per hex
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$here/../../build runs=3 ranks=1 finest=96 spheres=20
while getopts n:j:b:c:s: option; do
  case $option in
    n) runs=$OPTARG ;;
    j) ranks=$OPTARG ;;
    b) build=$OPTARG ;;
    c) finest=$OPTARG ;;
    s) spheres=$OPTARG ;;
    *) exit 2 ;;
  esac
done
build=$(cd "$build" && pwd)
sculpt=$build/apps/sculpt

# shellcheck source=runs.bash
source "$here/runs.bash"
"$build/examples/generators/microstructure" spheres 1000 "$spheres" 1 "$work/spheres.diatom"

# measure CELLS LEVELS
measure() {
  local cells=$1 levels=$2 walls=() adapts=() smooths=() bytes=() more=""
  [ "$levels" -eq 0 ] || more="adapt_type = vfrac_average
adapt_levels = $levels"
  cat >"$work/deck.i" <<DECK
BEGIN SCULPT
diatom_file = $work/spheres.diatom
exodus_file = $work/mesh
nelx = $cells
nely = $cells
nelz = $cells
xmin = 0
ymin = 0
zmin = 0
xmax = 1000
ymax = 1000
zmax = 1000
mesh_void = true
$more
END SCULPT
DECK
  for ((run = 0; run < runs; ++run)); do
    rm -f "$work"/mesh.e.*
    timed "$sculpt" -i "$work/deck.i" -j "$ranks"
    walls+=("$wall")
    adapts+=("$(seconds_of 'read input,distribute,choose cells to refine,refine,measure refined cells')")
    smooths+=("$(seconds_of 'smooth volume')")
    bytes+=("$(bytes_per_hex)")
  done
  wall=$(median "${walls[@]}")
  printf '%5d %6d %9d %8.2f %8.2f %8.2f %8.2f %9d  %s\n' "$cells" "$levels" "$(hexes)" "$wall" "$(median "${adapts[@]}")" \
    "$(median "${smooths[@]}")" "$(awk -v h="$(hexes)" -v t="$wall" -v n="$ranks" 'BEGIN {print 1e6 * t * n / h}')" \
    "$(median "${bytes[@]}")" "$(qualities)"
}

printf '%5s %6s %9s %8s %8s %8s %8s %9s  %s\n' cells levels hexes wall adapt smooth us/hex bytes/hex 'min / avg SJ'
for levels in 0 1 2 3; do measure $((finest >> levels)) "$levels"; done
for levels in 0 1 2 3; do measure $((finest / 8)) "$levels"; done
