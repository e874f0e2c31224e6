#!/usr/bin/env bash
# The study of smoothing of the report (section 2.12.7) on 52 models of our own: how many of them end with their smallest
# scaled Jacobian in each of four ranges, and the average of it, for the published method with damping and colouring on
# and off (opt_method = jacobi), and for the method of this program.
#
#   smoothing_study.sh [-b BUILD] [-d] [-n]
#
# BUILD (default: build beside the sources) needs the targets sculpt and microstructure. -d: a line per model as well.
# -n: the floor of every method is 0.2, as in the report (default: 0.2 for the published method, 0.3 for ours).
# Models: polycrystals, interwoven phases, spray deposits and polycrystals as volume fractions, of 8 to 26 cells a side.
# Two runs at a time; a minute or two.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$here/../../build details=no own_floor=0.3
while getopts b:dn option; do
  case $option in
    b) build=$OPTARG ;;
    d) details=yes ;;
    n) own_floor=0.2 ;;
    *) exit 2 ;;
  esac
done
build=$(cd "$build" && pwd)
sculpt=$build/apps/sculpt
generate=$build/examples/generators/microstructure

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# models: one line each, KIND NX NY NZ [N] SEED
models() {
  for seed in 1 2 3 4; do
    echo "grains 8 8 8 $((4 * seed)) $seed"
    echo "grains 12 12 12 $((8 * seed)) $seed"
    echo "grains 16 16 16 $((15 * seed)) $seed"
    echo "grains 20 14 8 $((10 * seed)) $seed"
    echo "phases 12 12 12 2 $seed"
    echo "phases 18 18 18 2 $seed"
    echo "phases 24 16 12 3 $seed"
    echo "spray 14 14 14 $seed"
    echo "spray 20 20 20 $seed"
    echo "spray 26 20 14 $seed"
    echo "fractions 8 8 8 $((4 * seed)) $seed"
    echo "fractions 12 12 12 $((8 * seed)) $seed"
    echo "fractions 16 16 16 $((10 * seed)) $seed"
  done
}

# run_one MODEL NAME OPTION...: writes the smallest quality
run_one() {
  local model=$1 name=$2
  shift 2
  local run=$work/$model.$name
  { echo "BEGIN SCULPT"; cat "$work/$model.deck"; printf '%s\n' "$@" "exodus_file = $run"; echo "END SCULPT"; } >"$run.i"
  if ! "$sculpt" -i "$run.i" >"$run.log" 2>&1; then
    echo "$model $name failed: $(grep -m1 -i error "$run.log" || tail -1 "$run.log")" >&2
    exit 255
  fi
  awk '/Min Quality/ {print $3}' "$run.log" >"$run.quality"
  rm -f "$run".e.*
}
export -f run_one
export work sculpt

count=0
while read -r model; do
  echo "$model" >"$work/$count.model"
  # shellcheck disable=SC2086
  "$generate" $model "$work/$count.in"
  read -r kind nx ny nz _ <<<"$model"
  if [[ $kind == fractions ]]; then
    echo "input_micro = $work/$count.in"
  else
    printf 'input_spn = %s\nnelx = %s\nnely = %s\nnelz = %s\n' "$work/$count.in" "$nx" "$ny" "$nz"
  fi >"$work/$count.deck"
  count=$((count + 1))
done < <(models)

names=(undamped damped undamped_coloured damped_coloured damped_coloured_free-curves ours)
options() {
  local published="opt_method = jacobi|pcol_threshold = 0.2|laplacian_iters = 2|smooth = fixed_bbox"
  case $1 in
    undamped) echo "$published|opt_damping = false|max_pcol_iters = 0" ;;
    damped) echo "$published|max_pcol_iters = 0" ;;
    undamped_coloured) echo "$published|opt_damping = false" ;;
    damped_coloured) echo "$published" ;;
    damped_coloured_free-curves) echo "$published|curve_opt_thresh = 0.2" ;;
    ours) echo "smooth = fixed_bbox|laplacian_iters = 2|pcol_threshold = $own_floor" ;;
  esac
}
for name in "${names[@]}"; do
  for ((m = 0; m < count; ++m)); do echo "$m|$name|$(options "$name")"; done
done | xargs -d '\n' -n 1 -P 2 bash -c 'IFS="|" read -r -a words <<<"$0"; run_one "${words[@]}"'

printf '%-32s %6s %8s %8s %6s %9s %9s\n' "$count models" "< 0" "0-0.1" "0.1-0.2" ">= 0.2" "average" "least"
for name in "${names[@]}"; do
  for ((m = 0; m < count; ++m)); do cat "$work/$m.$name.quality"; done | awk -v name="${name//_/, }" '
    BEGIN {least = 1}
    {sum += $1; if ($1 < least) least = $1
     if ($1 <= 0) ++a; else if ($1 < 0.1) ++b; else if ($1 < 0.2) ++c; else ++d}
    END {printf "%-32s %6d %8d %8d %6d %9.3f %9.3f\n", name, a, b, c, d, sum / NR, least}'
done
[[ $details == no ]] && exit 0
for ((m = 0; m < count; ++m)); do
  printf '%-28s' "$(cat "$work/$m.model")"
  for name in "${names[@]}"; do printf ' %9.4f' "$(cat "$work/$m.$name.quality")"; done
  echo
done
