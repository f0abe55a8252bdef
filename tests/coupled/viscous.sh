#!/usr/bin/env bash
# Solids in very viscous fluids.  A free disc as dense as the fluid turns with half the rate of a shear flow, and one that is denser falls between two walls as
# Faxen (1946) has it, in steps in which viscosity crosses them (coupler/terms/viscous_response.h; before, both alternated from step to step, by 50 times
# their velocity; without the pressure's rotational increment the one that falls is 20 % too fast after 15 steps).  The torque on a disc that turns in a ring is steady (before, it grew by half in 0.5 s), and an elastic wall clamped in a channel is tight (before, a
# pressure of 100 Pa drove 3e-4 m2/s past its ends).  Where that spares coupling iterations the steps are shortened.  Usage: viscous.sh ROOT BUILD [rows]
# rows: prints those of README.md that the test has not: a cylinder that turns in a stream, and the ring with two phases that are alike
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/viscous.yaml
ring=(--set time.end=0.6 --set time.dt_max=0.02 --set time.cfl=1 \
  --set 'solid.bodies=[{shape: disc, centre: [0, 0], radius: 0.25, size: 0.03, material: m, prescribed: [{angular_velocity: 1.0, pivot: [0, 0]}]}, {shape: ring, centre: [0, 0], inner_radius: 0.5, outer_radius: 0.57, size: 0.03, material: m, fixed: true}]' --set coupler.shell_thickness=0.001)
if [[ ${1:-} == rows ]]; then
  must stream 1:1:1 --set time.end=3 --set time.cfl=1 --set 'fluid={density: 1000.0, viscosity: 10.0, mesh: {lower: [-1.0, -0.5], upper: [2.0, 0.5], size_max: 0.08}, adapt: {size_min: 0.015, size_max: 0.08, velocity_error: 0.02, every: 20}, boundaries: {left: {velocity: [0.3, 0.0], profile: parabolic, rise: 0.5}, right: open, bottom: no_slip, top: no_slip}}' \
    --set solid.materials.m.density=1000 --set 'solid.bodies=[{shape: disc, centre: [0, 0], radius: 0.125, size: 0.02, material: m, prescribed: [{angular_velocity: 4.0, pivot: [0, 0], rise: 0.5}]}]' --set coupler.shell_thickness=0.00075
  must ring 1:1:1 "${ring[@]}" --set 'fluid={phases: [{name: out, density: 1000.0, viscosity: 100.0}, {name: in, density: 1000.0, viscosity: 100.0}], regions: [{phase: out}, {phase: in, centre: [0.55, 0.55], radius: 0.03}], mesh: {lower: [-0.6, -0.6], upper: [0.6, 0.6], size_max: 0.06}, adapt: {size_min: 0.02, size_max: 0.06, velocity_error: 0.005, every: 20}, boundaries: {left: no_slip, right: no_slip, bottom: no_slip, top: no_slip}}'
  "$python" - "$scratch" <<'E2'
from statistics import pstdev
from results import column
for run in "stream", "ring":
    torque, drag, speed = column(run, "solid", "moment0 [N]"), column(run, "solid", "fx0 [N/m]"), column(run, "fluid", "max speed [m/s]")
    half = len(torque) // 2
    print("%s: torque %.1f to %.1f N, at most %.2f m/s, deviation of the drag %.2f N/m" % (run, min(torque[half:]), max(torque[half:]), max(speed[half:]), pstdev(drag[half:])))
E2
  exit
fi
must turns 1:1:1
must ranks 2:2:2
must shortened 1:1:1 --set time.dt_max=0.001 --set time.end=0.02  # chi 1.2 over dt_max
must falls 2:1:1 --set time.end=0.15 --set 'gravity=[0.0, -1000.0]' --set time.cfl=1 --set 'fluid={density: 1000.0, viscosity: 1.0e4, mesh: {lower: [-0.5, -1.2], upper: [0.5, 1.2], size_max: 0.1}, adapt: {size_min: 0.015, size_max: 0.1, velocity_error: 0.001, every: 20}, boundaries: {left: no_slip, right: no_slip, bottom: no_slip, top: no_slip}}' \
  --set solid.materials.m.density=1200 --set 'solid.bodies=[{shape: disc, centre: [0, 0], radius: 0.1, size: 0.025, material: m}]' --set coupler.shell_thickness=0.00075
