#!/usr/bin/env bash
# Without iterations: a solid half as dense as the fluid rises smoothly; one far below the limit ends with a message that says so.
# Usage: light.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
must light 1:1:1 --set 'solid.materials.disc.density=500' --set time.end=0.3
"$python" - "$scratch/light/coupler.csv" <<'E2'
import csv, sys
u = [float(r["u_y [m/s]"]) for r in csv.DictReader(open(sys.argv[1]))][5:]
drops = [a - b for a, b in zip(u, u[1:]) if b < a]
assert u[-1] > 0.25 and max(drops, default=0) < 0.05 * u[-1], "velocities %s" % u
E2
if run lighter 1:1:1 --set 'solid.materials.disc.density=50' --set time.end=2; then
  echo "density ratio 0.05 ran to the end"; exit 1
fi
grep -q 'error:.*density' "$scratch/lighter.log" || { cat "$scratch/lighter.log"; exit 1; }
