#!/usr/bin/env bash
# Whole runs of sculpt, from reading the input to written files: time, hexes per second and core, peak memory per hex.
#
#   whole_runs.sh [-n RUNS] [-j "1 2"] [-b BUILD] [FILE.spn NX NY NZ]...
#
# Without files: generated inputs, 143 grains on 200 x 100 x 100 cells, a spray deposit (3 materials) and 1000 grains on
# 100 x 100 x 100 cells; the last two give the cost of many materials. BUILD (default: build beside the sources) needs the
# targets sculpt and microstructure. The columns are medians over RUNS (default 3):
#   wall    seconds of the whole command, start of the ranks included
#   stages  seconds from reading to written files, as the table of sculpt says
#   hexes/s/core of `wall`; bytes/hex: peak resident memory of all ranks, MPI and libraries included, per hex of the mesh
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$here/../../build runs=3 ranks="1 2"
while getopts n:j:b: option; do
  case $option in
    n) runs=$OPTARG ;;
    j) ranks=$OPTARG ;;
    b) build=$OPTARG ;;
    *) exit 2 ;;
  esac
done
shift $((OPTIND - 1))
build=$(cd "$build" && pwd)
sculpt=$build/apps/sculpt
generate=$build/examples/generators/microstructure

# shellcheck source=runs.bash
source "$here/runs.bash"

# measure NAME FILE NX NY NZ
measure() {
  local name=$1 file=$2 nx=$3 ny=$4 nz=$5
  for n in $ranks; do
    local walls=() stages=() bytes=()
    for ((run = 0; run < runs; ++run)); do
      rm -f "$work"/mesh.e.*
      timed "$sculpt" --input_spn "$file" -x "$nx" -y "$ny" -z "$nz" -e "$work/mesh" -j "$n"
      walls+=("$wall")
      stages+=("$(all_seconds)")
      bytes+=("$(bytes_per_hex)")
    done
    wall=$(median "${walls[@]}")
    printf '%-24s %2d %9d %9.2f %9.2f %12.0f %10d  %s\n' "$name" "$n" "$(hexes)" "$wall" "$(median "${stages[@]}")" \
      "$(awk -v h="$(hexes)" -v t="$wall" -v n="$n" 'BEGIN {print h / t / n}')" "$(median "${bytes[@]}")" \
      "$(qualities)"
  done
}

printf '%-24s %2s %9s %9s %9s %12s %10s  %s\n' case -j hexes wall stages hexes/s/core bytes/hex 'min / avg SJ'
if [ $# -eq 0 ]; then
  "$generate" grains 200 100 100 143 1 "$work/grains-143.spn"
  "$generate" spray 100 100 100 1 "$work/spray.spn"
  "$generate" grains 100 100 100 1000 1 "$work/grains-1000.spn"
  measure grains-143-200x100x100 "$work/grains-143.spn" 200 100 100
  measure spray-100 "$work/spray.spn" 100 100 100
  measure grains-1000-100 "$work/grains-1000.spn" 100 100 100
fi
while [ $# -ge 4 ]; do
  measure "$(basename "$1" .spn)" "$1" "$2" "$3" "$4"
  shift 4
done
if [ $# -gt 0 ]; then
  echo "whole_runs.sh: expected FILE.spn NX NY NZ, found: $*" >&2
  exit 2
fi
