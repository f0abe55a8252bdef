#!/usr/bin/env bash
# Clients in C, C++ (11 and 20), Fortran and Python, compiled against an installed library alone, run and move as one another.
# Usage: languages.sh ROOT BUILD PREFIX [gnu]     PREFIX: where the library is installed;  BUILD: whose fluid and coupler run;  gnu: one compiler and standard a language
# Compilers and packages that are not there are passed over.
set -euo pipefail
prefix=$3 compilers=${4:-gnu clang} standards=${4:+20}
source "$1/tests/coupled/run.sh"
templates=$root/cases/adapters
PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name coracle-client.pc)")
LD_LIBRARY_PATH=$(dirname "$(find "$prefix" -name libcoracle_client.so)")${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
export PKG_CONFIG_PATH LD_LIBRARY_PATH
flags=$(pkg-config --define-prefix --cflags --libs coracle-client)
clients=()

compile() { # NAME COMPILER ARGUMENTS...: by MPI's wrapper of that compiler
  local name=$1 compiler=$2
  shift 2
  command -v "$compiler" >/dev/null || { echo "no $compiler here"; return 0; }
  # shellcheck disable=SC2086 # the flags are words
  OMPI_CC=$compiler OMPI_CXX=$compiler OMPI_FC=$compiler MPICH_CC=$compiler MPICH_CXX=$compiler MPICH_FC=$compiler \
    "$@" $flags -lm -o "$scratch/$name" >"$scratch/log" 2>&1 || { echo "$name does not compile"; cat "$scratch/log"; exit 1; }
  clients+=("$name")
}
declare -A c=([gnu]=gcc [clang]=clang) cxx=([gnu]=g++ [clang]=clang++)
for compiler in $compilers; do
  compile "c-$compiler" ${c[$compiler]} mpicc -std=gnu11 "$templates/template_c/rigid_disc.c"
  for standard in ${standards:-11 20}; do
    compile "c++$standard-$compiler" ${cxx[$compiler]} mpicxx -std=c++$standard -Wall -Wextra -Werror -Wno-unused-parameter \
      -I"$templates/template_c" "$root/tests/route/rigid_disc.cc"
  done
done
compile fortran gfortran mpif90 -J"$scratch" "$(find "$prefix" -name coracle.f90)" "$templates/template_fortran/rigid_disc.f90"
if mpirun --version 2>/dev/null | grep -qi 'open mpi\|openrte' && /usr/bin/python3 -c 'import numpy, mpi4py' 2>/dev/null; then # Debian's mpi4py is Open MPI's
  printf '#!/bin/sh\nPYTHONPATH=%s exec /usr/bin/python3 %s "$@"\n' "$(dirname "$(find "$prefix" -path '*/coracle/__init__.py' -printf '%h\n')")" \
    "$templates/template_python/rigid_disc.py" >"$scratch/python"
  chmod +x "$scratch/python"
  clients+=(python)
else
  echo 'no mpi4py of this MPI here'
fi

for client in "${clients[@]}"; do
  must "run-$client" 1:1:1 --solid "$scratch/$client" --set time.end=0.02
  "$python" "$templates/compare.py" "$scratch/run-$client" "$scratch/run-${clients[0]}" 1e-6 >"$scratch/log" || { echo "$client:"; cat "$scratch/log"; exit 1; }
done
echo "ran: ${clients[*]}"
