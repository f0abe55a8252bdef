#!/usr/bin/env bash
# What must hold on any processor: builds with gcc and clang, for this processor and for any x86-64, and runs tests with OpenBLAS's
# kernels for several processors, whose sums round differently.
# Usage: scripts/portability.sh [--rounds N] [--out DIR] [CTEST ARGUMENT]...
#   --rounds  how often each is run (default 2)
#   --out     where the builds and logs go (default build-portability beside build)
#   the rest goes to ctest (default: -R with the tests that round-off could decide: cracks, contact, near ties, adaptation)
# A line for each run and each test that fails; kernels that this processor cannot run are left out and named.
set -euo pipefail
unset CDPATH # with it cd prints where it goes
root=$(cd "$(dirname "$0")/.." && pwd)
rounds=2 out=$root/build-portability
delicate='^(coupled\.(breaking|fracture|adaptive|ranks)$|solid\.(contact|friction|fracture|fracture_ranks|collision|rebalance)(\.|$)|adapt\.(near_ties|keep|parallel))'
while [ $# -gt 0 ]; do
  case "$1" in
    --rounds) rounds=${2:?--rounds needs a number}; shift 2 ;;
    --out) out=${2:?--out needs a folder}; shift 2 ;;
    -h | --help) sed -n '2,8p' "$0" | cut -c3-; exit 0 ;;
    *) break ;;
  esac
done
[ $# -gt 0 ] || set -- -R "$delicate" -LE 'validation|adapters'

has() { grep -qwm1 "$1" /proc/cpuinfo; }
kernels=(Nehalem)
if has avx; then kernels+=(Sandybridge); else echo "portability: no kernels of Sandybridge: this processor has no AVX"; fi
if has avx2; then kernels+=(Haswell); else echo "portability: no kernels of Haswell: this processor has no AVX2"; fi
if has avx512dq; then kernels+=(SkylakeX); else echo "portability: no kernels of SkylakeX: this processor has no AVX-512"; fi

failed=0
for compiler in gcc clang; do
  command -v "$compiler" > /dev/null || { echo "portability: no $compiler here"; continue; }
  for native in ON OFF; do
    build=$out/$compiler-$([ $native = ON ] && echo native || echo x86-64)
    mkdir -p "$build"
    cmake -G Ninja -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_COMPILER="$compiler" -DCORACLE_NATIVE=$native > "$build/cmake.log" 2>&1
    cmake --build "$build" > "$build/build.log" 2>&1 || { echo "portability: does not build: $build/build.log"; exit 1; }
    for ((round = 1; round <= rounds; round++)); do
      for kernel in "${kernels[@]}"; do
        log=$build/$kernel-$round.log
        OPENBLAS_CORETYPE=$kernel ctest --test-dir "$build" --output-on-failure "$@" > "$log" 2>&1 || failed=1
        echo "$(basename "$build") $kernel, round $round: $(grep 'tests passed' "$log" || echo "no tests: $log")"
        grep -E '\*\*\*' "$log" || true
      done
    done
  done
done
exit $failed
