# Sourced by the scripts that time runs of sculpt. Makes the folder $work, which is removed at the end; the output of the
# last run is in $work/log.
# shellcheck shell=bash
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# One line of numbers: the middle one.
median() { tr ' ' '\n' <<<"$*" | sort -g | awk '{v[NR] = $1} END {print v[int((NR + 1) / 2)]}'; }

# timed COMMAND...: seconds of the whole command into $wall. Where it fails, its last lines and the end of the script.
timed() {
  local begin end
  begin=$(date +%s%N)
  if ! "$@" >"$work/log" 2>&1; then
    tail -3 "$work/log" >&2
    exit 1
  fi
  end=$(date +%s%N)
  # shellcheck disable=SC2034  # for the scripts
  wall=$(awk -v t=$((end - begin)) 'BEGIN {printf "%.3f", t / 1e9}')
}

# Of the last run, as sculpt tells it. seconds_of STAGE,...: in all of these stages, 0 where there are none.
seconds_of() {
  awk -v names="$1" 'BEGIN {n = split(names, a, ",")}
    {for (i = 1; i <= n; ++i) if (index($0, "  " a[i] " ") == 1) s += $(split(a[i], w, " ") + 1)} END {printf "%.3f", s}' "$work/log"
}
all_seconds() { awk '$1 == "Total" && $3 ~ /^[0-9]+$/ {print $2}' "$work/log"; }
hexes() { awk '/Num Elements/ {print $3}' "$work/log"; }
bytes_per_hex() { sed -n 's,.* \([0-9]*\) bytes/hex.*,\1,p' "$work/log"; }
# Smallest and average scaled Jacobian.
qualities() { awk '/Min Quality/ {a = $3} /Avg Quality/ {b = $3} END {printf "%.3f / %.3f", a, b}' "$work/log"; }
