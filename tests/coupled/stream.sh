#!/usr/bin/env bash
# A disc that drifts with a stream, both moving from the start (fluid.initial.velocity), goes on as they began; and one that begins with a
# velocity in a fluid at rest keeps its momentum, which the fluid around it shares at once as the added mass says.  Usage: stream.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
stream='{velocity: [0.5, 0.0]}'
for density in 200 1000 3000; do
  must "$density" 1:1:1 --set 'gravity=[0, 0]' --set 'fluid.initial.velocity=[0.5, 0.0]' --set "fluid.boundaries={left: $stream, right: open, bottom: $stream, top: $stream}" \
    --set 'solid.bodies[0].velocity=[0.5, 0.0]' --set "solid.materials.disc.density=$density" --set time.end=0.2
done
for density in 1000 2000 4000; do
  must "thrown-$density" 1:1:1 --set 'gravity=[0, 0]' --set 'solid.bodies[0].velocity=[0.5, 0.0]' --set "solid.materials.disc.density=$density" --set fluid.viscosity=0.1 \
    --set time.dt_max=0.002 --set time.end=0.004
done
"$python" - "$scratch" <<'E2'
from results import rows
for density in ("200", "1000", "3000"):
    for row in rows(density, "coupler"):
        u, v, f = row["u_x [m/s]"], row["u_y [m/s]"], abs(row["F_x [N]"])
        assert abs(u - 0.5) < 5e-4 and abs(v) < 5e-4 and f < 1, "density %s, t %s: velocity (%g, %g), force %g" % (density, row["t [s]"], u, v, f)
# m v = (m + C_a m_f) v1: the same C_a whatever the density, 1.0 in an unbounded fluid, more in a box and with elements a third of the disc's radius
added = []
for density in (1000, 2000, 4000):
    added.append(density / 1000 * (0.5 / rows("thrown-%d" % density, "coupler")[0]["u_x [m/s]"] - 1))
assert 1.0 < added[0] < 1.35 and max(added) / min(added) < 1.03, "added mass over displaced mass: %s" % added
E2
