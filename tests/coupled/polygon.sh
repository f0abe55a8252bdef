#!/usr/bin/env bash
# A hull floats where Archimedes says in a basin with a beach, both polygons; the water's pressure on the floor and the beach is hydrostatic; turned, it
# rights itself.
# Usage: polygon.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/polygon.yaml
must still 1:1:1
must turned 2:1:1 --set time.end=0.1 --set 'solid.bodies[0].angle=0.1'
"$python" - "$scratch" <<'E2'
from results import column
rises = max(abs(y - 0.49638) for y in column("still", "solid", "y0 [m]")) # the centre of its area at the draught of 0.1759 m
turns = max(abs(a) for a in column("still", "solid", "angle0 [rad]"))
floor, beach = (column("still", "fluid_forces", name)[-1] for name in ("floor pressure y [N/m]", "beach pressure x [N/m]"))
spin = column("turned", "solid", "omega0 [rad/s]")[-1]
report = "moves by %.2f mm, turns by %.4f; floor %.0f N/m, beach %.0f N/m; turned by 0.1 it turns back with %.3f rad/s" % (1e3 * rises, turns, floor, beach, spin)
print(report)
assert rises < 1e-3 and turns < 5e-3, report
assert abs(floor / (-1000 * 9.81 * 0.5 * 2.0) - 1.0) < 0.01 and abs(beach / (1000 * 9.81 * 0.5 ** 2 / 2.0) - 1.0) < 0.01, report
assert -0.5 < spin < -0.05, report
E2
