#!/usr/bin/env bash
# Builds Coracle with MPICH beside Open MPI, and runs its tests (Debian 12, as root or with sudo).
# Usage: scripts/mpich.sh [ctest arguments]      default: all tests but those labelled validation and adapters
# Debian's PETSc is built with Open MPI, so the first time one with MPICH is built from Debian's source package (with hypre; some twenty minutes of
# two cores).  All of it is in build-mpich; JOBS (default 2) compilers run at once, through ccache where it is.
set -euo pipefail
unset CDPATH # with it cd prints where it goes
cd "$(dirname "$0")/.."
scripts/setup.sh
top=$PWD/build-mpich petsc=$PWD/build-mpich/petsc jobs=${JOBS:-2}
command -v mpicc.mpich >/dev/null && [ -e /usr/include/hdf5/mpich ] || {
  sudo=()
  [ "$(id -u)" -eq 0 ] || sudo=(sudo)
  "${sudo[@]}" apt-get update -qq
  "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends mpich libmpich-dev libhdf5-mpich-dev >/dev/null
}

# MPICH's tools by their usual names, which scripts and CMake look for
mkdir -p "$top/bin"
for tool in mpicc mpicxx mpif90 mpiexec mpirun; do ln -sf "$(command -v $tool.mpich)" "$top/bin/$tool"; done
ln -sf "$(command -v hydra_pmi_proxy)" "$top/bin/" # mpiexec looks for it beside itself
export PATH=$top/bin:$PATH PKG_CONFIG_PATH=$petsc/lib/pkgconfig LD_LIBRARY_PATH=$petsc/lib OPENBLAS_NUM_THREADS=1
if command -v ccache >/dev/null; then export MPICH_CC="ccache gcc" MPICH_CXX="ccache g++"; fi

if [ ! -e "$petsc/lib/pkgconfig/PETSc.pc" ]; then
  for source in petsc hypre; do
    [ -d "$top/source/$source" ] || scripts/debian_source.sh $source "$top/source/$source"
  done
  (
    cd "$top/source/petsc"
    unset PETSC_DIR PETSC_ARCH
    ./configure --prefix="$petsc" --with-cc=mpicc --with-cxx=mpicxx --with-fc=0 --with-mpiexec=mpiexec --with-debugging=0 --with-x=0 \
      --with-shared-libraries --with-blas-lib=-lblas --with-lapack-lib=-llapack --with-suitesparse=1 \
      --with-suitesparse-include=/usr/include/suitesparse --with-suitesparse-lib="-lspqr -lumfpack -lamd -lcholmod -lklu" \
      --download-hypre="$top/source/hypre" --with-make-np="$jobs" --with-c2html=0 --with-hwloc=0 --with-ssl=0 COPTFLAGS=-O1 CXXOPTFLAGS=-O1
    make all
    make install
  ) >"$top/petsc.log" 2>&1 || { tail -30 "$top/petsc.log"; exit 1; }
fi

launcher=()
! command -v ccache >/dev/null || launcher=(-DCMAKE_C_COMPILER_LAUNCHER=ccache)
cmake -S . -B "$top" -G Ninja -DCMAKE_BUILD_TYPE=Release "${launcher[@]}" ${CI:+-DCORACLE_WERROR=ON} >"$top/cmake.log" || { cat "$top/cmake.log"; exit 1; }
cmake --build "$top" -j "$jobs"
gcc -O2 -shared -fPIC -o "$top/mpich_yield.so" scripts/mpich_yield.c -ldl
[ $# -gt 0 ] || set -- -LE 'validation|adapters' -j 2
LD_PRELOAD=$top/mpich_yield.so ctest --test-dir "$top" --no-tests=error --output-on-failure "$@"
