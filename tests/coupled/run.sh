# Sourced: run LABEL RANKS [launch.sh arguments] runs disc.yaml in $scratch/LABEL and leaves its output in $scratch/LABEL.log.
# The caller's first arguments: ROOT BUILD.
root=$1 build=$2
shift 2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
python=$(command -v /usr/bin/python3 || command -v python3)
# mpirun ends the other programs of a run that fails at once, not after a second; with that second: tests/route/bad_start.sh
export OMPI_MCA_odls_base_sigkill_timeout=0
export PYTHONPATH=$here${PYTHONPATH:+:$PYTHONPATH} PYTHONDONTWRITEBYTECODE=1 # results.py

# A beam held at its left end, and its material, with which it cracks there under its weight.
bar='{shape: rectangle, centre: [1.0, 1.1], width: 0.3, height: 0.1, size: 0.025, material: disc, joints: all, fixed: [left]}'
brittle='{density: 2000.0, youngs_modulus: 1.0e6, poisson_ratio: 0.3, damping: 0.2, tensile_strength: 6.0e3, shear_strength: 1.2e4, fracture_energy: 1.0}'

run() {
  local label=$1 ranks=$2
  shift 2
  [[ $label != *:* ]] || { echo "label '$label': MPICH reads what is before a colon of a file's name as a file system"; exit 1; }
  timeout -k 5 $((${limit:-120} * ${TEST_SLOWER:-1})) "$root/scripts/launch.sh" --bin "$build" --ranks "$ranks" "${case:-$here/disc.yaml}" \
    --set "output.folder=$scratch/$label" "$@" >"$scratch/$label.log" 2>&1
}
must() { run "$@" || { echo "$1 failed:"; cat "$scratch/$1.log"; exit 1; }; }
