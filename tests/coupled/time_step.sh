#!/usr/bin/env bash
# The coupling has no length of a step in it: a disc falls alike with steps of 5 ms and a quarter of that.  It did not while each step
# mixed the solid's velocity into the fluid beside it (coupler/terms/slip.h): 3.3 % slower with the short steps.
# A fast disc (Re about 180) that moves by half an element a step and by one and a half: its drag grew with the step while the fluid that it
# covers was taken to the solid's velocity after the step alone (coupler/terms/inertia.h): 7 % slower after 1 s, now 3 %.
# A stream of 3 m/s through a channel at rest, after a first step of 10 s: the note says which flow makes steps short, and how short, once.
# Usage: time_step.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
must long 1:1:1 --set solid.materials.disc.density=1050 --set time.dt_max=0.005
must short 1:1:1 --set solid.materials.disc.density=1050 --set time.dt_max=0.00125
case=$root/cases/falling_cylinder/case.yaml
fast=(--set time.end=1 --set time.dt_max=0.04 --set fluid.viscosity=2.278 --set "fluid.mesh.lower=[0.0, 10.0]" --set fluid.adapt.size_min=0.02
  --set fluid.adapt.velocity_error=0.05 --set "solid.bodies[0].size=0.03")
must fast 1:1:1 "${fast[@]}"
must fast_long 1:1:1 "${fast[@]}" --set time.cfl=3
cat >"$scratch/stream.yaml" <<'E2'
case: stream
gravity: [0.0, 0.0]
time: {end: 20.0, dt_max: 10.0, cfl: 0.8}
fluid:
  density: 1.0
  viscosity: 0.01
  mesh: {lower: [0.0, 0.0], upper: [0.6, 0.3], size_max: 0.03}
  boundaries: {left: {velocity: [3.0, 0.0]}, right: open, bottom: free_slip, top: free_slip}
solid: {bodies: []}
output: {folder: out, every: 100.0}
E2
case=$scratch/stream.yaml must stream 2:1:1
said=$(grep -c 'note: at t = 10 s the flow at (.*), 3.0[0-9]* m/s, makes steps as short as 0.008 s; the longest so far was of 10 s' "$scratch/stream.log") ||
  { cat "$scratch/stream.log"; exit 1; }
[ "$said" = 1 ]
"$python" - "$scratch" <<'E2'
from results import column
u = [column(label, "coupler", "u_y [m/s]")[-1] for label in ("long", "short", "fast", "fast_long")]
assert abs(u[1] / u[0] - 1) < 0.006, "velocities with long and short steps: %s" % u[:2]
assert abs(u[3] / u[2] - 1) < 0.045, "velocities of the fast disc, with short and long steps: %s" % u[2:]
E2
