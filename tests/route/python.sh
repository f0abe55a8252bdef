#!/usr/bin/env bash
# Faults of a participant in Python end the whole job with one line that says what and where.
# Usage: python.sh ROOT BUILD CASE MPIRUN...
set -euo pipefail
root=$1 build=$2 case=$3
shift 3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export OMPI_MCA_odls_base_sigkill_timeout=0 # s that mpirun waits for the other programs of one that failed
start=$("$root/cases/adapters/build.sh" template_python "$build") # 77: packages are missing
packages=$(dirname "$start")/installed/lib/python3/dist-packages

run() { # STATEMENTS MESSAGE
  printf 'import numpy as np\nimport coracle\nclient = coracle.Client("solid")\n%s\n' "$1" >"$scratch/solid.py"
  if PYTHONPATH=$packages timeout -k 5 30 "${mpirun[@]}" -n 1 "$build/tests/route/fake_fluid" "$case" \
    : -n 1 "$build/tests/route/stub_coupler" "$case" : -n 1 /usr/bin/python3 "$scratch/solid.py" "$case" >"$scratch/log" 2>&1; then
    echo "'$1' ran"; exit 1
  fi
  if [ "$(grep -c ': error:' "$scratch/log")" -ne 1 ] || ! grep -q "^coracle solid\[0\]: error: $2" "$scratch/log"; then
    echo "'$1': expected '$2'"; cat "$scratch/log"; exit 1
  fi
}
mpirun=("$@")
run '1 / 0' 'ZeroDivisionError: division by zero (.*solid.py:4)'
run 'client.set_nodes([1], np.zeros((1, 2)), np.zeros((1, 2)))' \
  'TypeError: gid: expected a C-contiguous array of int64 of shape (1), found list'
run 'client.set_nodes(np.array([1, 2]), np.zeros((2, 3)), np.zeros((2, 2)))' \
  'TypeError: x: expected a C-contiguous array of float64 of shape (2, 2), found float64 of shape (2, 3)'
run 'client.set_surface(np.zeros((2, 2)))' 'TypeError: facets: expected a C-contiguous array of int32'
run 'client.bind_state([1.0])' 'TypeError: bind_state: expected C-contiguous arrays that can be written'
run 'client.substep(0.1, np.zeros((0, 2)))' 'CoracleSubstep was called before CoracleReady'
run 'client.case().positive("solid.radius")' '.*route.yaml.*solid.radius'
run 'raise SystemExit' 'left the job in step 0, before the end'
