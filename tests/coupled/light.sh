#!/usr/bin/env bash
# Solids lighter than the fluid rise smoothly, in few coupling iterations; heavier ones take one a step; one far below the limit that
# is allowed no more ends with a message that says so.
# Usage: light.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
must light 1:1:1 --set 'solid.materials.disc.density=500' --set time.end=0.3
must lightest 1:1:1 --set 'solid.materials.disc.density=50' --set time.end=0.3
must heavy 1:1:1 --set time.end=0.05
"$python" - "$scratch" <<'E2'
from results import column
def read(label):
    return column(label, "coupler", "u_y [m/s]"), column(label, "coupler", "iterations")
for label in ("light", "lightest"):
    u, iterations = read(label)
    drops = [a - b for a, b in zip(u, u[1:]) if b < a]
    assert u[-1] > 0.25 and max(drops, default=0) < 0.05 * u[-1], "%s: velocities %s" % (label, u)
    assert sum(iterations) < 4 * len(iterations), "%s: %s iterations" % (label, iterations)
assert set(read("heavy")[1]) == {1}, "iterations of a heavy disc: %s" % read("heavy")[1]
E2
if run lighter 1:1:1 --set 'solid.materials.disc.density=50' --set time.end=2 --set coupler.max_iterations=1; then
  echo "density ratio 0.05 ran to the end in one iteration a step"; exit 1
fi
grep -q 'error:.*density' "$scratch/lighter.log" || { cat "$scratch/lighter.log"; exit 1; }
