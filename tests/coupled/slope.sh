#!/usr/bin/env bash
# A block on a slope under water, both bodies of the same mesh size as the fluid's elements.  With friction it stands, and the fluid's force on it is the
# displaced water's weight (coupler/force/uplift.h), in one fluid and beneath air; without, it slides as fast with short steps as with long
# ones (before, elements that both bodies share held it, the more the shorter the steps: 0.09 of the acceleration with dt 1.25 ms), and the
# fluid resists its acceleration alone.  Usage: slope.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/slope.yaml
phases='fluid={phases: [{name: air, density: 1.2, viscosity: 1.8e-5}, {name: water, density: 1000.0, viscosity: 1.0e-3}], regions: [{phase: air}, {phase: water, lower: [-1.0, -1.0], upper: [3.0, 0.53]}], mesh: {lower: [0.0, 0.0], upper: [1.0, 0.6], size_max: 0.1}, adapt: {size_min: 0.01, size_max: 0.1, velocity_error: 0.05, every: 10}, boundaries: {left: free_slip, right: free_slip, bottom: free_slip, top: free_slip}}'
must stands 1:1:1
must ranks 2:2:2
must beneath_air 1:1:1 --set "$phases"
for run in "slides 0.005 0.2" "short 0.00125 0.2" "smooth 0.005 0.0"; do
  set -- $run
  must "$1" 1:1:1 --set "time.dt_max=$2" --set "solid.materials.rock.friction=$3"
done
must slides_beneath_air 1:1:1 --set "$phases" --set solid.materials.rock.friction=0.2
"$python" "$root/scripts/momentum.py" "$scratch/slides" --bound 1e-10 >"$scratch/report" || { cat "$scratch/report"; exit 1; }
"$python" - "$scratch" <<'E2'
import math
from results import column
angle, mass, displaced = 0.2618, 2600.0 * 0.08**2, 1000.0 * 0.08**2
def speed(run):
    return [u * math.cos(angle) - v * math.sin(angle) for u, v in zip(column(run, "solid", "u1 [m/s]"), column(run, "solid", "v1 [m/s]"))]
def acceleration(run):
    t, u = column(run, "solid", "t [s]"), speed(run)
    first = next(k for k in range(len(t)) if t[k] > 0.1)
    return (u[-1] - u[first]) / (t[-1] - t[first])
for run, bound in ("stands", 0.02), ("ranks", 0.02), ("beneath_air", 0.04):
    force, u = column(run, "solid", "fy1 [N/m]")[-1], speed(run)[-1]
    print("%s: %.2f N/m of %.2f from the fluid, %g m/s" % (run, force, displaced * 9.81, u))
    assert abs(force / (displaced * 9.81) - 1.0) < bound and abs(u) < 1e-4, run
# friction takes a part of the weight, and the added mass is what the smooth slope shows
weight = (mass - displaced) * 9.81
added = weight * math.sin(angle) / acceleration("smooth") - mass
expected = weight * (math.sin(angle) - 0.2 * math.cos(angle)) / (mass + added)
print("added mass %.1f kg/m" % added)
for run in "slides", "short", "slides_beneath_air":
    print("%s: %.4f m/s2, expected %.4f" % (run, acceleration(run), expected))
    assert abs(acceleration(run) / expected - 1.0) < 0.15, run
E2
