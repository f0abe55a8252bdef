#!/usr/bin/env bash
# Air in a bell under water, in regions that end at the bell's faces, is there from the start, without water beside the faces, and stays at rest.
# Usage: pocket.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/pocket.yaml
must pocket 1:1:1
"$python" - "$scratch" <<'E2'
from results import column
AIR = 1.0 * 0.25 + 0.2 * 0.2 + (0.26 * 0.23 - 0.2 * 0.2) # above the water, in the bell, and where the bell is
air, t, speed, energy = (column("pocket", "fluid", name) for name in ("air [m2]", "t [s]", "max speed [m/s]", "kinetic energy [J/m]"))
lacks, fastest = 1.0 - air[0] / AIR, max(v for v, at in zip(speed, t) if at > 0.1)
report = "%.2f %% of the air is not there, %.2f m/s, %.1e J/m" % (100.0 * lacks, fastest, energy[-1])
print(report)
assert abs(lacks) < 1e-3 and fastest < 0.5 and energy[-1] < 1e-3, report
E2
