#!/usr/bin/env bash
# Builds sculpt and runs all its tests but the slow ones: the optimised program, then the unit and parallel tests once
# more under the address and undefined-behaviour sanitizers. On Debian missing packages are installed first.
# Build folders: build-tests, build-sanitize.
set -euo pipefail
cd "$(dirname "$0")/.."

cmake/debian-packages.sh

jobs=$(nproc)

if clang-format --version 2>/dev/null | grep -q 'version 14\.'; then  # others lay out differently
  echo "== Layout of the sources"
  find apps include src tests examples \( -name '*.cpp' -o -name '*.hpp' \) -print0 |
    xargs -0 clang-format --dry-run -Werror
fi

# build_and_test FOLDER "CMAKE OPTIONS" "CTEST OPTIONS"
build_and_test() {
  echo "== $1"
  # shellcheck disable=SC2086  # the options are words
  cmake -S . -B "$1" -G Ninja -DSCULPT_TESTS=ON $2
  cmake --build "$1" --parallel "$jobs"
  # shellcheck disable=SC2086
  ctest --test-dir "$1" --parallel "$jobs" --output-on-failure --no-tests=error $3
}

build_and_test build-tests "-DCMAKE_BUILD_TYPE=Release" "--label-exclude slow"
build_and_test build-sanitize "-DCMAKE_BUILD_TYPE=RelWithDebInfo -DSCULPT_SANITIZE=ON" "--label-regex unit|parallel"