must rotates 1:1:1 "${ring[@]}" --set 'fluid={density: 1000.0, viscosity: 100.0, mesh: {lower: [-0.6, -0.6], upper: [0.6, 0.6], size_max: 0.06}, adapt: {size_min: 0.02, size_max: 0.06, velocity_error: 0.005, every: 20}, boundaries: {left: no_slip, right: no_slip, bottom: no_slip, top: no_slip}}'
must holds 1:1:1 --set time.end=5 --set time.dt_max=0.02 --set time.cfl=1 --set 'fluid={density: 1000.0, viscosity: 1.0, mesh: {lower: [-0.6, 0.0], upper: [0.6, 1.0], size_max: 0.08}, adapt: {size_min: 0.02, size_max: 0.08, velocity_error: 0.005, every: 20}, probes: [{name: L, line: {from: [0.4, 0.0], to: [0.4, 1.0], points: 101}}], boundaries: {left: {pressure: 100.0, rise: 0.5}, right: open, bottom: no_slip, top: no_slip}}' \
  --set solid.decay_rate=60 --set solid.materials.m.density=1000 --set 'solid.bodies=[{shape: rectangle, centre: [0, 0.5], width: 0.06, height: 1.0, size: 0.03, order: 2, material: m, fixed: [bottom, top]}]' --set coupler.shell_thickness=0.001
"$python" - "$scratch" <<'E2'
from math import log, pi
from results import column, rows

for run in "turns", "ranks":
    spin = column(run, "solid", "omega0 [rad/s]")[-8:]
    print("%s: %.3f to %.3f rad/s" % (run, min(spin), max(spin)))
    assert -0.56 < min(spin) and max(spin) < -0.45, "%s: it turns with %.3f to %.3f rad/s, expected - 0.5" % (run, min(spin), max(spin))
steps, iterations = column("shortened", "coupler", "dt [s]"), column("shortened", "coupler", "iterations")
print("steps of %.2e to %.2e s, %g iterations at most" % (min(steps), max(steps[1:]), max(iterations)))
assert max(iterations) == 1 and max(steps[-5:]) < 0.0008, "steps %s, iterations %s" % (steps, iterations)
k = 0.1 / 0.5  # the disc's radius over half of the gap
speed = 0.2 * 1000.0 * pi * 0.1**2 * 1000.0 * (log(1.0 / k) - 0.9157 + 1.7244 * k**2 - 1.7302 * k**4 + 2.4056 * k**6) / (4.0 * pi * 1e4)
mean = -sum(column("falls", "solid", "v0 [m/s]")[-4:]) / 4
print("falls with %.4f m/s, Faxen %.4f" % (mean, speed))
assert abs(mean / speed - 1.0) < 0.08, "it falls with %.4f m/s, expected %.4f" % (mean, speed)
torque = column("rotates", "solid", "moment0 [N]")
theory = -4.0 * pi * 100.0 / (1.0 / 0.25**2 - 1.0 / 0.5**2)
mean = sum(torque[-10:]) / 10
print("a torque of %.1f N, theory %.1f" % (mean, theory))
assert abs(mean / theory - 1.0) < 0.08, "a torque of %.1f N, expected %.1f" % (mean, theory)
last = rows("holds", "fluid_probes")[-1]
flow = sum(value for name, value in last.items() if name.endswith("_u [m/s]")) / 101
print("%.2e m2/s past a clamped wall" % flow)
assert abs(flow) < 8e-5, "%.2e m2/s past a clamped wall" % flow
E2
