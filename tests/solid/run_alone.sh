# Sourced: alone LABEL CASE [arguments of launch.sh] runs a case of the solid alone into $scratch/LABEL.  The caller's first arguments: ROOT BUILD.
root=$1 build=$2 scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OPENBLAS_NUM_THREADS=1
python=$(command -v /usr/bin/python3 || command -v python3)
export PYTHONPATH=$root/tests/coupled${PYTHONPATH:+:$PYTHONPATH} PYTHONDONTWRITEBYTECODE=1 # results.py
run_alone() {
  timeout -k 5 $((120 * ${TEST_SLOWER:-1})) "$root/scripts/launch.sh" --bin "$build" --alone "$2" --set "output.folder=$scratch/$1" "${@:3}" >"$scratch/$1.log" 2>&1
}
alone() { run_alone "$@" || { echo "$1 failed:"; cat "$scratch/$1.log"; exit 1; }; }
