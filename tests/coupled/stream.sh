#!/usr/bin/env bash
# A disc that drifts with a stream, both moving from the start (fluid.initial.velocity), goes on as they began.  Usage: stream.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
stream='{velocity: [0.5, 0.0]}'
for density in 200 1000 3000; do
  must "$density" 1:1:1 --set 'gravity=[0, 0]' --set 'fluid.initial.velocity=[0.5, 0.0]' --set "fluid.boundaries={left: $stream, right: open, bottom: $stream, top: $stream}" \
    --set 'solid.bodies[0].velocity=[0.5, 0.0]' --set "solid.materials.disc.density=$density" --set time.end=0.2
done
"$python" - "$scratch" <<'E2'
import csv, sys
for density in ("200", "1000", "3000"):
    rows = list(csv.DictReader(open("%s/%s/coupler.csv" % (sys.argv[1], density))))
    for row in rows:
        u, v, f = float(row["u_x [m/s]"]), float(row["u_y [m/s]"]), abs(float(row["F_x [N]"]))
        assert abs(u - 0.5) < 5e-4 and abs(v) < 5e-4 and f < 1, "density %s, t %s: velocity (%g, %g), force %g" % (density, row["t [s]"], u, v, f)
E2
