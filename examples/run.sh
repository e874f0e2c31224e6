#!/usr/bin/env bash
# Meshes examples: run.sh [NAME...], where NAME is a folder beside this script; without a name the quick one, grains.
# Installs what is missing (Debian), builds sculpt into build/, runs the commands of the example in build/examples/runs/NAME
# and says where the mesh is.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
project=$(dirname "$here")
build=${SCULPT_BUILD:-$project/build}
names=("$@")
[ "${#names[@]}" -gt 0 ] || names=(grains)

for name in "${names[@]}"; do
  if [ ! -f "$here/$name/commands.sh" ]; then
    echo "run.sh: no example '$name'; there are:" "$(cd "$here" && ls -d */commands.sh | sed 's,/commands.sh,,' | tr '\n' ' ')" >&2
    exit 1
  fi
done

"$project/cmake/debian-packages.sh"
generator=()
[ -f "$build/CMakeCache.txt" ] || ! command -v ninja >/dev/null || generator=(-G Ninja)
cmake -S "$project" -B "$build" "${generator[@]}" -DCMAKE_BUILD_TYPE=Release -DSCULPT_TESTS=OFF >/dev/null
cmake --build "$build" --parallel --target sculpt eputool microstructure hexmesh solid

export PATH=$build/apps:$build/examples/generators:$PATH
meshes=()
for name in "${names[@]}"; do
  folder=$build/examples/runs/$name
  rm -rf "$folder"
  mkdir -p "$folder"
  cp -r "$here/$name/." "$folder"
  echo
  echo "=== $name: $folder"
  (cd "$folder" && bash -eux commands.sh)
  for mesh in "$folder"/*.e; do meshes+=("$mesh"); done
done

echo
echo "Done. Meshes (Exodus II; ParaView opens them):"
printf '  %s\n' "${meshes[@]}"
