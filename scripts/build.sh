#!/usr/bin/env bash
# Installs what is missing and builds the three programs into build/.  Usage: scripts/build.sh
set -euo pipefail
unset CDPATH # with it cd prints where it goes
cd "$(dirname "$0")/.."
scripts/setup.sh
[ -x build/fluid/coracle-fluid ] || echo "builds the programs into $PWD/build, which takes some minutes the first time"
cmake --preset release >/dev/null
cmake --build --preset release --target coracle-fluid coracle-coupler coracle-solid -- --quiet
