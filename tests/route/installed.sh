#!/usr/bin/env bash
# An outside solid must build against the installed client library alone, by CMake and by pkg-config, and join a job;
# the library exports Coracle* and nothing else; its headers are C11, and C++11 to C++20 with any compiler there is; clients in all
# languages run (languages.sh).
# Usage: installed.sh BUILD_DIR CASE MPIRUN...
set -euo pipefail
build=$1 case=$2 root=$(cd "$(dirname "$0")/../.." && pwd)
template=$root/cases/adapters/template_c
shift 2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cmake --install "$build" --component client --prefix "$scratch/there" >"$scratch/log"

libraries=$(dirname "$(find "$scratch/there" -name libcoracle_client.a)")
exported() { # FILE NM_FLAGS...
  nm "${@:2}" --defined-only -P "$1" | awk '$2 ~ /[A-Z]/ {print $1}'
}
for exports in "$(exported "$libraries/libcoracle_client.a" -g)" "$(exported "$libraries/libcoracle_client.so" -D)"; do
  grep -q '^CoracleOpen$' <<<"$exports" || { echo 'CoracleOpen is not exported'; exit 1; }
  if grep -v '^Coracle' <<<"$exports"; then echo 'are exported, too'; exit 1; fi
done

printf '#include <case_file.h>\n#include <coracle.h>\nint main(void) { return CORACLE_DIM - 2; }\n' >"$scratch/host.c"
cp "$scratch/host.c" "$scratch/host.cc"
mpi_flags=$(mpicc --showme:compile 2>/dev/null || mpicc -show | grep -oE -- '-I[^ ]+') # of Open MPI, or another MPI's
strict() { # COMPILER STANDARD FILE
  command -v "$1" >/dev/null || return 0
  # shellcheck disable=SC2046 # the flags are words
  "$1" "-std=$2" -Wall -Wextra -pedantic -Werror -fsyntax-only $(sed 's/-I/-isystem /g' <<<"$mpi_flags") \
    -I"$scratch/there/include" "$scratch/$3" || { echo "the headers are not $2 with $1"; exit 1; }
}
for compiler in gcc clang; do strict $compiler c11 host.c; done
for compiler in g++ clang++; do
  for standard in c++11 c++14 c++17 c++20; do strict $compiler $standard host.cc; done
done

mkdir "$scratch/solid"
cp "$template/rigid_disc.c" "$scratch/solid"
cat >"$scratch/solid/CMakeLists.txt" <<'LISTS'
cmake_minimum_required(VERSION 3.20)
project(outside LANGUAGES C)
find_package(coracle 0.1 REQUIRED)
foreach(kind client client_shared)
  add_executable(by_${kind} rigid_disc.c)
  target_link_libraries(by_${kind} PRIVATE coracle::${kind})
endforeach()
LISTS
build_outside() {
  cmake -S "$scratch/solid" -B "$scratch/build" -DCMAKE_PREFIX_PATH="$scratch/there" && cmake --build "$scratch/build"
}
build_outside >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }

PKG_CONFIG_PATH=$(dirname "$(find "$scratch/there" -name coracle-client.pc)")
export PKG_CONFIG_PATH
# shellcheck disable=SC2046 # the flags are words
mpicc "$scratch/solid/rigid_disc.c" -o "$scratch/by_pkg_config" $(pkg-config --cflags --libs coracle-client)

export LD_LIBRARY_PATH=$libraries${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
for program in "$scratch/build/by_client" "$scratch/build/by_client_shared" "$scratch/by_pkg_config"; do
  if ldd "$program" | grep -i petsc; then echo "$program needs PETSc"; exit 1; fi
  timeout -k 5 30 "$@" -n 1 "$program" "$case" >"$scratch/log" 2>&1 && { echo 'joined a job of its own'; exit 1; }
  grep -q 'error: there is no fluid among the 1 ranks' "$scratch/log" || { cat "$scratch/log"; exit 1; }
done

"$root/tests/route/languages.sh" "$root" "$build" "$scratch/there"
