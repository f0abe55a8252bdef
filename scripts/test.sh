#!/usr/bin/env bash
# Installs what is missing, builds, and runs the tests.  Usage: scripts/test.sh [PRESET] [ctest arguments]
#   With CI set in the environment warnings are errors.
#   PRESET: release (default), native, debug, sanitize.  Long validation runs: scripts/test.sh -L validation
set -euo pipefail
unset CDPATH # with it cd prints where it goes
cd "$(dirname "$0")/.."
preset=release
case "${1:-}" in release | native | debug | sanitize) preset=$1; shift ;; esac

scripts/setup.sh
cmake --preset "$preset" ${CI:+-DCORACLE_WERROR=ON} >build-log.txt 2>&1 || { cat build-log.txt; exit 1; }
rm -f build-log.txt
cmake --build --preset "$preset"
# Open MPI does not free what it takes at start; with detect_leaks=1 its reports are all there is to see
export ASAN_OPTIONS=${ASAN_OPTIONS:-detect_leaks=0}
export OPENBLAS_NUM_THREADS=1
# What Open MPI's start spends on networks that one computer does not use is half of it, 0.2 s a run
export OMPI_MCA_pml=ob1
# and what a run's ranks are told at its start needs no memory that they share, 0.1 s a run
export PMIX_MCA_gds=hash
[ $# -gt 0 ] || set -- -LE 'validation|adapters' -j 2
ctest --preset "$preset" --no-tests=error "$@"
