#!/usr/bin/env bash
# Installs the Debian 12 packages that building, testing and running sculpt needs, when some of them are missing.
# debian-packages.sh [PACKAGE...]: further packages to install with them. Does nothing on other systems.
set -euo pipefail

packages=(build-essential cmake ninja-build libexodusii-dev libtrilinos-zoltan-dev libtrilinos-pamgen-dev
  libeigen3-dev libopenmpi-dev openmpi-bin libfmt-dev libgtest-dev "$@")

command -v dpkg-query >/dev/null && command -v apt-get >/dev/null || exit 0

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
[ "${#missing[@]}" -gt 0 ] || exit 0

root=(env DEBIAN_FRONTEND=noninteractive)
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "debian-packages.sh: missing ${missing[*]}; install them as root or install sudo" >&2
    exit 1
  fi
  root=(sudo "${root[@]}")
fi
"${root[@]}" apt-get update -qq
"${root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" </dev/null
