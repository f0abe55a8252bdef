#!/usr/bin/env bash
# A bar held at one end swings lengthwise with the damping ratio that the case asks for: by its material (damping_ratio at damping_frequency, plane strain and
# plane stress) and by a resistance (decay_rate, half of it over the angular frequency); the budget of momentum has the latter.  Usage: damping.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run_alone.sh"
swing() {
  alone "$1" "$root/tests/solid/alone.yaml" --set 'gravity=[0, 0]' \
    --set 'solid.bodies=[{shape: rectangle, centre: [0.2, 0], width: 0.4, height: 0.04, size: 0.02, material: m, velocity: [0.01, 0], fixed: [left]}]' \
    --set "solid.materials={m: {density: 1000.0, youngs_modulus: 1.0e6, poisson_ratio: 0.3, $2}}" --set 'solid.walls.lower=[-1, -1]' --set 'solid.walls.upper=[1, 1]' \
    --set time.end=0.4 --set time.dt_max=0.001 --set "solid.probes=[{name: tip, point: [0.4, 0]}]" "${@:3}"
}
swing stress "plane: stress, damping_ratio: 0.02, damping_frequency: 19.764"
swing strain "plane: strain, damping_ratio: 0.02, damping_frequency: 20.718"
swing decay "plane: stress, damping_ratio: 0.01, damping_frequency: 19.764" --set solid.decay_rate=5
"$python" - "$scratch" <<'E2'
import csv, math, sys
def rows(label, name):
    return [{k: float(v) for k, v in r.items()} for r in csv.DictReader(open("%s/%s/%s.csv" % (sys.argv[1], label, name)))]
def ratio(label):
    x = [r["tip_x [m]"] for r in rows(label, "solid_probes")]
    peaks = [x[i] for i in range(1, len(x) - 1) if x[i] > 0 and x[i - 1] < x[i] >= x[i + 1]][2:]
    return math.log(peaks[0] / peaks[-1]) / (2 * math.pi * (len(peaks) - 1))
for label, expected in (("stress", 0.02), ("strain", 0.02), ("decay", 0.01 + 5 / (4 * math.pi * 19.764))):
    found = ratio(label)
    assert abs(found / expected - 1) < 0.05, "%s: damping ratio %g instead of %g" % (label, found, expected)
series = rows("decay", "solid")
total, before = 0.0, 0.01 * series[0]["mass0 [kg/m]"]
for r in series:
    total += r["reaction_x [N s/m]"]
mass, first = series[-1]["mass0 [kg/m]"], series[0]
change = mass * (series[-1]["u0 [m/s]"] - first["u0 [m/s]"])
assert abs(total - first["reaction_x [N s/m]"] - change) < 1e-6 * mass * 0.01, "impulses %g, change of momentum %g" % (total, change)
E2
