#!/usr/bin/env bash
# Newmark's sliding block (Geotechnique 15, 1965): on a floor that is shaken by a pulse of A for T, above its friction mu g, a rigid block moves by
# (A - mu g) T^2 A/(2 mu g), relative to the floor; it stays where it is before, and under a pulse below mu g.  Usage: sliding.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run_alone.sh"
slide() { # LABEL A
  alone "$1" "$root/tests/solid/alone.yaml" \
    --set "gravity=[[0, 0, -9.81], [0.1, 0, -9.81], [0.1000001, $2, -9.81], [0.3, $2, -9.81], [0.3000001, 0, -9.81]]" \
    --set 'solid.bodies=[{shape: rectangle, centre: [0, 0.05], width: 0.3, height: 0.1, size: 0.05, material: m}]' \
    --set 'solid.materials={m: {density: 2500.0, youngs_modulus: 1.0e8, poisson_ratio: 0.2, friction: 0.3, damping: 0.1, contact_damping: 0.3}}' \
    --set 'solid.walls={lower: [-1, 0], upper: [3, 1], friction: 0.3}' --set time.end=0.6 --set time.dt_max=0.005
}
slide strong 4.905
slide weak 2.7
"$python" - "$scratch" <<'E2'
import csv, sys
def places(label):
    with open("%s/%s/solid.csv" % (sys.argv[1], label)) as file:
        return [(float(row["t [s]"]), float(row["x0 [m]"])) for row in csv.DictReader(file)]
a, friction, length = 4.905, 0.3 * 9.81, 0.2
way = 0.5 * (a - friction) * length ** 2 * a / friction
found = places("strong")
report = "the block has slid %.5f m, of %.5f" % (found[-1][1], way)
print(report)
assert abs(found[-1][1] / way - 1.0) < 0.015, report
assert max(abs(x) for t, x in found if t < 0.1) < 1e-9, "it moves before the pulse"
assert max(abs(x) for t, x in places("weak")) < 1e-3, "it slides under a pulse below its friction"
E2
