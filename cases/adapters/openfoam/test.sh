#!/usr/bin/env bash
# OpenFOAM's fluid keeps the contract on one rank and two, a block stands on a floor in it and slides along, and the disc falls in it as
# the body-fitted reference.  Usage: test.sh ROOT BUILD
set -euo pipefail
root=$1 build=$2 here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
program=$("$root/cases/adapters/build.sh" openfoam "$build")
"$here/prepare.sh" "$scratch/kit" 2
kit=("$root/scripts/conform.py" --bin "$build" "$here/case.yaml" --set "fluid.openfoam=$scratch/kit/foam"
  --set 'coupler.conformance.box=[0.9, 2.5, 1.6, 3.5]' --fluid)
"${kit[@]}" "$program" --ranks 1,2
plant() { # NAME SED_EXPRESSION MESSAGE: faults of the pressure that the kit must find
  cp -r "$here" "$scratch/$1"
  sed -i "$2" "$scratch/$1/ico_foam.cc"
  ! cmp -s "$here/ico_foam.cc" "$scratch/$1/ico_foam.cc" || { echo "$1: nothing has been planted"; exit 1; }
  { cmake -S "$scratch/$1" -B "$scratch/$1/build" -DCMAKE_BUILD_TYPE=Debug -DCMAKE_PREFIX_PATH="$build/adapters/openfoam/installed" &&
    cmake --build "$scratch/$1/build"; } >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
  if "${kit[@]}" "$scratch/$1/build/ico_foam" --ranks 1 >"$scratch/log" 2>&1; then echo "$1: conforms"; cat "$scratch/log"; exit 1; fi
  grep -q "FAILED.*$3" "$scratch/log" || { echo "$1: expected '$3'"; cat "$scratch/log"; exit 1; }
}
plant bulk 's/+= cells_.us - cells_.ms.*/+= 0.0 * cells_.us;/' 'the pressure does not see the solid.s motion'
plant inertia 's,/ dt + cells_.inertia_tensor,/ dt + 0.0 * cells_.inertia_tensor,' 'as if it were fluid'
python=$(command -v /usr/bin/python3 || command -v python3)
for run in stands slides; do # the block of tests/coupled/floor.sh
  "$here/prepare.sh" "$scratch/$run" 1 "$here/floor.blockMeshDict"
  sets=(--set "fluid={density: 1000.0, viscosity: 1.0e-3, openfoam: $scratch/$run/foam}" --set 'solid.bodies[0].centre=[0.3, 0.045]')
  [ $run = stands ] || sets+=(--set 'solid.bodies[0].velocity=[0.5, 0.0]')
  "$root/scripts/launch.sh" --bin "$build" --fluid "$program" "$root/tests/coupled/floor.yaml" "${sets[@]}" --set "output.folder=$scratch/$run" \
    >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
done
"$python" - "$scratch" <<'E2'
import csv, sys
def column(run, name):
    return [float(row[name]) for row in csv.DictReader(open("%s/%s/solid.csv" % (sys.argv[1], run)))]
weight = 9.81 * (2600.0 - 1000.0) * 0.08 * 0.08  # less that of the water
for run in "stands", "slides":
    t, impulse = column(run, "t [s]"), column(run, "walls_y [N s/m]")
    first = next(k for k in range(len(t)) if t[k] > 0.8)
    force = sum(impulse[first:]) / (t[-1] - t[first - 1])
    print("%s: %.2f N/m on the floor, of %.2f; it has slid by %.4f m" % (run, force, weight, column(run, "x0 [m]")[-1] - 0.3))
    assert abs(force / weight - 1.0) < 0.02
# what friction leaves of 0.5 m/s that water of 0.6 times the block's mass shares
assert 0.02 < column("slides", "x0 [m]")[-1] - 0.3 < 0.04
E2
"$here/prepare.sh" "$scratch/fall"
"$root/scripts/launch.sh" --bin "$build" --fluid "$program" "$here/case.yaml" --set "output.folder=$scratch/fall" >"$scratch/log" 2>&1 ||
  { cat "$scratch/log"; exit 1; }
"$python" - "$scratch/fall/coupler.csv" "$here/../../falling_cylinder/reference/nu0.017173.csv" <<'E2'
import csv
import sys


def interpolate(points, t):
    (a, u), (b, v) = next(pair for pair in zip(points, points[1:]) if pair[1][0] >= t)
    return u + (v - u) * (t - a) / (b - a)


TERMINAL = 1.2326  # m/s, closed sides, Re 20: cases/falling_cylinder/README.md
with open(sys.argv[1], encoding="utf-8") as file:
    speed = [(float(row["t [s]"]), -float(row["u_y [m/s]"])) for row in csv.DictReader(file)]
with open(sys.argv[2], encoding="utf-8") as file:
    reference = [(float(row["t[s]"]), float(row["U_fall"])) for row in csv.DictReader(line for line in file if line[0] != "#")]
for t in (0.2, 0.5, 1.0, 2.0, speed[-1][0]):
    u, expected = interpolate(speed, t), interpolate(reference, t)
    print(f"{t:.1f} s: {u:.4f} m/s, reference {expected:.4f}, {100 * (u / expected - 1):+.1f} %")
print(f"terminal speed {TERMINAL:.4f} m/s: {100 * (u / TERMINAL - 1):+.1f} %")
sys.exit(not max(abs(u / expected - 1), abs(u / TERMINAL - 1)) < 0.03)
E2
