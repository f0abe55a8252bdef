#!/usr/bin/env bash
# A disc as dense as the fluid is held in a stream by a spring of which steps do not resolve the vibration: the force on it follows the flow.  While springs
# were not in the step's response it alternated from step to step with five times the drag.  Usage: springs.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/springs.yaml must spring 1:1:1
"$python" - "$scratch" <<'E2'
from results import rows
force = [r["F_x [N]"] for r in rows("spring", "coupler") if 2.0 < r["t [s]"] < 3.5]
noise = max(abs(a - 2.0 * b + c) / 4.0 for a, b, c in zip(force, force[1:], force[2:]))
drag = sum(force) / len(force)
# vortices change the drag by its own size in seconds, so by some (dt/s)^2 of it from the mean of its neighbours
assert drag > 0.0 and noise < 0.01 * drag, "a drag of %g N alternates by %g N" % (drag, noise)
E2
