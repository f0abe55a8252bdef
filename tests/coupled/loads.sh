#!/usr/bin/env bash
# Loads on the boundary of a body in a fluid: with a traction that is as large as its weight less the displaced fluid's a disc without gravity falls as one with
# gravity, whatever pressure is on it, too; the budget of momentum closes; a run with a load that grows resumes as if nothing had happened, also without a
# fluid. Usage: loads.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
body='{shape: disc, centre: [1.0, 1.1], radius: 0.125, size: 0.05, material: disc'
# (2000 - 1000) 9.81 pi r^2 over the length of the boundary, a polygon of 18 sides with that area
traction=$("$python" -c 'from math import *; print("[0.0, %.9g]" % (-1000.0 * 9.81 * pi * 0.125**2 / (2.0 * sqrt(18.0 * tan(pi / 18.0) * pi) * 0.125)))')
tight=(--set "fluid.petsc=-momentum_ksp_rtol 1e-13" --set 'gravity=[0.0, 0.0]')
must gravity 1:1:1
must traction 1:1:1 "${tight[@]}" --set "solid.bodies[0]=$body, loads: [{boundary: boundary, traction: $traction}]}"
must two 2:1:2 "${tight[@]}" --set "solid.bodies[0]=$body, loads: [{boundary: boundary, traction: $traction}, {boundary: boundary, pressure: 200.0}]}"
for label in traction two; do "$python" "$root/scripts/momentum.py" "$scratch/$label" --bound 1e-10 || { echo "$label is not closed"; exit 1; }; done >"$scratch/report" || { cat "$scratch/report"; exit 1; }
grows="$body, loads: [{boundary: boundary, traction: [[0.0, 0.0, 0.0], [0.1, 0.0, -1200.0]], pressure: [[0.0, 0.0], [0.05, 2.0e4], [0.1, 0.0]]}]}"
far=(--set "fluid.petsc=-pressure_varying_ksp_rtol 1e-12 -momentum_ksp_rtol 1e-9")
must whole 1:1:1 "${far[@]}" --set "solid.bodies[0]=$grows"
must resumed 1:1:1 "${far[@]}" --set "solid.bodies[0]=$grows" --set time.end=0.05
must resumed 1:1:1 "${far[@]}" --set "solid.bodies[0]=$grows" --set resume=last
alone() { must "$1" "1:1:$2" --alone "${@:3}" --set "solid.bodies[0]=$grows" --set 'gravity=[0.0, 0.0]'; }
alone alone 1
alone alone2 2
alone alone-resumed 1 --set time.end=0.05
alone alone-resumed 2 --set resume=last
"$python" - "$scratch" <<'E2'
from results import rows
u = {label: rows(label, "coupler")[-1]["u_y [m/s]"] for label in ("gravity", "traction", "two")}
print("at the end they fall with", u)
for label in "traction", "two":
    assert abs(u[label] / u["gravity"] - 1.0) < 2e-3, "%s falls with %g m/s, by gravity with %g" % (label, u[label], u["gravity"])
for one, two, tolerance in ("whole", "resumed", 1e-9), ("alone", "alone2", 1e-9), ("alone", "alone-resumed", 1e-9):
    for name in "y0 [m]", "v0 [m/s]", "strain0 [J/m]", "ry0 [N/m]", "reaction work [J/m]":
        a, b = rows(one, "solid"), rows(two, "solid")
        assert len(a) == len(b), "%s: %d rows, %d" % (two, len(a), len(b))
        differ = max(abs(r[name] - s[name]) for r, s in zip(a, b)) / max(abs(r[name]) for r in a)
        assert differ < tolerance, "%s: %s differs by %g" % (two, name, differ)
# alone: m v = int 12000 t P dt, P the length of the boundary; substeps of 0.6 ms have the load of their start
last = rows("alone", "solid")[-1]
expected = -0.5 * 1200.0 * 0.1 * 2.0 * (18.0 * 0.17632698 * 3.14159265) ** 0.5 * 0.125
momentum = last["momentum_y [N s/m]"]
assert abs(momentum / expected - 1.0) < 1e-2, "alone: momentum %g, expected %g N s/m" % (momentum, expected)
E2
