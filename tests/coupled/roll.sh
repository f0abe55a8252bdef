#!/usr/bin/env bash
# A floating block let go at 5 degrees rolls with the period of potential theory in the same tank (roll_reference.py), within 8 %
# where the block is 7 elements high, within 3 % where it is 22 (with long).  The block has elements of 0.008 m: those of
# floating.yaml have 8 % too much moment of inertia, with their masses at the nodes.  Usage: roll.sh ROOT BUILD [long]
long=${3:-}
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/floating.yaml limit=1800
arguments=$("$python" - <<'E2'
import math
a = math.radians(5.0)
def turned(x, y): return "[%.9f, %.9f]" % (0.3 + math.cos(a) * x - math.sin(a) * y, 0.2 + math.sin(a) * x + math.cos(a) * y)
print("solid.bodies[0].size=0.008")
print("solid.bodies[0].angle=%.9f" % a)
print("solid.probes[0].point=" + turned(-0.05, 0.0))
print("solid.probes[1].point=" + turned(0.05, 0.0))
E2
)
keys=()
while read -r key; do keys+=(--set "$key"); done <<<"$arguments"
must 0.008 1:1:1 "${keys[@]}" --set time.end=0.58 --set fluid.adapt.size_min=0.008 --set time.dt_max=0.002
[ -z "$long" ] || must 0.00267 1:1:1 "${keys[@]}" --set time.end=0.58 --set fluid.adapt.size_min=0.00267 --set time.dt_max=0.00067
PYTHONPATH=$here "$python" - "$scratch" <<'E2'
import csv, numpy as np, os, sys
from roll_reference import Tank, crossings
START, ARM = np.radians(5.0), 0.10
def half_period(size):
    with open("%s/%s/solid_probes.csv" % (sys.argv[1], size)) as file: rows = list(csv.DictReader(file))
    def column(name): return np.array([float(r[name]) for r in rows])
    x = ARM * np.cos(START) + column("right_x [m]") - column("left_x [m]")
    y = ARM * np.sin(START) + column("right_y [m]") - column("left_y [m]")
    t = crossings(column("t [s]"), np.arctan2(y, x))
    return t[1] - t[0]
def reference(size):
    t = np.linspace(0.0, 0.6, 1201)
    c = crossings(t, Tank(0.6, 0.2, 0.3, 0.12, 0.06, 0.03, 0.5, 9.81, size).roll(t))
    return c[1] - c[0]
coarse, fine = reference(0.015), reference(0.0075)
exact = fine + (fine - coarse) / (2.0 ** (4.0 / 3.0) - 1.0)  # right angles in the water: order 4/3
assert abs(exact / fine - 1.0) < 0.02, "reference: %g s, %g s with the finer grid" % (exact, fine)
for size, bound in (("0.008", 0.08), ("0.00267", 0.03)):
    if not os.path.exists("%s/%s" % (sys.argv[1], size)): continue
    error = half_period(size) / exact - 1.0
    report = "half a period of %.4f s; with le %s %+.3f of it too long" % (exact, size, error)
    if os.path.exists(sys.argv[1] + "/0.00267"): print(report)
    assert abs(error) < bound, report
E2
