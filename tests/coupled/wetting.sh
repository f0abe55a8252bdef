#!/usr/bin/env bash
# A drop on a block that does not move comes to rest at its contact angle, with the pressure of its radius; beside a half-sunk
# block at 90 degrees water stays at rest; long: also on a disc, and a
# disc of twice the water's density floats, held by surface tension.  Usage: [print=1] wetting.sh ROOT BUILD [long]
set -euo pipefail
long=${3:-}
source "$(dirname "$0")/run.sh"
case=$here/wetting.yaml
limit=600
for angle in 60 120; do must "plane $angle" 1:1:1 --set fluid.contact_angle=$angle; done
must "half wet 90" 1:1:1 --set fluid.contact_angle=90 --set 'gravity=[0.0, -1.0]' --set time.end=0.3 \
  --set 'fluid.regions=[{phase: air}, {phase: water, lower: [-1, -1], upper: [2, 0.37]}]' \
  --set 'solid.bodies=[{shape: rectangle, centre: [0.5, 0.35], width: 0.4, height: 0.3, size: 0.05, material: block, fixed: true}]'
if [ "$long" ]; then
  for angle in 60 120; do must "fine plane $angle" 1:1:1 --set fluid.contact_angle=$angle --set fluid.mesh.size_max=0.0268; done
  must "disc 90" 1:1:1 --set fluid.contact_angle=90 --set 'fluid.mesh={lower: [0.0, 0.0], upper: [1.0, 1.0], size_max: 0.0268}' \
    --set 'fluid.regions=[{phase: air}, {phase: water, centre: [0.503, 0.58], radius: 0.2}]' \
    --set 'solid.bodies=[{shape: disc, centre: [0.503, 0.35], radius: 0.2, size: 0.03, material: block, fixed: true}]'
  must "float 120" 1:1:1 --set fluid.contact_angle=120 --set time.end=12 --set time.dt_max=0.02 --set 'gravity=[0.0, -1.0]' \
    --set 'fluid.phases=[{name: water, density: 1.0, viscosity: 0.3}, {name: air, density: 0.01, viscosity: 0.03}]' \
    --set 'fluid.mesh={lower: [-3.0, -2.0], upper: [3.0, 1.5], size_max: 0.3}' \
    --set 'fluid.adapt={size_min: 0.08, size_max: 0.4, velocity_error: 0.2, every: 10}' \
    --set 'fluid.regions=[{phase: air}, {phase: water, lower: [-9.0, -9.0], upper: [9.0, 0.0]}]' \
    --set 'solid.bodies=[{shape: disc, centre: [0.01, -0.2], radius: 0.5, size: 0.08, material: block}]' --set coupler.shell_thickness=0.005
fi
PYTHONPATH=$here "$python" -B - "$scratch" "${print:-}" <<'E2'
import csv, h5py, math, numpy as np, os, sys
from wetting_reference import bisect, floating, on_disc, on_plane, segment
PLANE, CENTRE, RADIUS = 0.25, np.array([0.503, 0.35]), 0.2

def at_end(folder):
    """area of the water, its centroid, its pressure over the air's, largest speed outside of the solid"""
    grid = h5py.File(folder + "/fluid.h5")["snapshot"]
    keys = sorted(grid)
    first, last = grid[keys[0]], grid[keys[-1]]
    x, cells, nodes = first["velocity/points"][:], first["velocity/cells"][:], first["pressure/cells"][:]
    a, b, c = (x[cells[:, k]] for k in range(3))
    area = 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    share, out = last["velocity/cell/water"][:], last["velocity/cell/alpha"][:] == 0.0
    p, u = last["pressure/node/pressure"][:][nodes][:, 3:].mean(1), last["velocity/node/velocity"][:].reshape(-1, 3, 3)
    water, air = area * (out & (share > 1.0 - 1e-9)), area * (out & (share < 1e-9))
    held = (area * share)[:, None] * x[cells].mean(1)[:, :2]
    pressure = (water * p).sum() / water.sum() - (air * p).sum() / air.sum()
    return (area * share).sum(), held.sum(0) / (area * share).sum(), pressure, np.hypot(u[out][..., 0], u[out][..., 1]).max()

def check_drop(name, place, angle):
    area, centroid, pressure, speed = at_end(os.path.join(sys.argv[1], name))
    rest = (lambda t: on_plane(area, t)) if place != "disc" else (lambda t: on_disc(RADIUS, area, t))
    height = centroid[1] - PLANE if place != "disc" else math.hypot(*(centroid - CENTRE))
    found = math.degrees(bisect(lambda t: rest(t)[1] - height, 0.2, 3.0))
    laplace = 1.0 / rest(math.radians(angle))[0]
    report = "%s: angle %.1f, pressure %.3f of %.3f, largest speed %.1e" % (name, found, pressure, laplace, speed)
    if sys.argv[2]: print(report)
    assert abs(found - angle) < 5.0 and abs(pressure / laplace - 1.0) < 0.1 and speed < 0.5, report

def check_float(name, angle):
    folder = os.path.join(sys.argv[1], name)
    t, x, y, fx, fy = (np.array([float(r[n]) for r in csv.DictReader(open(folder + "/solid.csv"))])
                       for n in ("t [s]", "x0 [m]", "y0 [m]", "fx0 [N/m]", "fy0 [N/m]"))
    weight, start = 2.0 * math.pi * 0.25, segment(0.5, math.acos(-0.2 / 0.5))[0]
    exact, _ = floating(0.5, math.radians(angle), weight * (1.0 - 0.01 / 2.0), 0.99, 1.0, 3.0, -0.5 * start)
    late, step = t > 0.6 * t[-1], np.diff(t, prepend=0.0)
    mean = lambda q: np.average(q[late], weights=step[late])
    report = "%s: height %.4f of %.4f, to %.4f aside, force %+.3f, %.3f of the weight" % (
        name, mean(y), exact, abs(x[late] - 0.01).max(), mean(fx) / weight, mean(fy) / weight)
    if sys.argv[2]: print(report)
    assert abs(mean(y) - exact) < 0.04 and abs(mean(fx)) < 0.1 * weight and abs(mean(fy) / weight - 1.0) < 0.03, report

def check_still(name):
    rows = csv.DictReader(open(os.path.join(sys.argv[1], name, "fluid.csv")))
    speed = max(float(r["max speed [m/s]"]) for r in rows)
    report = "%s: largest speed %.1e" % (name, speed)
    if sys.argv[2]: print(report)
    assert speed < 0.02, report

for name in sorted(os.listdir(sys.argv[1])):
    if not os.path.isdir(os.path.join(sys.argv[1], name)): continue
    place, angle = name.split()[-2], float(name.split()[-1])
    if place == "wet": check_still(name)
    elif place == "float": check_float(name, angle)
    else: check_drop(name, place, angle)
E2
