#!/usr/bin/env bash
# What volume fractions of geometry cost beside the rest of a run: spheres in growing numbers, fibres, boxes that overlap, an STL surface.
#
#   geometry.sh [-n RUNS] [-j "1 2"] [-c CELLS] [-b BUILD]
#
# CELLS per axis (100); the matrix is meshed. BUILD (default: build beside the sources) needs sculpt and solid. Columns: medians over
# RUNS (3) of the seconds by sculpt's table: reading the geometry, volume fractions, smoothing, all of the run; share of the fractions.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$here/../../build runs=3 ranks="1 2" cells=100
while getopts n:j:c:b: option; do
  case $option in
    n) runs=$OPTARG ;;
    j) ranks=$OPTARG ;;
    c) cells=$OPTARG ;;
    b) build=$OPTARG ;;
    *) exit 2 ;;
  esac
done
build=$(cd "$build" && pwd)
PATH=$build/apps:$build/examples/generators:$PATH

# shellcheck source=runs.bash
source "$here/runs.bash"
cd "$work"

# measure NAME RANKS ARGUMENTS...
measure() {
  local name=$1 n=$2
  shift 2
  local read=() share=() smooth=() total=()
  for ((run = 0; run < runs; ++run)); do
    rm -f mesh.e.*
    timed sculpt "$@" -x "$cells" -y "$cells" -z "$cells" -t 0 -u 0 -v 0 -q 100 -r 100 -s 100 -V true -e mesh -j "$n"
    read+=("$(seconds_of "read geometry")") share+=("$(seconds_of "volume fractions")") smooth+=("$(seconds_of "smooth volume")")
    total+=("$(all_seconds)")
  done
  printf '%-24s %2d %9d %8.2f %9.2f %7.2f %7.2f %6.0f%%\n' "$name" "$n" "$(hexes)" "$(median "${read[@]}")" \
    "$(median "${share[@]}")" "$(median "${smooth[@]}")" "$(median "${total[@]}")" \
    "$(awk -v f="$(median "${share[@]}")" -v t="$(median "${total[@]}")" 'BEGIN {print 100 * f / t}')"
}

# Random numbers in [0,1), the same everywhere.
random='function r() {seed = (seed * 16807) % 2147483647; return seed / 2147483647}'
spheres() {
  awk -v n="$1" -v least="$2" -v most="$3" "$random"'
    BEGIN {
      seed = 5; print "diatom\n package \"spheres\"\n material 1"
      for (i = 0; i < n; ++i)
        printf " insert sphere\n center = %.5f %.5f %.5f\n radius = %.5f\n endinsert\n", 100 * r(), 100 * r(), 100 * r(), least + (most - least) * r()
      print " endpackage\nenddiatom"
    }' >"spheres$1.diatom"
}
spheres 1300 2.5 5
spheres 10000 1.2 2.4
spheres 100000 0.6 1.1
awk "$random"'
  BEGIN {
    seed = 3; print "diatom\n package \"fibres\"\n material 1"
    for (i = 5; i < 100; i += 10)
      for (j = 5; j < 100; j += 10)
        printf " insert cylinder\n ce1 = %.4f %.4f -5\n ce2 = %.4f %.4f 105\n radius = 3.3\n endinsert\n", i + r() - 0.5, j + r() - 0.5, i + r() - 0.5, j + r() - 0.5
    print " endpackage\nenddiatom"
  }' >fibres.diatom
awk "$random"'
  BEGIN {
    seed = 7; print "diatom\n package \"boxes\"\n material 1"
    for (i = 0; i < 400; ++i)
      printf " insert box\n p1 = -4 -3 -5\n p2 = 4 3 5\n rotate = %.3f %.4f %.4f %.4f\n translate = %.4f %.4f %.4f\n endinsert\n", 180 * r(), r() - 0.5, r() - 0.5, r() + 0.1, 100 * r(), 100 * r(), 100 * r()
    print " endpackage\nenddiatom"
  }' >boxes.diatom
solid sphere --levels 9 --radius 45 at_origin.stl >/dev/null
printf "diatom\n package 's'\n material 1\n insert stl\n file = 'at_origin.stl'\n translate = 50 50 50\n endinsert\n endpackage\nenddiatom\n" >stl.diatom

printf '%-24s %2s %9s %8s %9s %7s %7s %7s\n' run np hexes geometry fractions smooth total share
for n in $ranks; do
  measure "1300 spheres" "$n" -d spheres1300.diatom
  measure "10000 spheres" "$n" -d spheres10000.diatom
  measure "100000 spheres" "$n" -d spheres100000.diatom
  measure "100 fibres" "$n" -d fibres.diatom
  measure "400 boxes that overlap" "$n" -d boxes.diatom
  measure "2097152 facets" "$n" -d stl.diatom
done
