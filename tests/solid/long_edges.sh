#!/usr/bin/env bash
# Friction and contact damping on edges far longer than what lies on them: a small block on a rough slope stays where it is, whether the slope's edges are as short as the block's or 100 times as long.
# Usage: long_edges.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run_alone.sh"
gravity=$("$python" -c "from math import *; print('[%.17g, %.17g]' % (9.81*sin(radians(20)), -9.81*cos(radians(20))))")
cat >"$scratch/case.yaml" <<E2
case: long_edges
gravity: $gravity
time: {end: 0.5, dt_max: 0.01}
solid:
  materials:
    clay: {density: 2000.0, youngs_modulus: 1.0e6, poisson_ratio: 0.3, damping: 0.2, friction: 0.5, penalty: 1.0e6}
    slope: {density: 2000.0, law: rigid, friction: 0.5, penalty: 1.0e6}
  bodies:
    - {shape: rectangle, width: 0.02, height: 0.02, size: 0.01, material: clay, centre: [0.3, 0.01]}
    - {shape: rectangle, width: 2.0, height: 0.02, size: 0.02, material: slope, centre: [1.0, -0.01], fixed: true}
output: {folder: out/long_edges, every: 1.0, checkpoint: 0}
E2
for damping in 0 0.3; do
  for size in 0.02 2; do
    alone "${size}_$damping" "$scratch/case.yaml" --set "solid.bodies[1].size=$size" --set "solid.materials.clay.contact_damping=$damping" \
      --set "solid.materials.slope.contact_damping=$damping"
  done
done
"$python" - "$scratch" <<'E2'
from results import column
for damping in ("0", "0.3"):
    for size in ("0.02", "2"):
        x = column("%s_%s" % (size, damping), "solid", "x0 [m]")
        assert abs(x[-1] - x[20]) < 1e-6 and x[-1] - x[0] < 2e-5, "edges of %s m, contact_damping %s: the block has moved by %g m, %g m of it after 0.2 s" % (
            size, damping, x[-1] - x[0], x[-1] - x[20])
E2
