#!/usr/bin/env bash
# What a mesh as overlay grid costs beside a plain one: the same voxels on a Cartesian grid, on the same grid as input mesh, on that mesh
# treated as any hex mesh (side sets carried over), and from files split in advance; then a cylinder of about as many hexes.
#
#   input_meshes.sh [-n RUNS] [-j "1 2"] [-c CELLS] [-b BUILD]
#
# CELLS per axis (100). BUILD (default: build beside the sources) needs sculpt, microstructure and hexmesh. Files for two ranks are used where SEACAS decomp
# is on PATH. Columns: medians over RUNS (3) of the seconds by sculpt's table: reading the mesh, checking it, partition, ghosts and
# exterior, all of the run; hexes per second and core, peak memory of all ranks per hex.
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
  local read=() check=() part=() share=() total=() bytes=()
  for ((run = 0; run < runs; ++run)); do
    rm -f mesh.e.*
    timed sculpt "$@" -e mesh -j "$n"
    read+=("$(seconds_of "read input mesh")") check+=("$(seconds_of "check input mesh")")
    part+=("$(seconds_of "partition")") share+=("$(seconds_of "distribute")")
    total+=("$(all_seconds)")
    bytes+=("$(bytes_per_hex)")
  done
  local all
  all=$(median "${total[@]}")
  printf '%-22s %2d %9d %7.2f %7.2f %7.2f %7.2f %8.2f %12.0f %10d\n' "$name" "$n" "$(hexes)" "$(median "${read[@]}")" \
    "$(median "${check[@]}")" "$(median "${part[@]}")" "$(median "${share[@]}")" "$all" \
    "$(awk -v h="$(hexes)" -v t="$all" -v n="$n" 'BEGIN {print h / t / n}')" "$(median "${bytes[@]}")"
}

c=$cells
microstructure grains "$c" "$c" "$c" 200 1 grains.spn
hexmesh box --nx "$c" --ny "$c" --nz "$c" box.g >/dev/null
hexmesh cylinder --n $((c / 2)) --rings $((c / 4)) --layers $((c * 4 / 3)) --radius "$((c / 2))" --height "$c" cylinder.g >/dev/null
spn=(--input_spn grains.spn -x "$c" -y "$c" -z "$c")

printf '%-22s %2s %9s %7s %7s %7s %7s %8s %12s %10s\n' run np hexes read check part share total "hexes/s/core" bytes/hex
for n in $ranks; do
  measure "grid" "$n" "${spn[@]}"
  measure "the grid as a mesh" "$n" "${spn[@]}" --input_mesh box.g
  measure "as any mesh" "$n" "${spn[@]}" --input_mesh box.g --gen_sidesets input_mesh
  if [ "$n" -gt 1 ] && command -v decomp >/dev/null; then
    decomp -p "$n" box.g >/dev/null 2>&1
    measure "split by decomp" "$n" "${spn[@]}" --input_mesh box.g --gen_sidesets input_mesh
    rm -f box.g."$n".*
  fi
  measure "cylinder" "$n" "${spn[@]}" --input_mesh cylinder.g --mesh_void true
done
