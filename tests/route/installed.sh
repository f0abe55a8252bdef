#!/usr/bin/env bash
# An outside solid must build against the installed client library alone, by CMake and by pkg-config, and join a job.
# Usage: installed.sh BUILD_DIR CASE MPIRUN...
set -euo pipefail
build=$1 case=$2 here=$(cd "$(dirname "$0")" && pwd)
shift 2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cmake --install "$build" --component client --prefix "$scratch/there" >"$scratch/log"

mkdir "$scratch/solid"
cp "$here/rigid_disc.c" "$scratch/solid"
cat >"$scratch/solid/CMakeLists.txt" <<'LISTS'
cmake_minimum_required(VERSION 3.20)
project(outside LANGUAGES C)
find_package(coracle 0.1 REQUIRED)
add_executable(by_cmake rigid_disc.c)
target_link_libraries(by_cmake PRIVATE coracle::client)
LISTS
build_outside() {
  cmake -S "$scratch/solid" -B "$scratch/build" -DCMAKE_PREFIX_PATH="$scratch/there" && cmake --build "$scratch/build"
}
build_outside >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }

PKG_CONFIG_PATH=$(dirname "$(find "$scratch/there" -name coracle-client.pc)")
export PKG_CONFIG_PATH
# shellcheck disable=SC2046 # the flags are words
mpicc "$scratch/solid/rigid_disc.c" -o "$scratch/by_pkg_config" $(pkg-config --cflags --libs coracle-client)

for program in "$scratch/build/by_cmake" "$scratch/by_pkg_config"; do
  if ldd "$program" | grep -i petsc; then echo "$program needs PETSc"; exit 1; fi
  timeout -k 5 30 "$@" -n 1 "$program" "$case" >"$scratch/log" 2>&1 && { echo 'joined a job of its own'; exit 1; }
  grep -q 'error: there is no fluid among the 1 ranks' "$scratch/log" || { cat "$scratch/log"; exit 1; }
done
