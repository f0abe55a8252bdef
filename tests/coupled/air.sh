#!/usr/bin/env bash
# Solids of 2500 times the fluid's density: a disc flies on at its speed, a soft wall swings, and the fluid is no faster than they make it, as
# the one fluid or as a phase that fills them.  Usage: air.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/air.yaml
wall='{shape: rectangle, centre: [0.148, 0.04], width: 0.012, height: 0.08, size: 0.002, material: rubber, fixed: [bottom]}'
swing=(--set "solid.bodies[0]=$wall" --set 'gravity=[60.0, -3.0]')
must disc 1:1:1
must wall 1:1:1 "${swing[@]}"
phases=$scratch/phases.yaml
sed -e 's/^  density:.*/  phases: [{name: air, density: 1.0, viscosity: 1.8e-5}, {name: water, density: 1000.0, viscosity: 1.0e-3}]\n  regions: [{phase: air}]/' \
  -e '/^  viscosity:/d' -e 's/top: open/top: {pressure: 0.0, phase: air}/' "$case" >"$phases"
case=$phases must phases 1:1:1 "${swing[@]}" --set "solid.bodies[0].size=0.001"
"$python" - "$scratch" <<'E2'
from results import rows
for label, bodies in (("disc", 2.0), ("wall", 2.1), ("phases", 2.1)):  # m/s, the largest speed of the solid
    fastest = max(r["max speed [m/s]"] for r in rows(label, "fluid"))
    assert fastest < 4.0 * bodies, "%s: the fluid moves with %g m/s beside a solid with at most %g m/s" % (label, fastest, bodies)
    assert all(r["iterations"] == 1.0 for r in rows(label, "coupler")[1:]), "%s: iterations" % label
speeds = [r["u_x [m/s]"] for r in rows("disc", "coupler")]
assert all(1.99 < u <= 2.0 for u in speeds), "the disc's speed goes from 2 m/s to between %g and %g" % (min(speeds), max(speeds))
E2
